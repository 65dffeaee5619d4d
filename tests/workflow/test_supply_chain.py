"""What the project is built from: hashed locks, a bill of materials; and runs without a network."""

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterable
from pathlib import Path

import pytest
import yaml
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

from hopper_workflow.publish import audit, locks
from tests.reliability import comparison, record
from tests.workflow.conftest import ROOT, Workflow, copy

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
LOCKED = {use: locks.read(ROOT / lock) for use, lock in locks.LOCKS.items()}
# Every lock holds what these parts of pyproject.toml ask for.
EXTRAS = {"run": ["workflow"], "cluster": ["workflow", "cluster"], "dev": ["workflow", "dev"],
          "docs": ["workflow", "docs"]}  # fmt: skip
SOME = ["figures/fig_3_1.png", "results/smooth_wall.nc"]


def installs() -> list[str]:
    """Return every command of the Makefile, the CI and the container files that installs."""
    places = [ROOT / "Makefile", ROOT / ".ci/run", *ROOT.glob(".github/workflows/*")]
    makefile = (ROOT / "Makefile").read_text()
    pip = re.search(r"^PIP := (.*)$", makefile, re.MULTILINE)
    assert pip
    text = "\n".join(place.read_text() for place in places).replace("$(PIP)", pip[1])
    return [
        line
        for line in text.splitlines()
        if re.search(r"\bpip3? install|\b(pipx|conda|uv) .*install", line)
    ]


def test_installs_come_from_hashed_locks_only():
    # What users do without the workflow, tried in CI, takes the newest packages.
    users = 'run: python -m pip install ".[plot,data]"'
    commands = [line for line in installs() if not line.startswith("PIP :=") and users not in line]
    assert len(commands) >= 5
    for command in commands:
        if re.search(r"-e \.$", command):
            assert "--no-deps --no-build-isolation" in command
        else:
            assert "--require-hashes --no-build-isolation" in command
            assert re.search(r"-r requirements[a-z-]*\.lock$", command), command
    used = {found for line in commands for found in re.findall(r"requirements[a-z-]*\.lock", line)}
    assert used <= set(locks.LOCKS.values())


def test_the_locks_hold_pins_with_hashes_and_no_address():
    assert {path.name for path in ROOT.glob("requirements*")} == set(locks.LOCKS.values())
    digests: set[str] = set()
    addresses = 0
    for use, packages in LOCKED.items():
        text = (ROOT / locks.LOCKS[use]).read_text()
        assert text.count("==") >= len(packages) > 0
        assert text.count("--hash=") == sum(len(package.hashes) for package in packages)
        addresses += len(re.findall(r"://|@|--index|--extra|--find|-e |-r |-c ", text))
        digests |= {digest for package in packages for digest in package.hashes}
    pinned = {package for packages in LOCKED.values() for package in packages}
    bare = sum(not package.hashes for package in pinned)
    assert (addresses, bare) == (0, 0)
    record(
        "supply_chain",
        "Every package that `make` installs is pinned by version and hash; the locks, "
        "pyproject.toml and envs/ agree.",
        {
            "locks": len(LOCKED),
            "packages": len({(package.name, package.version) for package in pinned}),
            "hashes": len(digests),
            "packages without hash": bare,
            "addresses of registries": addresses,
        },
    )


@pytest.mark.parametrize(
    "line",
    ["numpy>=2", "numpy==2.4.6", "--index-url x", "numpy @ file:///x", "numpy==2 --hash=md5:0"],
)
def test_what_is_not_a_pin_with_hashes_is_refused(line, tmp_path):
    lock = tmp_path / "some.lock"
    lock.write_text(f"{line}\n")
    with pytest.raises(locks.LockError, match=r"some.lock: .* is not a pin with hashes"):
        locks.read(lock)


@pytest.mark.parametrize("use", EXTRAS)
def test_the_lock_holds_what_the_project_asks_for(use):
    wanted = PROJECT["dependencies"] + [
        one for extra in EXTRAS[use] for one in PROJECT["optional-dependencies"][extra]
    ]
    for requirement in wanted:
        found = re.fullmatch(r"([\w-]+)(?:>=([\d.]+))?", requirement)
        assert found, requirement
        locked = [one.version for one in LOCKED[use] if one.name == found[1].lower()]
        least = _numbers(found[2] or "0")
        assert locked, f"{requirement} is not locked"
        assert all(_numbers(version) >= least for version in locked), f"{requirement}: {locked}"


def _numbers(version: str) -> list[int]:
    return [int(part) for part in re.findall(r"\d+", version)]


def test_the_locks_agree_with_each_other():
    for use in ("dev", "cluster", "docs"):
        missing = set(LOCKED["run"]) - set(LOCKED[use])
        assert not missing, use


def test_the_conda_pins_equal_the_lock():
    environment = yaml.safe_load((ROOT / "envs/hopper.yaml").read_text())
    pins = dict(pin.split("=") for pin in environment["dependencies"])
    assert PROJECT["requires-python"] == f">={pins.pop('python')}"
    for name, wanted in pins.items():
        locked = [package.version for package in LOCKED["run"] if package.name == name]
        assert any(version.startswith(wanted) for version in locked), f"{name}: lock has {locked}"


@pytest.fixture
def materials(tmp_path: Path) -> Path:
    """The bill of materials, written in a copy of the locks."""
    for name in ["pyproject.toml", *locks.LOCKS.values()]:
        shutil.copy2(ROOT / name, tmp_path / name)
    assert publish("sbom", tmp_path) == (0, "results/sbom.cdx.json\n", "")
    return tmp_path / "results/sbom.cdx.json"


