"""The numerics import no files, no plots, no workflow; and the check of that can fail."""

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).parents[1]
PYPROJECT = ROOT / "pyproject.toml"
LINT_IMPORTS = Path(sys.executable).with_name("lint-imports")


def lint_imports(folder):
    """Run import-linter with the project's contract on the package found in ``folder``."""
    return subprocess.run(
        [LINT_IMPORTS, "--no-cache", "--config", PYPROJECT],
        cwd=folder,
        env={"PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
    )


def contract():
    return tomllib.loads(PYPROJECT.read_text())["tool"]["importlinter"]["contracts"][0]


def test_contract_holds():
    result = lint_imports(ROOT / "src")
    assert result.returncode == 0, result.stdout
    assert "2 kept, 0 broken" in result.stdout


def test_contract_forbids_what_the_numerics_must_not_know():
    assert contract()["source_modules"] == ["hopper"]
    assert set(contract()["forbidden_modules"]) >= {
        "hopper_cli",
        "snakemake",
        "xarray",
        "netCDF4",
        "pandas",
        "matplotlib",
        "pathlib",
        "json",
    }


def test_contract_covers_every_module():
    modules = grimp.build_graph("hopper", cache_dir=None).find_descendants("hopper")
    files = {path.relative_to(ROOT / "src") for path in (ROOT / "src/hopper").rglob("*.py")}
    names = {".".join(file.with_suffix("").parts).removesuffix(".__init__") for file in files}
    assert modules == names - {"hopper"}


@pytest.mark.parametrize("forbidden", ["xarray", "pathlib", "hopper_cli"])
def test_contract_can_break(forbidden, tmp_path):
    shutil.copytree(ROOT / "src", tmp_path, dirs_exist_ok=True)
    package = tmp_path / "hopper"
    (package / "files.py").write_text(f"import {forbidden}\n")
    with (package / "radial.py").open("a") as file:
        file.write("\nfrom hopper import files\n")
    result = lint_imports(tmp_path)
    assert result.returncode == 1, result.stdout
    assert f"hopper is not allowed to import {forbidden}" in result.stdout
    assert f"hopper.files -> {forbidden}" in result.stdout
