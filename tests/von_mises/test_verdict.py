"""Supremum, end effects and verdict against the reference, refuted rules, and bad input."""

from math import atan, inf, isnan, nan, radians, sin
from typing import Any

import numpy as np
import pytest

from hopper.errors import HopperError, InvalidParameterError, SingularVelocityError
from hopper.problem import Hopper
from hopper.radial.solution import solve_radial
from hopper.stability.modes import linear_stability
from hopper.stability.transient import modal_basis, tilted_basis
from hopper.von_mises import growth as growth_module
from hopper.von_mises.growth import growth, resolved_growth
from hopper.von_mises.modes import modes_on
from hopper.von_mises.saint_venant import end_effects
from hopper.von_mises.verdict import flow_limit, judge, judge_solution
from tests.von_mises.witnesses import REFERENCE, SETS, Shooting, cone, radial

VERDICTS = {
    "elliptic": "saint_venant", "mixed": "mixed", "hyperbolic": None, "slanted": None,
}  # fmt: skip


def verdict(delta, half_angle, phi, **options) -> Any:
    """The verdict on a cone, angles in degrees."""
    return judge(cone(delta, half_angle), radians(phi), **options)


@pytest.mark.parametrize("index", range(len(SETS)), ids=str)
def test_verdict_of_the_reference(index):
    known = REFERENCE["sets"][index]
    delta, half_angle, mu = SETS[index]
    found = verdict(delta, half_angle, np.degrees(atan(mu)))
    expected = VERDICTS[known["region"]] or known["verdict"].split()[0].rstrip(",")
    assert found.verdict == expected
    assert found.slanted == (known["region"] == "slanted")
    if known["region"] == "elliptic":
        effects = found.end_effects
        assert abs(effects.decay_down - known["decay_down"]) < effects.error_estimate
        assert abs(effects.decay_up - known["decay_up"]) < effects.error_estimate
        assert effects.gap == min(effects.decay_down, effects.decay_up)
        assert effects.error_estimate < 1e-8
        assert isnan(found.abscissa)
    elif known["region"] == "mixed":
        assert found.end_effects is None
        assert isnan(found.abscissa)
        assert len(found.modes.eigenvalues) >= 6
    else:
        assert abs(found.abscissa - known["sup_re"]) <= found.growth.error_estimate
        assert found.growth.error_estimate < 1e-7
        assert found.growth.governed_by == known["sup_by"]
        assert found.error_estimate >= found.growth.bound - found.abscissa
        assert found.abscissa + found.error_estimate < 0 or found.verdict == "unstable"


def test_two_modes_above_the_strip_that_coarse_rules_missed():
    # (10, 40.0803, 27): a rule that looked at the last four modes only said stable, -.0020.
    found = verdict(40.0803, 10, 27)
    assert found.verdict == "unstable"
    assert found.abscissa == pytest.approx(0.011, abs=5e-7)
    assert found.growth.frequency == pytest.approx(178.753, abs=5e-4)
    # (10, 37, 22): not 1.1905, the strip's edge.
    found = verdict(37, 10, 22)
    assert found.verdict == "unstable"
    assert found.growth.strips.upper_edge == pytest.approx(1.1905, abs=5e-5)
    assert found.abscissa == pytest.approx(1.2094, abs=5e-5)
    assert found.growth.frequency == pytest.approx(199.09, abs=1e-2)
    # (10, 41, 27): not -.0929.
    found = verdict(41, 10, 27)
    assert found.verdict == "stable"
    assert found.growth.strips.upper_edge == pytest.approx(-0.0929, abs=5e-5)
    assert found.abscissa == pytest.approx(-0.0888, abs=5e-5)


def test_a_coarse_mesh_does_not_decide():
    # -.111 on coarse meshes; a mode of the first kind at -.0036.
    found = verdict(40, 10, 28)
    assert found.verdict == "stable"
    assert found.abscissa == pytest.approx(-0.0036, abs=5e-5)


def test_the_overlooked_mode_by_shooting():
    solution = solve_radial(cone(40.0803, 10), radians(27))
    found = resolved_growth(solution)
    mode = found.abscissa + 1j * found.frequency
    (root,) = Shooting(solution).roots([mode * (1 + 1e-7)])
    assert abs(root - mode) < found.error_estimate + 1e-9 * abs(mode)


def test_without_the_test_of_resolution_nothing_is_stable():
    for delta, phi in ((40, 5.71), (41, 27)):
        quick = verdict(delta, 10, phi, resolve=False)
        assert quick.verdict == "not_converged"
        assert quick.growth.bound > 0 > quick.growth.abscissa
        assert isnan(quick.abscissa)
        assert verdict(delta, 10, phi).verdict == "stable"
    assert verdict(40, 30, 11.31, resolve=False).verdict == "unstable"


