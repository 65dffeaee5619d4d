"""Configurations typed in a hurry: each builds a valid DAG or ends in one line that names the key.

All files go through the checks in the order of the Snakefile, some that pass through Snakemake's
API, and some of every kind through the command. The long version sends all through the command.
"""

import os
import random
import re
import subprocess
import sys
import time
from collections import Counter
from datetime import date
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, Phase, given, seed, settings
from snakemake.api import SnakemakeApi
from snakemake.common.configfile import load_configfile
from snakemake.settings.types import DAGSettings, OutputSettings, Quietness, ResourceSettings

from hopper_workflow import configuration, ranges, strict_yaml
from tests.reliability import record
from tests.workflow import mutations
from tests.workflow.conftest import ROOT, Workflow
from tests.workflow.mutations import KINDS, WHOLE, Mutation

SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"
EACH = 45  # files of each kind
RUN = 5  # by the command, whole files and changed ones each
LIMIT = 1.4  # of a dry run's processor time, over that of the configuration as it is
BUILT = 3  # of those that are accepted, in the short version
ONE_LINE = re.compile(
    r"config\.yaml (line (?P<line>\d+): |has |cannot ).+|config key '(?P<key>.*?)'.+", re.ASCII
)
# A relation between two sections may be told of the other.
NAMED_WITH = {"radial": "fig_3_2", "spectra": "claims"}


def examples() -> list[Mutation]:
    """Return whole files, and ``EACH`` of every kind.

    Seeded, but not always the same: hypothesis also draws from constants of the modules loaded.
    """
    found = list(WHOLE)
    for strategy in KINDS.values():

        @seed(4)
        @settings(
            max_examples=EACH,
            database=None,
            deadline=None,
            phases=[Phase.generate],
            suppress_health_check=list(HealthCheck),
        )
        @given(strategy)
        def collect(mutation: Mutation) -> None:
            found.append(mutation)

        collect()
    return found


def refusal(path: Path) -> str | None:
    """Check a file in the order of the Snakefile; return the message of a refusal."""
    try:
        configuration.check_file(path, SCHEMA)
        config = load_configfile(path)
        configuration.check(config, SCHEMA)
    except configuration.ConfigurationError as error:
        return str(error)
    assert config == strict_yaml.read(path), "Snakemake reads another configuration"
    return None


def check_message(mutation: Mutation, message: str) -> None:
    """Assert that a refusal is one line that names the key or the line at fault."""
    found = ONE_LINE.fullmatch(message)
    assert found, f"{mutation.kind}: {message!r}"
    if mutation.line is not None:
        assert found["line"] == str(mutation.line), message
    if mutation.section is not None and found["key"] is not None:
        section = re.split(r"[.[]", found["key"])[0]
        assert section in {mutation.section, NAMED_WITH.get(mutation.section)}, message


