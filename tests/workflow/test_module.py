"""The workflow as a module of another: from a clone, and from a repository on GitHub."""

import shutil
import subprocess
from pathlib import Path

import netCDF4
import pytest
import yaml

from tests.workflow.conftest import Workflow, copy

pytestmark = pytest.mark.workflow

FROM_CLONE = """
configfile: "silos.yaml"

module hopper:
    snakefile: {clone!r} + "/Snakefile"
    config: config["hopper"]
    prefix: "silo"

use rule * from hopper as hopper_*

rule mine:
    default_target: True
    input: "silo/figures/fig_3_1.png"
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
    assert {"hopper_plot_fig_4_5_map", "hopper_compute_flow_factor"} <= everything
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


def test_a_bad_configuration_of_a_module_is_named(fresh, other):
    config = yaml.safe_load((fresh.path / "config.yaml").read_text())
    config["radial"]["fig_3_1"]["mu"] = "steep"
    (other.path / "silos.yaml").write_text(yaml.safe_dump({"hopper": config}))
    (other.path / "Snakefile").write_text(FROM_CLONE.format(clone=str(fresh.path)))
    done = other.snakemake()
    assert done.returncode != 0
    assert "config key 'radial.fig_3_1.mu': 'steep' is not of type 'array'" in done.stderr
    assert "Traceback" not in done.stderr


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