def test_no_abscissa_where_nothing_bounds_the_modes_not_resolved():
    found = verdict(35.52, 10, 24)
    assert found.verdict == "unstable"
    assert found.growth.bound == inf
    assert isnan(found.abscissa)
    assert isnan(found.error_estimate)
    assert "modes not resolved may exceed it" in found.reason


def test_stable_needs_few_errors_of_the_law():
    # The bound is what the last modes' distances from the law's roots add to the strip's edge.
    solution = solve_radial(cone(41, 10), radians(27))
    found = resolved_growth(solution)
    assert found.settled
    assert found.bound < 0
    assert found.bound == max(found.abscissa, found.strips.upper_edge + found.overshoot)
    # Modes further up, of a finer mesh, keep it.
    finest = modes_on(solution, 96).eigenvalues
    beyond = finest[np.abs(finest) > np.abs(found.modes.eigenvalues[-1])]
    above = beyond.real.max(initial=-inf)
    assert above <= found.bound


@pytest.mark.parametrize("hopper", [(40, 10, 0.1), (36, 10, 0.0), (45, 20, 0.1), (38, 10, 0.3)])
def test_bound_holds_on_finer_meshes(hopper):
    solution = radial(*hopper)
    found = resolved_growth(solution)
    assert found.settled
    assert modes_on(solution, 76).eigenvalues.real.max() <= found.bound + 1e-9


@pytest.mark.soak
def test_bound_holds_on_finer_meshes_of_random_cones():
    random = np.random.default_rng(21)
    settled = 0
    while settled < 150:
        delta, half_angle, phi = random.uniform([35.4, 4, 0], [59, 32, 32])
        try:
            solution = solve_radial(cone(delta, half_angle), radians(phi))
            found = resolved_growth(solution)
        except HopperError:
            continue
        if found.settled:
            settled += 1
            highest = modes_on(solution, 96).eigenvalues.real.max()
            assert highest <= found.bound + 1e-8
            assert (max(highest, found.strips.upper_edge) > 0) == (found.abscissa > 0)


def test_neutral():
    point = REFERENCE["neutral_points"][0]
    found = verdict(point["delta"], point["half_angle"], point["phi"])
    assert found.verdict == "neutral"
    assert abs(found.abscissa) < found.error_estimate < 1e-6
    # A hundred-thousandth of a degree to either side is not.
    assert verdict(point["delta"] + 1e-4, point["half_angle"], point["phi"]).verdict == "stable"
    assert verdict(point["delta"] - 1e-4, point["half_angle"], point["phi"]).verdict == "unstable"


def test_where_the_strip_governs():
    solution = solve_radial(cone(35.5, 10), radians(6))
    found = growth(solution)
    assert found.governed_by == "strip"
    assert isnan(found.frequency)
    assert found.abscissa == found.strips.upper_edge
    assert verdict(35.5, 10, 6).verdict == "unstable"


def test_too_few_modes_leave_the_overshoot_unknown(monkeypatch):
    solution = radial(40, 10, 0.1)
    assert growth(solution, first=30).overshoot < inf
    monkeypatch.setattr(growth_module, "_LEAST_TESTED", 50)
    found = growth(solution, first=30)
    assert found.overshoot == inf
    assert not found.settled


# Elliptic flows.


@pytest.mark.parametrize(
    "hopper", [(25, 10, 0.1), (30, 30, 0.05), (20, 20, 0.15), (34.5, 10, 0.02)]
)
def test_no_higher_mode_decays_less(hopper):
    solution = radial(*hopper)
    found = end_effects(solution)
    real = modes_on(solution, 60).eigenvalues.real
    assert len(real) > 20
    assert -real[real < 0].max() == pytest.approx(found.decay_down, abs=found.error_estimate)
    assert real[real > 0].min() == pytest.approx(found.decay_up, abs=found.error_estimate)


def test_smallest_gaps_of_the_maps():
    # The smallest on the page's maps are at delta = 15 deg, phi = 0: .28, and 1.5 or .92 up.
    for half_angle in (10, 30):
        effects = end_effects(radial(15, half_angle, 0.0))
        assert effects.decay_down == pytest.approx(0.28, abs=0.01)


# Where the question does not arise.


def test_tension():
    found = verdict(60, 10, 5)
    assert found.verdict == "tension"
    assert "T_rr <= 0 on the axis; lower delta" in found.reason
    assert found.type.kind == "tension"
    assert judge_solution(radial(62, 10, 0.05)).verdict == "tension"
    assert verdict(59, 10, 5).verdict == "stable"


