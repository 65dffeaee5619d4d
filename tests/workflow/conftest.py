"""A copy of the workflow in a directory of its own, built once for all tests that only look."""

import fcntl
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from hopper_workflow.logs import checksum

ROOT = Path(__file__).parents[2]
CHECK = {"points": 1, "nodes": 80, "coarse_nodes": 40, "tolerance": 0.001}
PARTS = ("Snakefile", "config.yaml", "workflow", "scripts", "src", "envs", "profiles", "resources",
         "config", "Makefile", "pyproject.toml", "requirements-build.lock", "requirements.lock",
         "README.md", "LICENSE", "CITATION.cff")  # fmt: skip
# Numbers that make every rule run in about a second.
COARSE: dict[str, Any] = {
    "fig_jenike.friction_angles_deg.step": 10,
    "design_charts.deltas_deg": [40],
    "design_charts.half_angles_deg.points": 3,
    "design_charts.frictions": 4,
    "smooth_wall.half_angles_deg.step": 9,
    "spectra.fig_4_2.nodes": 80,
    "spectra.fig_4_2.coarse_nodes": 40,
    "spectra.fig_4_2.exact_modes": 12,
    "transient.fig_4_3.elapsed.points": 11,
    "transient.fig_4_3_norms.elapsed.points": 5,
    "pseudospectrum.fig_pseudospectrum.real.points": 8,
    "pseudospectrum.fig_pseudospectrum.imag.points": 8,
    "sensitivity.frequencies.points": 11,
    "sensitivity.elapsed.points": 5,
    "march_breakdown.fig_march_breakdown.depth": 0.05,
    "march_decay.fig_march_decay.eps": [0.05],
    "march_decay.fig_march_decay.depth": 0.1,
    "march_amplitude.fig_march_breakdown_amplitude.eps": [0.5, 0.7],
    "march_amplitude.fig_march_breakdown_amplitude.cells": 16,
    "march_depth.fig_march_depth.hoppers": [
        {"geometry": "cone", "delta_deg": 40, "half_angle_deg": 15, "mu": 0.1}
    ],
    "march_depth.fig_march_depth.tops": [{"name": "scaled", "factor": 0.8}, {"name": "bin"}],
    "march_depth.fig_march_depth.depth": 1.0,
    "friction_curves.fig_4_4.mu.points": 8,
    "friction_curves.fig_4_4.check": CHECK,
    "friction_curves.fig_4_4_30.mu.points": 8,
    "friction_curves.fig_4_4_30.check": CHECK,
    "friction_curves.fig_4_4.second_row.points": 8,
    "friction_curves.fig_4_4_30.second_row.points": 8,
    "stability_map.delta_deg.points": 7,
    "stability_map.phi_deg.points": 7,
    "borders.neutral_step_deg": 4,
    "borders.delta_deg.points": 5,
    "borders.chord_deg": 10,
    "borders.check": CHECK,
    "paper_border.frictions": 2,
    "paper_border.delta_deg.step": 12,
    "paper_border.width_deg": 1,
    "paper_border.nodes": 80,
    "paper_border.coarse_nodes": 40,
    "domain_angle.half_angles_deg": [10, 30],
    "domain_angle.neutral_step_deg": 4,
    "domain_angle.curve_points": 3,
    "von_mises.map.delta_deg.points": 5,
    "von_mises.map.phi_deg.points": 4,
    "von_mises.domain.border_points": 4,
    "von_mises.domain.neutral_step_deg": 16,
    "von_mises.domain.edge_points": 1,
    "von_mises.domain.decay": {"rows": 4, "frictions": 3},
    "fig_vm_spectra.half_nodes": 24,
    "claims.models.deltas_deg.step": 20,
    "claims.models.psi_points": 4,
    "claims.linear.folds.half_angles_deg": [10],
    "claims.linear.folds.deltas_deg.step": 10,
    "claims.linear.windows.points": 11,
}
# A Snakefile that takes the workflow of a clone as a module.
HOST = """
configfile: "silos.yaml"

module hopper:
    snakefile: {clone!r} + "/Snakefile"
    config: config["hopper"]
    prefix: "silo"

use rule * from hopper as hopper_*
"""


