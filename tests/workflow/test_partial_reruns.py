"""Editing one thing reruns what depends on it and nothing else: dry runs of the real workflow."""

import os
import re
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
    chain = {"solve_radial/fig_3_1", "plot_fig_3_1/fig_3_1", "compute_model_checks"}
    assert rebuilt.reruns() == chain | LEDGER


def test_a_mesh_reruns_what_is_computed_on_it(rebuilt):
    rebuilt.set("spectra.fig_4_2.coarse_nodes", 42)
    rules = {job.split("/")[0] for job in rebuilt.reruns()}
    assert {"compute_spectrum", "filter_spectrum", "compute_transient"} <= rules
    assert "compute_spectrum/fig_4_2/cone/80" not in rebuilt.reruns()
    assert not rules & {"solve_radial", "compute_map_chunk", "compute_exact_spectrum"}


def test_more_rows_of_a_map_leave_the_number_of_jobs(rebuilt):
    before = [job for job in rebuilt.reruns("--forceall") if "map_chunk" in job]
    rebuilt.set("stability_map.delta_deg.points", 50)
    after = [job for job in rebuilt.reruns() if "map_chunk" in job]
    assert sorted(after) == sorted(before)


def test_a_mark_in_a_figure_reruns_its_plot_only(rebuilt):
    rebuilt.set("fig_3_2.stagnant_from_deg", 21)
    assert rebuilt.reruns() == {"plot_fig_3_2/fig_3_2"}


def test_the_plot_style_reruns_all_plots_only(rebuilt):
    rebuilt.edit("src/hopper_cli/paper.mplstyle", "font.size: 8", "font.size: 9")
    assert {job.split("/")[0] for job in rebuilt.reruns()} == PLOTS


MODULES = {
    str(path.relative_to(ROOT))
    for folder in ("src", "scripts/hopper_workflow")
    for path in (ROOT / folder).rglob("*.py")
}


def test_editing_a_module_reruns_the_rules_whose_scripts_load_it(rebuilt: Workflow, loaded):
    """All modules are edited at once: a dry run names each job's inputs and which are changed.

    Of a job that reruns because of another one it names the inputs only.
    """
    for module in MODULES:
        path = rebuilt.path / module
        path.write_text(path.read_text(encoding="utf-8") + "\n# edited\n", encoding="utf-8")
    inputs: dict[str, set[str]] = {}
    for block in re.split(r"\n(?=(?:local)?rule )", rebuilt.snakemake("-n").stdout):
        if listed := re.match(r"rule (\w+):.*\n    input: (.*)\n", block):
            rule, files = listed[1], set(listed[2].split(", ")) & MODULES
            assert inputs.setdefault(rule, files) == files, f"jobs of {rule} differ"
            if changed := re.search(r"reason: Updated input files: ([^;\n]*)", block):
                assert set(changed[1].split(", ")) & MODULES == files, rule
    del inputs["all"]
    assert set(inputs) == set(loaded)
    for rule, files in inputs.items():
        assert files == loaded[rule], rule


def test_editing_what_only_plots_load_draws_all_figures_anew(rebuilt):
    rebuilt.edit(
        "scripts/hopper_workflow/plotting.py", "PAGE_WIDTH = 3.4, 7.1", "PAGE_WIDTH = 3.4, 7.2"
    )
    assert {job.split("/")[0] for job in rebuilt.reruns()} == PLOTS


def test_reverting_a_module_reruns_nothing(rebuilt: Workflow):
    path = rebuilt.path / "src/hopper/radial/flow_factor.py"
    original = path.read_text(encoding="utf-8")
    path.write_text(original + "\n# edited\n", encoding="utf-8")
    assert {"compute_flow_factor", "plot_fig_jenike", "compute_case/steel_cone"} <= rebuilt.reruns()
    assert not rebuilt.reruns() & {"compute_smooth_wall", "plot_fig_1_1", "solve_radial/fig_3_1"}
    path.write_text(original, encoding="utf-8")
    assert rebuilt.reruns() == set()


@pytest.mark.parametrize("plot", sorted(PLOTS))
def test_a_plot_loads_no_numerics(loaded, plot):
    """Else every change of the numerics would draw every figure anew."""
    numerics = {file for file in loaded[plot] if file.startswith("src/hopper/")}
    assert numerics <= {"src/hopper/__init__.py", "src/hopper/errors.py"} | CASE_NEEDS.get(
        plot, set()
    )


# The page of a case writes numbers with their errors, as the command does.
CASE_NEEDS = {"plot_case": {"src/hopper/brief.py", "src/hopper/quantity.py"}}


def test_touching_files_reruns_nothing(rebuilt):
    """Modules, the rules' own scripts, the rules, the configuration."""
    touched = ("src/**/*.py", "scripts/**/*", "workflow/**/*.smk", "Snakefile", "config.yaml")
    for path in (path for pattern in touched for path in rebuilt.path.glob(pattern)):
        os.utime(path, (time.time() + 60, time.time() + 60))
    assert rebuilt.reruns() == set()


def test_one_figure_can_be_asked_for(fresh):
    assert fresh.reruns("figures/fig_3_1.png") == {"solve_radial/fig_3_1", "plot_fig_3_1/fig_3_1"}


def test_the_figures_of_the_paper_are_a_target_and_need_no_maps(fresh):
    wanted = fresh.reruns("paper") - {"paper"}
    plots = {rule.split("/")[-1] for rule in wanted if rule.startswith("plot_")}
    assert plots >= {"plot_fig_1_1", "fig_3_2", "plot_fig_4_1", "fig_4_2", "plot_fig_4_5"}
    beyond = ("map", "von_mises", "march", "design", "case", "claims", "fig_domain_angle")
    assert [rule for rule in wanted if any(word in rule for word in beyond)] == []