@pytest.mark.parametrize(
    "border", REFERENCE["borders_phi_deg"], ids=lambda b: f"{b['half_angle']}-{b['delta']}"
)
def test_flow_ends_where_psi_is_45_degrees(border):
    hopper = cone(border["delta"], border["half_angle"])
    limit = flow_limit(hopper)
    # Inside the cone the reference took psi on a grid: its border is up to 2e-4 deg high.
    difference = border["phi_velocity_singular"] - np.degrees(limit)
    assert -1e-9 < difference < (1e-9 if border["half_angle"] == 10 else 2e-4)
    assert solve_radial(hopper, limit).psi_maximum()[1] == pytest.approx(radians(45), abs=1e-10)
    beyond = judge(hopper, limit + 1e-3)
    assert beyond.verdict == "no_radial_solution"
    assert beyond.border == limit
    assert f"at phi = {np.degrees(limit):.6g} deg; lower the wall friction" in beyond.reason
    assert beyond.type is None
    before = judge(hopper, limit - 1e-3)
    assert before.verdict in ("not_converged", "mixed")


def test_no_radial_flow_for_other_reasons():
    rough = verdict(40, 10, 50)
    assert rough.verdict == "no_radial_solution"
    assert rough.border == pytest.approx(atan(sin(radians(40))))
    light = verdict(11, 10, 0)
    assert light.verdict == "no_radial_solution"
    assert "raise delta" in light.reason
    wide = verdict(40, 85, 1)
    assert wide.verdict == "no_radial_solution"
    assert "even for a smooth wall: lower half_angle" in wide.reason
    assert wide.border == 0


def test_mixed_flows_carry_no_rates():
    found = verdict(30, 30, 16.7)
    assert found.verdict == "mixed"
    assert "sonic at theta = 10.08" in found.reason
    assert found.growth is None
    assert found.end_effects is None
    # Next to 45 deg even the low modes are not resolved, but it is mixed all the same.
    rough = judge(cone(30, 30), flow_limit(cone(30, 30)) - 1e-4)
    assert rough.verdict == "mixed"
    assert rough.modes is None


def test_next_to_the_borders_of_type():
    assert verdict(35.26438969, 10, 5).verdict == "not_converged"
    assert verdict(35.26438967, 10, 0.0).verdict in ("not_converged", "mixed")


def test_every_cone_has_a_verdict_and_a_reason():
    random = np.random.default_rng(12)
    seen = set()
    for _ in range(40):
        delta, half_angle, phi = random.uniform([5, 1, 0], [65, 35, 35])
        found = verdict(delta, half_angle, phi, resolve=False)
        assert found.reason
        assert "\n" not in found.reason
        seen.add(found.verdict)
    assert seen >= {"unstable", "saint_venant", "mixed", "tension", "no_radial_solution"}


def test_a_neighbour_as_start_changes_nothing():
    hopper = cone(40, 10)
    start = solve_radial(hopper, atan(0.11))
    plain, warm = (judge(hopper, atan(0.1), start=one) for one in (None, start))
    assert warm.verdict == plain.verdict
    assert warm.abscissa == pytest.approx(plain.abscissa, abs=1e-10)


@pytest.mark.parametrize("phi", [-1.0, 90.0, nan, inf])
def test_bad_friction(phi):
    with pytest.raises(InvalidParameterError, match=r"friction_angle = .* out of range"):
        verdict(40, 10, phi)


def test_bad_material():
    coulomb = Hopper("cone", radians(40), radians(10))
    calls = [
        lambda: judge(coulomb, 0.1),
        lambda: flow_limit(coulomb),
        lambda: growth(solve_radial(coulomb, 0.1)),
        lambda: resolved_growth(solve_radial(coulomb, 0.1)),
        lambda: end_effects(solve_radial(coulomb, 0.1)),
        lambda: judge_solution(solve_radial(coulomb, 0.1)),
    ]
    for call in calls:
        with pytest.raises(InvalidParameterError, match="use model = von-mises"):
            call()
    with pytest.raises(InvalidParameterError, match="is not a number"):
        judge(cone(40, 10), "rough")  # type: ignore[arg-type]


def test_transients_are_refused_with_the_reason():
    solution = radial(40, 10, 0.1)
    kept = np.array([-1.0 + 0j])
    for call in (
        lambda: linear_stability(solution),
        lambda: tilted_basis(solution, 32, "symmetric", kept),
        lambda: modal_basis(solution, 32, "physical", kept),
    ):
        with pytest.raises(InvalidParameterError, match="grows in ways that the equations do not"):
            call()


def test_no_flow_from_a_solution():
    with pytest.raises(SingularVelocityError, match="psi reaches 45 deg"):
        judge_solution(radial(40, 10, 1.01 * sin(radians(40))))
