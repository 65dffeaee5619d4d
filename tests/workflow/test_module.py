"""The workflow as a module of another: from a clone, and from a repository on GitHub."""

import shutil
import subprocess
from pathlib import Path

import netCDF4
import pytest
import yaml

from tests.workflow.conftest import HOST, Workflow, copy

pytestmark = pytest.mark.workflow

FROM_CLONE = (
    HOST
    + """
rule mine:
    default_target: True
    input: "silo/figures/fig_3_1.png"
"""
)
# A host with packages of the names that ours once had, and a job of its own.
WITH_ITS_OWN_PACKAGES = """
import os
import sys

sys.path.insert(0, os.path.abspath("lib"))
import support

before = list(sys.path), dict(os.environ), set(sys.modules)

module hopper:
    snakefile: {clone!r} + "/Snakefile"
    config: {{**{config!r}}}
    prefix: "silo"

use rule * from hopper as hopper_*

import claims
assert (support.whose, claims.whose) == ("the host's", "the host's")
assert list(sys.path) == before[0], set(sys.path) ^ set(before[0])
assert dict(os.environ) == before[1], set(os.environ.items()) ^ set(before[1].items())
new = [sys.modules[name] for name in set(sys.modules) - before[2]]
ours = {{m.__name__.partition(".")[0] for m in new if {clone!r} in str(getattr(m, "__file__", ""))}}
assert ours <= {{"hopper", "hopper_data", "hopper_cli", "hopper_workflow"}}, ours

rule mine:
    default_target: True
    input: "silo/figures/fig_1_1.png"
    output: "mine.txt"
    script: "lib/mine.py"
"""
ITS_JOB = """
import os
import sys

import claims
import support

seen = [support.whose, claims.whose, os.environ.get("PYTHONPATH", "none"), *sys.path]
open(snakemake.output[0], "w").write("\\n".join(seen))
"""
# What snakedeploy writes.
FROM_GITHUB = """
configfile: "config/config.yaml"

module hopper:
    snakefile: github("somebody/hopper", path="workflow/Snakefile", tag="v1")
    config: config

use rule * from hopper
"""


@pytest.fixture
def other(tmp_path: Path) -> Workflow:
    """Somebody's own directory."""
    path = tmp_path / "somebody's silos"
    path.mkdir()
    return Workflow(path)


def test_another_workflow_uses_a_clone_with_its_own_numbers_and_prefix(fresh, other):
    config = yaml.safe_load((fresh.path / "config.yaml").read_text())
    config["radial"]["fig_3_1"] |= {"delta_deg": 35, "mu": [0.1], "points": 11}
    (other.path / "silos.yaml").write_text(yaml.safe_dump({"hopper": config, "mine": 1}))
    (other.path / "Snakefile").write_text(FROM_CLONE.format(clone=str(fresh.path)))
    everything = other.reruns("hopper_all")
    assert {"plot_fig_4_5_map", "compute_flow_factor"} <= everything
    assert "mine" not in everything
    other.build()
    with netCDF4.Dataset(other.path / "silo/results/radial/fig_3_1.nc") as data:
        assert data["mu"][:].tolist() == [0.1]
        assert '"delta_deg": 35' in data.parameters
    for suffix in ("png", "pdf"):
        assert (other.path / f"silo/figures/fig_3_1.{suffix}").is_file()
    assert other.reruns() == set()
    assert not (fresh.path / "results").exists()
    assert not (other.path / "results").exists()


def test_a_host_keeps_its_packages_its_path_and_its_environment(fresh, other):
    for package in ("support", "claims"):
        folder = other.path / "lib" / package
        folder.mkdir(parents=True)
        (folder / "__init__.py").write_text('whose = "the host\'s"\n')
    (other.path / "lib/mine.py").write_text(ITS_JOB)
    config = yaml.safe_load((fresh.path / "config.yaml").read_text())
    (other.path / "Snakefile").write_text(
        WITH_ITS_OWN_PACKAGES.format(clone=str(fresh.path), config=config)
    )
    other.build()
    seen = (other.path / "mine.txt").read_text()
    assert seen.startswith("the host's\nthe host's\nnone\n")
    assert str(fresh.path) not in seen


def test_a_bad_configuration_of_a_module_is_named(fresh, other):
    config = yaml.safe_load((fresh.path / "config.yaml").read_text())
    config["radial"]["fig_3_1"]["mu"] = "steep"
    (other.path / "silos.yaml").write_text(yaml.safe_dump({"hopper": config}))
    (other.path / "Snakefile").write_text(FROM_CLONE.format(clone=str(fresh.path)))
    done = other.snakemake()
    assert done.returncode != 0
    assert "config key 'radial.fig_3_1.mu': 'steep' is not of type 'array'" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.soak
@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_another_workflow_uses_a_tag_on_github(other, tmp_path, monkeypatch):
    clone = copy(tmp_path / "github/somebody/hopper").path
    identity = ("-c", "user.name=Somebody", "-c", "user.email=somebody@example.org")
    for command in (["init", "-q"], ["add", "-A"], ["commit", "-qm", "Hoppers"], ["tag", "v1"]):
        subprocess.run(["git", *identity, *command], cwd=clone, check=True)
    # Git answers for GitHub from the folder beside; Snakemake's cache of clones starts empty.
    monkeypatch.setenv("GIT_CONFIG_COUNT", "1")
    monkeypatch.setenv("GIT_CONFIG_KEY_0", f"url.{(tmp_path / 'github').as_uri()}/.insteadOf")
    monkeypatch.setenv("GIT_CONFIG_VALUE_0", "https://github.com/")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    shutil.copytree(clone / "config", other.path / "config")
    (other.path / "workflow").mkdir()
    (other.path / "workflow/Snakefile").write_text(FROM_GITHUB)
    assert {"solve_radial/fig_3_1", "plot_fig_1_1"} <= other.reruns()
    other.build("figures/fig_1_1.png")
    assert (other.path / "figures/fig_1_1.png").is_file()


def test_the_folder_the_catalog_looks_in_runs_the_same_rules(fresh):
    jobs = [fresh.reruns(), fresh.reruns("--snakefile", "workflow/Snakefile")]
    assert jobs[0] == jobs[1]
    assert len(jobs[0]) > 50
