"""What `import hopper` hands on, in any order of imports, and how results show themselves."""

import ast
import importlib
import inspect
import pkgutil
import pydoc
import subprocess
import sys
from dataclasses import is_dataclass
from math import radians
from pathlib import Path

import numpy as np
import pytest

import hopper
import hopper_data

ROOT = Path(__file__).parents[1]
NAMES = [name for name in hopper.__all__ if name != "__version__"]
MODULES = sorted(
    module.name for module in pkgutil.walk_packages(hopper.__path__, "hopper.", onerror=print)
)


def fresh(code: str) -> str:
    """What code prints in an interpreter of its own."""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.strip()


def test_the_import_takes_neither_numpy_nor_typing():
    loaded = fresh("import sys, hopper; print(*sys.modules)").split()
    assert not {"numpy", "scipy", "typing", "importlib.metadata"} & set(loaded)
    assert [name for name in loaded if name.startswith("hopper")] == ["hopper"]


@pytest.mark.parametrize("name", NAMES)
def test_each_name_is_that_of_its_room(name):
    found = getattr(hopper, name)
    assert getattr(importlib.import_module(found.__module__), name) is found
    assert found.__module__.startswith("hopper.")
    assert inspect.getdoc(found)


def test_dir_and_help_know_the_names():
    assert set(NAMES) <= set(dir(hopper))
    text = pydoc.plain(pydoc.render_doc(hopper))
    for name in NAMES:
        assert name in text


