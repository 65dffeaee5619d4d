"""Who may import whom, and how long files and functions may be; the checks can fail."""

import ast
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


def contract(number=0):
    return tomllib.loads(PYPROJECT.read_text())["tool"]["importlinter"]["contracts"][number]


def test_contract_holds():
    result = lint_imports(ROOT / "src")
    assert result.returncode == 0, result.stdout
    assert "0 broken" in result.stdout


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


@pytest.fixture
def sources(tmp_path):
    """A copy of the packages."""
    shutil.copytree(ROOT / "src", tmp_path / "src")
    return tmp_path / "src"


@pytest.mark.parametrize("forbidden", ["xarray", "pathlib", "hopper_cli"])
def test_contract_can_break(forbidden, sources):
    package = sources / "hopper"
    (package / "arrays.py").write_text(
        f"import {forbidden}\n" + (package / "arrays.py").read_text()
    )
    result = lint_imports(sources)
    assert result.returncode == 1, result.stdout
    assert f"hopper is not allowed to import {forbidden}" in result.stdout
    assert f"hopper.arrays -> {forbidden}" in result.stdout


LAYERS = [name for floor in contract(1)["layers"] for name in floor.split(" | ")]


def test_layers_are_those_of_the_house():
    """And all of them: `exhaustive` makes import-linter refuse a room that has no floor."""
    assert contract(1)["exhaustive"]
    rooms = {path.stem for path in (ROOT / "src/hopper").iterdir() if path.name[0] not in "_p"}
    rooms |= {"problem"}
    assert set(LAYERS) == rooms


@pytest.mark.parametrize(
    ("lower", "upper"),
    [
        ("errors", "spectral.chebyshev"),
        ("spectral.chebyshev", "radial.grid"),
        ("radial.velocity", "stability.modes"),
        ("stability.modes", "march.outcome"),
        ("march.outcome", "domain.borders"),
        ("domain.borders", "evidence.motion"),
        ("evidence.motion", "assessment.quantity"),
    ],
)
def test_a_room_must_not_import_from_above(lower, upper, sources):
    path = sources.joinpath("hopper", *lower.split(".")).with_suffix(".py")
    with path.open("a") as file:
        file.write(f"\nimport hopper.{upper}\n")
    result = lint_imports(sources)
    assert result.returncode == 1, result.stdout
    room, above = lower.split(".")[0], upper.split(".")[0]
    assert f"hopper.{room} is not allowed to import hopper.{above}" in result.stdout


CODE = sorted([*(ROOT / "src").rglob("*.py"), *(ROOT / "scripts").rglob("*.py")])
LONGEST_FILE, LONGEST_FUNCTION = 350, 40
REASON = "# long because "


def _lines(node):
    return node.end_lineno - node.lineno + 1


@pytest.mark.parametrize("path", CODE, ids=lambda path: str(path.relative_to(ROOT)))
def test_files_and_functions_are_short_or_say_why_not(path):
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    assert len(lines) <= LONGEST_FILE or REASON in text
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            length = _lines(node)
            if ast.get_docstring(node) is not None:
                length -= _lines(node.body[0])
            reason = any(REASON in line for line in lines[node.lineno - 2 : node.end_lineno])
            assert length <= LONGEST_FUNCTION or reason, f"{node.name} has {length} lines"
