"""A copy of the workflow in a directory of its own, built once for all tests that only look."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PARTS = ("Snakefile", "config.yaml", "workflow", "scripts", "src", "envs", "profiles", "resources")


class Workflow:
    """A copy of the workflow and what can be done with it."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def snakemake(self, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", **variables}
        return subprocess.run(
            command, cwd=self.path, env=environment, capture_output=True, text=True, check=False
        )

    def build(self, *targets: str, **variables: str) -> None:
        done = self.snakemake(*targets, **variables)
        assert done.returncode == 0, done.stderr

    def reruns(self, *targets: str) -> set[str]:
        """Rules, with their figure if they have one, that a dry run would execute."""
        done = self.snakemake("-n", *targets)
        assert done.returncode == 0, done.stderr
        blocks = re.split(r"\n(?=(?:local)?rule )", done.stdout)
        found = set()
        for block in blocks:
            if match := re.match(r"(?:local)?rule (\w+):", block):
                figure = re.search(r"wildcards: (?:figure|case)=(\w+)", block)
                found.add(f"{match[1]}/{figure[1]}" if figure else match[1])
        return found - {"all"}

    def edit(self, file: str, old: str, new: str) -> None:
        path = self.path / file
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in {file}"
        path.write_text(text.replace(old, new), encoding="utf-8")


def copy(target: Path, *, results: Path | None = None) -> Workflow:
    """Copy the workflow's files, and the results of another copy where given."""
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
    return Workflow(target)


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Workflow:
    """The real workflow with all figures, in a path with a space. Do not change it."""
    workflow = copy(tmp_path_factory.mktemp("built") / "a path with a space")
    workflow.build()
    return workflow


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