def test_type_checkers_see_the_same_names():
    tree = ast.parse((ROOT / "src/hopper/__init__.py").read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If) and node.orelse == []
                and isinstance(node.test, ast.Name))  # fmt: skip
    seen = {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert seen == {name: f"hopper.{home}" for name, home in hopper._HOME.items()}


def test_no_name_is_that_of_a_room_or_module_beside_it():
    beside = {path.stem for path in (ROOT / "src/hopper").iterdir()}
    assert not beside & set(NAMES)
    for package in [name for name in MODULES if "." not in name.removeprefix("hopper.")]:
        module = importlib.import_module(package)
        if hasattr(module, "__path__"):
            handed_on = [name for name in vars(module) if not name.startswith("__")]
            inside = {item.name for item in pkgutil.iter_modules(module.__path__)}
            assert set(handed_on) <= inside, f"{package} hands on names"


@pytest.mark.parametrize(
    "first",
    ["", *MODULES[:: max(1, len(MODULES) // 4)], "hopper_data.results", "hopper_cli.commands"],
)
def test_the_names_mean_the_same_in_any_order_of_imports(first):
    names = "; ".join(f"print(hopper.{name}.__module__)" for name in NAMES)
    load = f"import {first}" if first else ""
    room = "import hopper.stability; print(hopper.stability.__name__)"
    printed = fresh(f"{load}\nimport hopper\n{names}\n{room}").splitlines()
    assert printed == [*(f"hopper.{hopper._HOME[name]}" for name in NAMES), "hopper.stability"]


def test_an_unknown_name_tells_the_nearest():
    for wrong, right in (("solve_radail", "solve_radial"), ("Hoper", "Hopper")):
        with pytest.raises(AttributeError, match=f"did you mean '{right}'"):
            getattr(hopper, wrong)
    with pytest.raises(ImportError, match="cannot import name 'radial_colocation'"):
        exec("from hopper import radial_colocation")
    with pytest.raises(AttributeError, match="no attribute 'to_datset'"):
        getattr(hopper_data, "to_datset")  # noqa: B009


@pytest.mark.parametrize("old", ["radial_collocation", "spectrum", "chebyshev", "stability_map"])
def test_an_old_path_is_a_module_that_is_not_found(old):
    with pytest.raises(ModuleNotFoundError, match=f"No module named 'hopper.{old}'"):
        importlib.import_module(f"hopper.{old}")


def test_scripts_import_from_the_defining_module():
    for path in [*(ROOT / "scripts").rglob("*.py"), *(ROOT / "src").rglob("*.py")]:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                where = f"{path} line {node.lineno}"
                assert node.module != "hopper", where
                handed_on = {alias.name for alias in node.names} & set(hopper_data._HOMES)
                assert not (node.module == "hopper_data" and handed_on), where


# --- one short line ------------------------------------------------------------------------------


def dataclasses_of(package):
    for item in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        for name, found in vars(importlib.import_module(item.name)).items():
            if (
                inspect.isclass(found)
                and is_dataclass(found)
                and found.__module__ == item.name
                and not name.startswith("_")
            ):
                yield found


@pytest.fixture(scope="module")
def results():
    """One of each public dataclass, by its name, as it comes out of the numerics."""
    from hopper.assessment.coupled import describe_coupled
    from hopper.assessment.march import assess_march
    from hopper.assessment.neutral import assess_neutral
    from hopper.design.charts import chart
    from hopper.design.design import Demand, design
    from hopper.design.flow_pattern import flow_pattern
    from hopper.design.judgement import judge_hopper
    from hopper.design.material import Material
    from hopper.design.outlet import linear_flow_function
    from hopper.domain.borders import borders
    from hopper.domain.coupled import coupled_borders, sweep_coupled
    from hopper.domain.growth import Hoppers, root
    from hopper.domain.neutral_points import StableDeltas, StableInterval
    from hopper.domain.stability_map import sweep_friction
    from hopper.evidence.folds import fold_mode
    from hopper.evidence.motion import check_field, levy_factor
    from hopper.evidence.printed import compare_linearised
    from hopper.evidence.sign_changes import sign_changes
    from hopper.evidence.smooth_operator import check_formula
    from hopper.march.base import base_of, base_state, base_table
    from hopper.march.crossing import Crossing, net_verdict
    from hopper.march.equations import ray_slopes
    from hopper.march.fields import stress_of
    from hopper.march.lines import characteristics
    from hopper.march.net import make_net
    from hopper.march.optics import short_waves
    from hopper.march.result import Breakdown
    from hopper.march.tops import riemann_deviation, scaled
    from hopper.radial.branch import branch_up_to
    from hopper.radial.critical_point import CriticalPoint, LimitingSolution
    from hopper.radial.flow_curve import flow_curve
    from hopper.radial.pieces import first_piece
    from hopper.spectral.sensitivity import kept_sensitivity
    from hopper.stability.convergence_filter import convergence_filter
    from hopper.stability.mesh_spectrum import mesh_spectrum
    from hopper.stability.paper_abscissa import paper_abscissa
    from hopper.stability.paper_frame import coefficients
    from hopper.stability.tilted import tilted_coefficients
    from hopper.stability.transient import modal_basis
    from hopper.uncertainty.box import Box, Range
    from hopper.uncertainty.designs import design_over
    from hopper.uncertainty.extremes import extremes
    from hopper.uncertainty.hoppers import BoxedHoppers
    from hopper.uncertainty.numbers import spare_number
    from hopper.uncertainty.ranged import Ranged
    from hopper.von_mises.following import upper_strip
    from hopper.von_mises.high_frequency import high_frequency
    from hopper.von_mises.linearisation import coefficients as coupled_coefficients
    from hopper.von_mises.neutral import neutral_flow, neutral_point
    from hopper.von_mises.neutral_curve import neutral_curve as coupled_neutral_curve
    from hopper.von_mises.saint_venant import end_effects
    from hopper.von_mises.verdict import judge
    from hopper_data.datasets import dataset
    from hopper_data.hopper_lists import HopperList
    from hopper_data.inputs import Case
    from hopper_data.tables import number, rows
    from hopper_data.walls import Wall

    cone = hopper.Hopper("cone", radians(35), radians(10))
    solution = hopper.solve_radial(cone, 0.1)
    stability = hopper.linear_stability(solution)
    known = hopper.assess(cone, 0.1)
    neutral = assess_neutral("cone", radians(10), 0.1)
    interval = StableInterval(0.5, 1.5, "neutral", "fold")
    stable = StableDeltas(0.1, (0.5,), (interval,))
    mesh = mesh_spectrum(solution, 48)
    kept = stability.eigenvalues[stability.eigenvalues.imag > 0][:1]
    basis = modal_basis(solution, 64, "physical", np.concatenate([kept, kept.conj()]))
    form = hopper.schur_form(np.diag([-1.0, -2.0]))
    piece = first_piece(cone)
    base = base_of(solution)
    drawn = chart("cone", radians(40), [0.2, 0.3], 2)
    wedge = base_of(hopper.solve_radial(hopper.Hopper("wedge", radians(45), radians(10)), 0.0))
    assessed = assess_march(wedge.solution, scaled(2.0), 0.01, 0.005)
    marched = assessed.result
    state, net = base_state(base, np.array([0.1])), make_net(base, True)
    soft = hopper.Hopper("cone", radians(35), radians(10), hopper.yield_condition("von-mises"))
    von_mises = hopper.solve_radial(soft, 0.1)
    hard = hopper.Hopper("cone", radians(40), radians(10), soft.material)
    judged = judge(hard, 0.1, resolve=False)
    elliptic = hopper.solve_radial(
        hopper.Hopper("cone", radians(30), radians(10), soft.material), 0.1
    )
    effects = end_effects(elliptic)
    steel_wall = Material("cone", radians(40), radians(16))
    wanted = Demand(linear_flow_function(0.5, 0.3), 900.0)
    found_design = design(steel_wall, radians(3), wanted)
    box = Box("cone", Range(radians(39), radians(40)), Range(0.2, 0.2), Range(0.1, 0.1))
    boxed, over = BoxedHoppers(box), design_over(box, radians(3))
    found = [
        cone, cone.material, solution, solution.member, solution.member.grid,
        solution.member.closure, hopper.friction_limit(cone), CriticalPoint(0.1, -1.0, 3.0),
        LimitingSolution(0.5, 3.0, 1e-9), hopper.solve_velocity(solution), stability,
        stability.line, coefficients(solution, [0.1]), mesh,
        convergence_filter(mesh, mesh_spectrum(solution, 32), 1e-3),
        paper_abscissa(solution, 48, 32, 1e-3), basis, kept_sensitivity([basis]), form,
        hopper.pseudospectrum(form, [-1, 1], [0, 1]), known, known.limits, known.radial,
        known.stability, known.stability and known.stability.transient,
        known.radial and known.radial.sigma_axis,
        neutral, *neutral.points[:1], *neutral.intervals[:1],
        hopper.neutral_curve("wedge", radians(10), 0.1, radians(43)), interval, stable,
        stability.modes["symmetric"], tilted_coefficients(solution, [0.1]), fold_mode(cone),
        Hoppers("cone", radians(10)), root(np.sin, 0.1),
        borders("cone", radians(10), [radians(35)]), sweep_friction(cone, [0.0, 0.1]),
        check_field(solution), levy_factor(von_mises, hopper.solve_velocity(von_mises)),
        compare_linearised(solution, 3), check_formula(cone, 3, 12),
        Case("cone", "mohr-coulomb", 35, 10, Wall.of(0.1)), Wall.of(0.1),
        number("sigma_axis", "stress"), *rows(solution, [number("sigma_axis", "stress")]),
        branch_up_to(cone, 0.1),
        piece, piece.end, solution.member.grid.map, form.panels[0],
        *sign_changes(np.cos, [1.0, 2.0], 0.1), base, state, state.at, base_table(base),
        ray_slopes(state.at, np.tan(state.psi), state.light), stress_of(0.5, state.psi, state.psi),
        assessed, assessed.at, marched, marched.top, marched.settled[0], marched.history,
        marched.history.loop, marched.history.loop.mesh, net, short_waves(wedge),
        net_verdict(net, lambda x: riemann_deviation(base, scaled(1.0), x), 0.01, 1e-5, False),
        Crossing(0.1, 0.1, 1, 1e-6), Breakdown(0.1, 1e-6, 0.5, 0.9),
        characteristics(wedge, scaled(1.0), 4, 0.01),
        flow_curve(hopper.Hopper("wedge", radians(45), 0.2)), drawn, drawn.limit,
        found_design, found_design.half_angles, found_design.outlet, wanted, wanted.flow_function,
        steel_wall, flow_pattern(steel_wall, 0.2), judge_hopper(steel_wall, 0.2),
        HopperList(("geometry", "delta"), (), {}),
        describe_coupled(elliptic), judged, judged.type, judged.growth, judged.modes,
        judged.growth and judged.growth.strips,
        coupled_borders(radians(10), np.array([0.5])), sweep_coupled(hard, np.array([0.1])),
        effects, effects.rays, high_frequency(elliptic),
        *coupled_coefficients(von_mises, [von_mises.member.grid]),
        neutral_point(radians(10), 0.1), neutral_flow(radians(10), 0.1),
        upper_strip(hopper.solve_radial(hard, 0.1)), coupled_neutral_curve(radians(10), 0.1, 0.05),
        box, box.delta, boxed, over, over.shares["classical"], spare_number(boxed),
        over.numbers["half_angles.classical"],
        Ranged(flow_pattern(steel_wall, 0.2), {}, {}, None, 0.0),
        *(extremes(lambda x: float(x[0]), [[0.0], [1.0]]) or ()),
        dataset(solution, [number("sigma_axis", "stress")]),
    ]  # fmt: skip
    assert all(found)
    return {type(item).__name__: item for item in found}


def test_every_public_dataclass_shows_itself_in_one_short_line(results):
    classes = [*dataclasses_of(hopper), *dataclasses_of(hopper_data)]
    assert {found.__name__ for found in classes} == set(results)
    for name, item in results.items():
        shown = repr(item)
        assert "\n" not in shown, name
        assert len(shown) <= 140, shown
        assert "array" not in shown


def test_angles_are_shown_in_degrees(results):
    assert repr(results["Hopper"]) == "Hopper(cone, delta=35 deg, half_angle=10 deg, Mohr-Coulomb)"
    assert "friction_angle=5.72958 deg" in repr(results["RadialSolution"])
    assert repr(results["Sweep"]).startswith("Sweep(friction_angle=0 deg..5.72958 deg (2), ")


# --- datasets ------------------------------------------------------------------------------------


WITH_DATASET = {
    "RadialSolution", "VelocityField", "LinearStability", "MeshSpectrum", "FilteredSpectrum",
    "Pseudospectrum", "Sweep", "NeutralCurve", "Borders", "Assessment", "RadialAssessment",
    "StabilityAssessment", "CoupledStability", "MarchAssessment",
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(WITH_DATASET))
def test_a_result_becomes_a_dataset_with_units_and_names(results, name):
    data = hopper_data.to_dataset(results[name])
    assert data.data_vars
    for key, variable in data.variables.items():
        assert variable.attrs["long_name"], key
        assert variable.dtype.kind in "OU" or variable.attrs["units"], key
        assert "flag_values" not in variable.attrs


def test_a_dataset_holds_the_numbers_of_its_result(results):
    solution = results["RadialSolution"]
    data = hopper_data.to_dataset(solution)
    assert float(data.sigma.sel(theta=0)) == pytest.approx(solution.sigma_axis, rel=1e-13)
    assert data.psi.to_numpy()[-1] == pytest.approx(solution.psi_wall, rel=1e-13)
    modes = hopper_data.to_dataset(results["LinearStability"])
    np.testing.assert_array_equal(modes.eigenvalue, results["LinearStability"].eigenvalues)
    assert modes.governed_by.item() == results["LinearStability"].governed_by
    sweep = hopper_data.to_dataset(results["Sweep"])
    assert sweep.region.to_numpy().tolist() == ["stable", "stable"]


def test_what_has_no_dataset_is_refused(results):
    with pytest.raises(TypeError, match="float is not a result with a dataset: use a RadialSol"):
        hopper_data.to_dataset(1.0)