def publish(what: str, directory: Path, **variables: str) -> tuple[int, str, str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "scripts"), **variables}
    done = subprocess.run(
        [sys.executable, "-m", f"hopper_workflow.publish.{what}"],
        cwd=directory, env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def test_the_bill_of_materials_follows_its_schema_and_holds_every_package(materials):
    text = materials.read_text()
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(text) is None
    wrong = text.replace('"name": "numpy"', '"title": "numpy"')
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(wrong) is not None
    components = json.loads(text)["components"]
    found = {(one["name"], one["version"]): one for one in components}
    for use, packages in LOCKED.items():
        for package in packages:
            component = found[package.name, package.version]
            assert {one["content"] for one in component["hashes"]} >= set(package.hashes)
            assert (component["scope"] == "required") == (package in LOCKED["run"])
            assert use in component["properties"][0]["value"].split()
    uses = next(one for one in json.loads(text)["dependencies"] if one["ref"] == PROJECT["name"])
    asked = PROJECT["dependencies"] + PROJECT["optional-dependencies"]["workflow"]
    names = {re.sub("@.*", "", one).removeprefix("pkg:pypi/") for one in uses["dependsOn"]}
    assert names == {re.sub(">=.*", "", one).lower() for one in asked}


def test_the_same_locks_give_the_same_bill(materials):
    before = materials.read_bytes()
    assert publish("sbom", materials.parents[1], PYTHONHASHSEED="7")[0] == 0
    assert materials.read_bytes() == before


def test_without_a_lock_there_is_no_bill(tmp_path):
    code, _, said = publish("sbom", tmp_path)
    assert code == 1
    assert said.startswith("results/sbom.cdx.json not written: ")
    assert said.count("\n") == 1
    assert not list(tmp_path.rglob("*"))


def tool(directory: Path, script: str) -> str:
    """Put a stand-in for pip-audit into a directory, and return the path to find it by."""
    path = directory / "pip-audit"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return f"{directory}:{os.environ['PATH']}"


SILENCE = "audit skipped: pip-audit could not ask about requirements.lock: "
NOTHING = json.dumps({"dependencies": [{"name": "numpy", "version": "2", "vulns": []}]})
SOMETHING = json.dumps(
    {"dependencies": [{"name": "numpy", "version": "2", "vulns": [{"id": "CVE-1"}, {"id": "X-2"}]}]}
)


@pytest.mark.skipif(audit.find_tool() is not None, reason="pip-audit is installed")
@pytest.mark.parametrize(
    ("script", "code", "said"),
    [
        (f"echo '{NOTHING}'", 0, "no known vulnerabilities in the locks\n"),
        (f"echo '{SOMETHING}'; exit 1", 1, "numpy 2: CVE-1, X-2\n"),
        ("echo first >&2; echo ConnectionError >&2; exit 1", 0,
         SILENCE + "ConnectionError\n"),
        ("exit 3", 0, SILENCE + "it said nothing\n"),
    ],
)  # fmt: skip
def test_the_audit_tells_vulnerabilities_from_silence(script, code, said, tmp_path):
    assert publish("audit", ROOT, PATH=tool(tmp_path, script)) == (code, said, "")


@pytest.mark.skipif(audit.find_tool() is not None, reason="pip-audit is installed")
def test_the_audit_does_without_its_tool():
    code, said, error = publish("audit", ROOT)
    assert (code, error) == (0, "")
    assert said == "audit skipped: pip-audit is not installed (pipx install pip-audit)\n"


OFFLINE = ["unshare", "--map-root-user", "--net"]


@pytest.fixture
def offline() -> list[str]:
    """A prefix of commands that leaves them no network, not even the loopback."""
    probe = "import socket; socket.create_connection(('127.0.0.1', 9), 1)"
    try:
        done = subprocess.run(
            [*OFFLINE, sys.executable, "-c", probe], capture_output=True, text=True, check=False
        )
    except FileNotFoundError:
        pytest.skip("unshare is not installed")
    if "Network is unreachable" not in done.stderr:
        pytest.skip(f"network namespaces are not permitted: {done.stderr.strip()[-100:]}")
    return OFFLINE


def run(offline: list[str], workflow: Workflow, *arguments: str) -> None:
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    environment["PYTHONPATH"] = str(workflow.path / "scripts")
    command = [*offline, sys.executable, "-m", *arguments]
    done = subprocess.run(
        command, cwd=workflow.path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.workflow
def test_some_figures_are_made_without_a_network(offline, built, fresh):
    run(offline, fresh, "snakemake", "--cores", "2", *SOME)
    made, expected = fresh.products(), built.products()
    assert set(SOME) <= set(made)
    assert made == {name: expected[name] for name in made}
    record_offline("no_network", made, expected, SOME)


@pytest.mark.soak
@pytest.mark.workflow
def test_report_and_crate_are_made_without_a_network(offline, rebuilt):
    for what in ("report", "crate"):
        run(offline, rebuilt, f"hopper_workflow.publish.{what}")
    assert (rebuilt.path / "results/report.html").stat().st_size > 100_000
    assert (rebuilt.path / "results/hopper-crate.zip").stat().st_size > 100_000


@pytest.mark.soak
@pytest.mark.workflow
def test_everything_is_made_without_a_network(offline, built, tmp_path):
    workflow = copy(tmp_path / "offline")
    run(offline, workflow, "snakemake", "--cores", "2")
    made, expected = workflow.products(), built.products()
    assert made == expected
    assert len(made) > 80
    record_offline("no_network_long", made, expected, expected)


def record_offline(
    name: str, made: dict[str, str], expected: dict[str, str], wanted: Iterable[str]
) -> None:
    record(
        name,
        "Snakemake in a network namespace without a network, loopback included, against a run "
        "outside of it.",
        comparison(made, expected, wanted),
    )