def build_dag(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Build the DAG of a workflow as a dry run of the command does."""
    with (
        monkeypatch.context() as context,
        SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api,
    ):
        context.chdir(path)
        context.setattr(sys, "path", list(sys.path))
        context.setattr(sys, "executable", sys.executable)
        context.setenv("PYTHONPATH", os.environ.get("PYTHONPATH", ""))
        workflow = api.workflow(ResourceSettings(cores=1), snakefile=path / "Snakefile")
        workflow.dag(DAGSettings()).execute_workflow(executor="dryrun")


def dry_run(path: Path) -> tuple[int, str, float]:
    """Run `snakemake -n`; return its exit code, what it said, and its CPU time in seconds.

    A dry run says everything on stdout. The CPU time: other processes do not count.
    """
    command = [sys.executable, "-m", "snakemake", "-n", "-q", "--cores", "1"]
    with (path.parent / f"{path.name}.log").open("w+") as log:
        process = subprocess.Popen(command, cwd=path, stdout=log, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        log.seek(0)
        return process.returncode, log.read(), usage.ru_utime + usage.ru_stime


def files(path: Path) -> set[Path]:
    """Return what lies in and beside a workflow, less the caches of Snakemake and Python."""
    caches = {".snakemake", "__pycache__"}
    return {file for file in path.parent.rglob("*") if caches.isdisjoint(file.parts)}


def try_with_command(workflow: Workflow, tried: list[Mutation]) -> tuple[Counter[str], float]:
    """Dry-run every file, assert its outcome; return counts of outcomes and the largest time.

    That is over the time of the configuration as it is: machines differ.
    """
    outcomes: Counter[str] = Counter()
    slowest = 0.0
    config = workflow.path / "config.yaml"
    usual = min(dry_run(workflow.path)[2] for _ in range(3))
    before = files(workflow.path)
    for mutation in tried:
        config.write_bytes(mutation.content)
        expected = refusal(config)
        code, said, seconds = dry_run(workflow.path)
        outcomes["tracebacks"] += "Traceback" in said
        assert not outcomes["tracebacks"], f"{mutation.kind}: {said}"
        if expected is None:
            assert code == 0, f"{mutation.kind}: {said}"
        else:
            assert code == 1, f"{mutation.kind}: {said}"
            check_message(mutation, expected)
            lines = said.splitlines()
            assert lines.count(expected) == 1, f"{mutation.kind}: {said}"
            assert sum("Error" in line for line in lines) == 1, f"{mutation.kind}: {said}"
        outcomes["refused" if expected else "accepted"] += 1
        if seconds >= LIMIT * usual:  # the least of three: a busy machine only adds
            again = (dry_run(workflow.path)[2] for _ in range(2))
            seconds = min(seconds, *again)
        slowest = max(slowest, seconds / usual)
    assert files(workflow.path) == before
    return outcomes, slowest


@pytest.mark.workflow
@pytest.mark.parametrize("step", [10, pytest.param(1, marks=pytest.mark.soak)])
def test_a_mutated_configuration_builds_a_dag_or_ends_in_one_line(fresh, monkeypatch, step):
    every = examples()
    assert len(every) >= 500
    tried = every[::step]
    config = fresh.path / "config.yaml"
    accepted, slowest = [], 0.0
    for mutation in tried:
        config.write_bytes(mutation.content)
        start = time.process_time()
        message = refusal(config)
        slowest = max(slowest, time.process_time() - start)
        if message is None:
            accepted.append(mutation)
        else:
            check_message(mutation, message)
    choice = random.Random(4)
    built = choice.sample(accepted, BUILT)
    for mutation in built:
        config.write_bytes(mutation.content)
        start = time.process_time()
        build_dag(fresh.path, monkeypatch)
        slowest = max(slowest, time.process_time() - start)
    of_each_kind = [choice.choice(of) for of in by_kind(tried).values()]
    chosen = [*choice.sample(WHOLE, RUN), *choice.sample(of_each_kind, RUN)]
    outcomes, slowest_run = try_with_command(fresh, chosen)
    record(
        "bad_configurations",
        "config.yaml got wrong in many ways: each file builds a valid DAG or ends in one line that "
        "names the key or the line at fault.",
        {
            "files tried": len(tried),
            "refused in one line": len(tried) - len(accepted),
            "accepted": len(accepted),
            "DAGs built of accepted files": len(built),
            "dry runs of the command": len(chosen),
            "tracebacks": outcomes["tracebacks"],
            "slowest check or DAG (CPU s)": round(slowest, 2),
            "slowest dry run, over the usual one": round(slowest_run, 2),
        },
    )


def by_kind(tried: list[Mutation]) -> dict[str, list[Mutation]]:
    return {kind: [one for one in tried if one.kind == kind] for kind in KINDS}


@pytest.mark.soak
@pytest.mark.workflow
def test_every_mutated_configuration_in_a_dry_run(fresh):
    tried = examples()
    outcomes, slowest = try_with_command(fresh, tried)
    assert slowest < LIMIT
    record(
        "bad_configurations_long",
        "Files of the same kinds, each in a dry run of the command.",
        {
            "files tried": len(tried),
            "refused in one line": outcomes["refused"],
            "accepted, valid DAG": outcomes["accepted"],
            "tracebacks": outcomes["tracebacks"],
            "slowest dry run, over the usual one": round(slowest, 2),
        },
    )


@pytest.mark.parametrize("name", mutations.NAMES)
def test_no_name_that_a_shell_or_a_path_would_take_amiss_is_a_case(name):
    config = yaml.safe_load(mutations.SHIPPED)
    config["cases"][0]["name"] = name
    with pytest.raises(configuration.ConfigurationError, match=r"config key 'cases\[0\].name"):
        configuration.check(config, SCHEMA)


def test_no_rule_runs_a_shell():
    for path in (ROOT / "workflow").rglob("*.smk"):
        assert not re.search(r"^\s+(shell|run):|\bshell\(", path.read_text(), re.MULTILINE), path


@pytest.mark.soak
@pytest.mark.workflow
def test_the_names_of_a_case_stay_names_and_its_description_is_text(fresh):
    """With what the schema allows: the widest names, and all the punctuation."""
    description = "'q' (a); b: c/d, e.f + g-h é ß 漢"
    cases = yaml.safe_load(mutations.SHIPPED)["cases"]
    names = ["con", "a" * 19 + "_" + "ab" * 10 + "c"]
    fresh.set("cases", [{**cases[0], "name": name, "description": description} for name in names])
    before = files(fresh.path)
    fresh.build(*(f"figures/case_{name}.png" for name in names))
    made = {file.relative_to(fresh.path) for file in files(fresh.path) - before}
    assert {path.parts[0] for path in made} == {"figures", "logs", "results"}
    kinds = {"figures/case_{}.png", "figures/case_{}.pdf", "results/cases/{}.nc"}
    assert {Path(kind.format(name)) for kind in kinds for name in names} <= made


@pytest.mark.soak
@pytest.mark.workflow
def test_a_description_cannot_change_the_report(fresh):
    """What HTML, Snakemake, Jinja or TeX would read as theirs is refused."""
    before = files(fresh.path)
    case = yaml.safe_load(mutations.SHIPPED)["cases"][0]
    for text in ("<script>alert(1)</script>", "{input}", "{{ config }}", "$x^2$", "&lt;", "%(x)s"):
        fresh.set("cases", [{**case, "description": text}])
        code, said, _ = dry_run(fresh.path)
        assert code == 1
        assert "config key 'cases[0].description': " in said
    assert {path for path in files(fresh.path) - before if path.suffix != ".log"} == set()


@pytest.mark.soak
@pytest.mark.workflow
def test_values_from_the_command_line_are_checked_and_used(fresh):
    other = fresh.path / "other.yaml"
    other.write_text("fig_1_1: {theta_deg: 18}\ncases: []\n")
    done = fresh.snakemake("-n", "--configfile", "other.yaml")
    assert done.returncode == 0, done.stderr
    assert "compute_case" not in done.stdout
    done = fresh.snakemake("-n", "--config", "cases=[]")
    assert done.returncode == 1
    assert "--config cannot hold the sections" in done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    for text, message in (
        ("fig_1_1: {theta_deg: 9}\n", "config key 'fig_1_1.theta_deg': 9 is less than the minimum"),
        ("cases: []\ncases: []\n", "other.yaml line 2: key 'cases' is here for the second time"),
        ("fig_1_1: {theta_deg: 010}\n", "other.yaml line 1: YAML reads 010 as 8"),
    ):
        other.write_text(text)
        done = fresh.snakemake("-n", "--configfile", "other.yaml")
        assert done.returncode == 1
        assert message in done.stdout + done.stderr
        assert "Traceback" not in done.stdout + done.stderr
    (fresh.path / "config.yaml").unlink()
    done = fresh.snakemake("-n")
    assert "configfile config.yaml but it is not present" in done.stdout + done.stderr


@pytest.mark.workflow
def test_the_second_snakefile_checks_the_text_too(fresh):
    (fresh.path / "config.yaml").write_bytes(mutations.FILES["yte"].encode())
    done = fresh.snakemake("-n", "--snakefile", "workflow/Snakefile")
    assert done.returncode == 1
    assert "config.yaml line 1: " in done.stdout + done.stderr
    assert not list(fresh.path.rglob("pwned"))


def test_what_another_workflow_hands_over_is_checked_as_python_holds_it():
    """A module's configuration has been through somebody else's YAML, or is made by a program."""
    config = yaml.safe_load(mutations.SHIPPED)
    cycle: list[object] = []
    cycle.append(cycle)
    bomb: list[object] = [1]
    for _ in range(9):
        bomb = [bomb] * 9
    for value, problem in (
        (cycle, "is nested deeper than 20 levels"),
        (bomb, "is the last of more than 20000 values: shorten the lists"),
        (date(2026, 1, 1), "is a date: give a number, a text, a list or a mapping"),
        ({7: 1}, "has a key that is not a word: 7"),
        (1 << 100_000, "is a number of 100001 bits: give a smaller one"),
        ({1, 2}, "is a set"),
        (b"x", "is a bytes"),
        (float("-inf"), "is -inf: give a finite number"),
    ):
        config["fig_1_1"] = value
        with pytest.raises(configuration.ConfigurationError) as caught:
            configuration.check(config, SCHEMA)
        assert "config key 'fig_1_1" in str(caught.value)
        assert problem in str(caught.value)


RELATED = [
    ("radial.fig_3_1.geometry", "wedge", "'radial.fig_3_1.models': von-mises is formulated"),
    ("radial.fig_3_1.mu", [0, 0.7], "'radial.fig_3_1.mu[1]': wall friction angle phi = "),
    ("spectra.fig_4_2.mu", 0.9, "'spectra.fig_4_2.mu': wall friction angle phi = "),
    ("claims.linear.printed_at.mu", 0.9, "'claims.linear.printed_at.mu': wall friction angle"),
    ("claims.linear.smooth.nodes", 20, "'claims.linear.smooth.nodes': 20 must be more than twice"),
    ("von_mises.map.chunks", 25, "'von_mises.map.chunks': 25 is more than delta_deg has"),
    ("von_mises.map.delta_deg.start", 10, "'von_mises.map.delta_deg.start': 10 is less than"),
    ("von_mises.half_angles_deg", [10, 60], "'von_mises.half_angles_deg[1]': 60 is greater"),
    ("fig_vm_spectra.half_nodes", 20, "'fig_vm_spectra.half_nodes': 20 is not one of"),
    ("fig_vm_spectra.hoppers.elliptic.mu", 0.9, "'fig_vm_spectra.hoppers.elliptic.mu': wall"),
    ("stability_map.chunks", 121, "'stability_map.chunks': 121 is more than delta_deg has"),
    ("stability_map.delta_deg.start", 0, "'stability_map.delta_deg.start': 0 is less than"),
    ("stability_map.delta_deg.points", 10**9, "'stability_map.delta_deg.points': 1000000000 is"),
    ("stability_map.half_angles_deg", [10, 1e-5], "'stability_map.half_angles_deg[1]': 1e-05 is"),
    ("stability_map.half_angles_deg", [10, 10.0], "'stability_map.half_angles_deg': [10, 10.0]"),
    ("borders.check.coarse_nodes", 400, "'borders.check.coarse_nodes': 400 is not below nodes"),
    ("fig_jenike.friction_angles_deg.step", 30.0, None),
    ("design_charts.half_angles_deg.stop", 0.5, "'design_charts.half_angles_deg.stop': 0.5"),
    ("design_charts.flow_factors", [1.0], "'design_charts.flow_factors[0]': 1.0 is less than"),
    ("fig_jenike.friction_angles_deg.stop", 20, None),
    ("smooth_wall.delta_deg.stop", 0.25, "'smooth_wall.delta_deg.step': 0.5 must not exceed stop"),
    ("spectra.fig_4_2.nodes", 400.0, "'spectra.fig_4_2.nodes': 400.0 is not of type 'integer'"),
    ("fig_1_1.theta_deg", 28, "'fig_1_1.theta_deg': 28 must be below half_angle_deg"),
    ("fig_3_2.stagnant_from_deg", 31, "'fig_3_2.stagnant_from_deg': 31 must be below half_angle"),
    ("fig_4_5_map.color_range", [30, 0.1], "'fig_4_5_map.color_range': 30 must be below 0.1"),
]  # fmt: skip


@pytest.mark.parametrize(("key", "value", "message"), RELATED)
def test_what_a_script_could_not_do_is_refused(key, value, message):
    config = yaml.safe_load(mutations.SHIPPED)
    *parents, last = key.split(".")
    section = config
    for name in parents:
        section = section[name]
    section[last] = value
    if message is None:
        configuration.check(config, SCHEMA)
        return
    with pytest.raises(configuration.ConfigurationError) as caught:
        configuration.check(config, SCHEMA)
    assert str(caught.value).startswith(f"config key {message}")


def test_steps_do_not_pass_their_end():
    np.testing.assert_array_equal(ranges.steps(0, 89, 30), [0, 30, 60])
    assert ranges.steps(0, 0.3, 0.1).size == 4
