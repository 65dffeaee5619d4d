"""Editing one thing reruns what depends on it and nothing else: dry runs of the real workflow."""

import ast
import os
import time

import pytest

from tests.workflow.conftest import ROOT, Workflow

pytestmark = pytest.mark.workflow

LEDGER = {"judge_claims", "render_claims"}
PLOTS = {path.stem for path in (ROOT / "scripts").glob("plot_*.py")}


def test_nothing_to_do_after_a_build(built):
    assert built.reruns() == set()
    assert "Nothing to be done" in built.snakemake().stderr


def test_moving_the_clone_reruns_nothing(rebuilt):
    assert rebuilt.reruns() == set()


def test_a_figures_parameter_reruns_its_chain_only(rebuilt):
    rebuilt.set("radial.fig_3_1.mu", [0, 0.25])
    chain = {"solve_radial/fig_3_1", "plot_fig_3_1", "compute_model_checks"}
    assert rebuilt.reruns() == chain | LEDGER


def test_a_mesh_reruns_what_is_computed_on_it(rebuilt):
    rebuilt.set("spectra.fig_4_2.coarse_nodes", 42)
    rules = {job.split("/")[0] for job in rebuilt.reruns()}
    assert {"compute_spectrum", "filter_spectrum", "compute_transient"} <= rules
    assert "compute_spectrum/fig_4_2/cone/80" not in rebuilt.reruns()
    assert not rules & {"solve_radial", "compute_map_chunk", "compute_exact_spectrum"}


def test_more_rows_of_a_map_leave_the_number_of_jobs(rebuilt):
    before = [job for job in rebuilt.reruns("--forceall") if "chunk" in job]
    rebuilt.set("stability_map.delta_deg.points", 50)
    after = [job for job in rebuilt.reruns() if "chunk" in job]
    assert sorted(after) == sorted(before)


def test_a_mark_in_a_figure_reruns_its_plot_only(rebuilt):
    rebuilt.set("fig_3_2.stagnant_from_deg", 21)
    assert rebuilt.reruns() == {"plot_fig_3_2"}


def test_the_plot_style_reruns_all_plots_only(rebuilt):
    rebuilt.edit("scripts/hopper_workflow/paper.mplstyle", "font.size: 8", "font.size: 9")
    assert {job.split("/")[0] for job in rebuilt.reruns()} == PLOTS


def users_of(module: str) -> set[str]:
    """Rules whose script imports ``module``, found independently by following import statements."""

    def imports(path):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module:
                yield node.module
                yield from (f"{node.module}.{alias.name}" for alias in node.names)

    def reaches(path, seen):
        for name in imports(path):
            package, *rest = name.split(".")
            folder = "src" if package in ("hopper", "hopper_cli") else "scripts"
            file = ROOT.joinpath(folder, package, *rest)
            file = file / "__init__.py" if file.is_dir() else file.with_suffix(".py")
            if file.is_file() and name not in seen:
                seen.add(name)
                reaches(file, seen)
        return seen

    return {path.stem for path in (ROOT / "scripts").glob("*.py") if module in reaches(path, set())}


@pytest.mark.parametrize("module", ["flow_factor", "velocity", "chebyshev", "errors"])
def test_editing_a_module_reruns_exactly_its_users(rebuilt: Workflow, module: str):
    path = rebuilt.path / f"src/hopper/{module}.py"
    original = path.read_text(encoding="utf-8")
    path.write_text(original + "\n# edited\n", encoding="utf-8")
    users = users_of(f"hopper.{module}")
    assert users, "no rule uses this module"
    downstream = rebuilt.reruns()
    direct = {job.split("/")[0] for job in downstream}
    assert users <= direct
    # What reruns beyond the users does so because its input is made again.
    listing = rebuilt.snakemake("-n").stdout
    for rule in direct - users:
        block = listing[listing.index(f"rule {rule}:") :].split("\nrule ")[0]
        assert "Input files updated by another job" in block
    path.write_text(original, encoding="utf-8")
    assert rebuilt.reruns() == set(), "reverting must rerun nothing"


def test_touching_a_module_reruns_nothing(rebuilt):
    for path in (rebuilt.path / "src/hopper").rglob("*.py"):
        os.utime(path, (time.time() + 60, time.time() + 60))
    assert rebuilt.reruns() == set()


def test_one_figure_can_be_asked_for(fresh):
    assert fresh.reruns("figures/fig_3_1.png") == {"solve_radial/fig_3_1", "plot_fig_3_1"}