class Workflow:
    """A copy of the workflow and what can be done with it."""

    def __init__(self, path: Path, python: str | Path = sys.executable) -> None:
        self.path, self.python = path, str(python)

    def snakemake(self, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
        command = [self.python, "-m", "snakemake", "--cores", "2", *arguments]
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", **variables}
        return subprocess.run(
            command, cwd=self.path, env=environment, capture_output=True, text=True, check=False
        )

    def publish(
        self, what: str, *arguments: str, **variables: str
    ) -> subprocess.CompletedProcess[str]:
        """Write the report or the crate."""
        command = [self.python, "-m", f"hopper_workflow.publish.{what}", *arguments]
        environment = {**os.environ, "PYTHONPATH": str(self.path / "scripts"), **variables}
        return subprocess.run(
            command, cwd=self.path, env=environment, capture_output=True, text=True, check=False
        )

    def build(self, *targets: str, **variables: str) -> None:
        done = self.snakemake(*targets, **variables)
        assert done.returncode == 0, done.stderr

    def products(self) -> dict[str, str]:
        """Return the checksum of every artifact, table and figure that exists, by its path.

        What tells of the time, provenance and logs, is left out; so are the hidden leftovers of
        writers that were killed.
        """
        patterns = ("results/**/*.nc", "results/claims.*", "figures/*.p*")
        paths = sorted(path for pattern in patterns for path in self.path.glob(pattern))
        return {
            str(path.relative_to(self.path)): checksum(path)
            for path in paths
            if not path.name.startswith(".")
        }

    def reruns(self, *targets: str) -> set[str]:
        """Rules, with their figure if they have one, that a dry run would execute."""
        done = self.snakemake("-n", *targets)
        assert done.returncode == 0, done.stderr
        # The host of a module prints the messages of rules, which begin like this.
        found = set(re.findall(r"^Job \d+: (\S+):", done.stdout, re.MULTILINE))
        for block in re.split(r"\n(?=(?:local)?rule )", done.stdout):
            if match := re.match(r"(?:local)?rule (\w+):", block):
                wildcards = re.search(r"wildcards: (.*)", block)
                values = re.findall(r"=([^,\s]+)", wildcards[1]) if wildcards else []
                found.add("/".join([match[1], *values]))
        return found - {"all"}

    def set(self, key: str, value: Any) -> None:
        """Change one value of config.yaml."""
        path = self.path / "config.yaml"
        config = yaml.safe_load(path.read_text(encoding="utf-8"))
        *parents, last = key.split(".")
        section = config
        for name in parents:
            section = section[name]
        section[last] = value
        path.write_text(yaml.safe_dump(config, sort_keys=False), encoding="utf-8")

    def edit(self, file: str, old: str, new: str) -> None:
        path = self.path / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file}"
        path.write_text(text.replace(old, new), encoding="utf-8")


def copy(target: Path, *, results: Path | None = None, coarse: bool = True) -> Workflow:
    """Copy the workflow, with coarse numbers, and the results of another copy where given."""
    target.mkdir(parents=True)
    for part in PARTS:
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(
                source, target / part, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info")
            )
        else:
            shutil.copy2(source, target / part)
    if results is not None:
        for part in ("results", "figures", "logs", ".snakemake"):
            shutil.copytree(results / part, target / part)
    workflow = Workflow(target)
    if coarse:
        for key, value in COARSE.items():
            workflow.set(key, value)
    return workflow


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Workflow:
    """The real workflow with all figures, in a path with a space. Do not change it.

    Of the processes that run tests the first to ask builds it, the others wait for it.
    """
    own = tmp_path_factory.getbasetemp()
    shared = own if worker_id == "master" else own.parent
    path, complete = shared / "built/a path with a space", shared / "built/complete"
    with (shared / "built.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not complete.exists():
            shutil.rmtree(path, ignore_errors=True)
            python = interpreter(shared / "built/python", RECORDER)
            (shared / "built/loaded").mkdir(exist_ok=True)
            workflow = Workflow(copy(path).path, python)
            workflow.build(LOADED_BY=str(shared / "built/loaded"))
            complete.touch()
    return Workflow(path)


# At its end a job notes the modules it has loaded.
RECORDER = """
import atexit, os, sys

def record():
    job = vars(sys.modules["__main__"]).get("snakemake")
    if hasattr(job, "rule"):
        files = {getattr(m, "__file__", None) for n, m in sys.modules.items() if n[:6] == "hopper"}
        with open(os.path.join(os.environ["LOADED_BY"], job.rule), "a") as log:
            log.writelines(f"{os.path.relpath(file)}\\n" for file in files - {None})

atexit.register(record)
"""


def interpreter(folder: Path, code: str) -> Path:
    """Return a Python with the packages of this one that runs code whenever it starts.

    Jobs inherit no variable by which that could be done.
    """
    venv.create(folder, clear=True, symlinks=True)
    (site,) = folder.glob("lib/python*/site-packages")
    (site / "packages.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    # No sitecustomize: that of the system comes first where it has one.
    (site / "at_start.pth").write_text("import at_start\n", encoding="utf-8")
    (site / "at_start.py").write_text(code, encoding="utf-8")
    return folder / "bin/python"


def with_make(
    workflow: Workflow, *goals: str, variables: dict[str, str] | None = None, umask: int = 0o022
) -> subprocess.CompletedProcess[str]:
    """Run make in a copy of the workflow, with an environment that need not be installed."""
    folder = workflow.path / ".venv"
    if not folder.exists():
        interpreter(folder, "")
        (folder / "place").write_text(f"{workflow.path.resolve()}\n")
        (folder / "run.stamp").touch()
    return subprocess.run(
        ["make", "-s", *goals],
        cwd=workflow.path,
        env={**os.environ, **(variables or {})},
        umask=umask,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="session")
def loaded(built: Workflow) -> dict[str, set[str]]:
    """The project's modules, as paths, that jobs of each rule really loaded."""
    folder = built.path.parent / "loaded"
    return {path.name: set(path.read_text().split()) for path in folder.iterdir()}


@pytest.fixture
def rebuilt(built: Workflow, tmp_path: Path) -> Workflow:
    """A copy of ``built``, results included, to change at will."""
    return copy(tmp_path / "another path", results=built.path)


@pytest.fixture
def fresh(tmp_path: Path) -> Workflow:
    """The workflow without results."""
    return copy(tmp_path / "fresh")


@pytest.fixture
def copy_workflow() -> Callable[..., Workflow]:
    return copy
