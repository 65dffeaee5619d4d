"""Numbers about one hopper: known answers, and errors that bound the true ones."""

from dataclasses import replace
from functools import cache
from math import atan, degrees, pi, radians, sin, tan

import numpy as np
import pytest
import sympy as sp  # type: ignore[import-untyped]
from scipy.integrate import quad
from scipy.linalg import expm
from scipy.optimize import brentq

from hopper import (
    Hopper,
    HopperError,
    RadialSolution,
    assess,
    friction_limit,
    linear_stability,
    solve_radial,
    solve_velocity,
)
from hopper.assessment.limits import assess_limits, tangency_coefficient
from hopper.assessment.neutral import assess_neutral
from hopper.assessment.radial import assess_radial, describe_radial
from hopper.assessment.stability import assess_stability
from hopper.errors import (
    ConvergenceError,
    InvalidParameterError,
    NoRadialSolutionError,
    WallFrictionError,
)
from hopper.quantity import Quantity
from hopper.radial.collocation import Closure, newton
from hopper.radial.grid import half_grid
from hopper.radial.velocity import decay_exponent
from hopper.spectral.transient import modal_matrix
from hopper.stability.low_modes import partner_changes, upper_eigenvalues
from hopper.stability.transient import tilted_basis
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.radial import witness
from tests.stability.tilted_chebyshev import staggered_modes
from tests.stability.tilted_data import read
from tests.stability.tilted_line import line_by_quadrature
from tests.stability.witnesses import radial, wall_tangency_friction

STEEL = Hopper("cone", radians(40), radians(20))
NUMBERS = ("sigma_axis", "sigma_wall", "psi_max", "theta_psi_max", "u_wall", "flow_factor")


def make(geometry, delta, half_angle, material=MOHR_COULOMB):
    return Hopper(geometry, radians(delta), radians(half_angle), material)


def limits_of(hopper):
    return assess_limits(hopper)


def radial_numbers(hopper, mu):
    return assess_radial(hopper, atan(mu))


def tangency_of(hopper):
    return tangency_coefficient(hopper)


def stability_of(solution):
    return assess_stability(solution)


# --- known answers -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("delta", "half_angle", "mass_flow", "fold"),
    [(30, 10, 28.33, 28.61), (30, 30, 19.107, 19.73), (40, 30, 17.78, 17.90)],
)
def test_limits_of_wall_friction(delta, half_angle, mass_flow, fold):
    limits = limits_of(make("cone", delta, half_angle))
    assert degrees(limits.mass_flow.value) == pytest.approx(mass_flow, abs=0.006)
    assert limits.friction.end == "fold"
    assert degrees(atan(limits.coefficient.value)) == pytest.approx(fold, abs=0.011)


@pytest.mark.parametrize(
    ("hopper", "end"),
    [
        (make("cone", 60, 10), "axis"),
        (make("wedge", 35, 10), "wall"),
        (make("cone", 25, 30), "interior"),
        (make("cone", 30, 30, VON_MISES), "wall"),
    ],
)
def test_what_ends_the_solutions(hopper, end):
    limits = limits_of(hopper)
    assert limits.friction.end == end
    assert (limits.mass_flow is None) == (hopper != make("cone", 60, 10) and end != "interior")
    assert (limits.tangency is None) == (hopper.material == VON_MISES)


def test_a_narrow_hopper_has_limits():
    for half_angle in (1, 0.2):
        limits = limits_of(make("cone", 45, half_angle))
        assert limits.friction.end == "axis"
        assert abs(limits.coefficient.value - tan(limits.mass_flow.value)) < 1e-14


def test_limits_that_are_not_resolved_are_noted(monkeypatch):
    def unresolved(_):
        raise ConvergenceError("end of the family not resolved")

    monkeypatch.setattr("hopper.assessment.limits.friction_limit", unresolved)
    found = radial_numbers(make("wedge", 40, 20), 0.1)
    assert found.limits.friction is None
    assert found.limits.coefficient is None
    assert found.notes == ("the largest friction with a radial solution is not resolved",)
    assert found.sigma_wall.error < 1e-10


def test_the_hopper_of_figure_3_2():
    found = radial_numbers(make("cone", 30, 30), 0.356)
    assert found.psi_max.value == pytest.approx(0.7316, abs=6e-5)
    assert degrees(found.theta_psi_max.value) == pytest.approx(13.9, abs=0.05)
    assert found.u_wall.value == pytest.approx(1.4e-3, abs=5e-5)
    assert found.solutions == 2
    assert found.notes == ()


@pytest.mark.parametrize(
    ("geometry", "modes", "line", "verdict"),
    [
        (
            "wedge",
            [-1.6901729747, 0.6565572222 + 34.4981225575j, 0.6553231053 + 69.1155862467j],
            0.6549139210,
            "unstable",
        ),
        (
            "cone",
            [-4.3803555504, -0.2027465702 + 41.9624728598j, -0.2026228243 + 77.1014751493j],
            -0.2025704150,
            "stable",
        ),
    ],
)
def test_the_hoppers_of_figure_4_2(geometry, modes, line, verdict):
    found = stability_of(radial(geometry, 35, 10))
    np.testing.assert_allclose(found.result.eigenvalues[:3], modes, rtol=0, atol=1e-10)
    assert found.result.line.abscissa == pytest.approx(line, abs=1e-10)
    highest = max(complex(mode).real for mode in modes)
    assert found.symmetric.value == pytest.approx(max(highest, line), abs=1e-10)
    if geometry == "cone":
        assert found.asymmetric is None
        assert found.abscissa == found.symmetric
        assert found.result.governed_by == "line"
    else:
        # Published: the lowest pair of the other parity lies further to the right.
        assert found.abscissa == found.asymmetric
        assert found.abscissa.value == pytest.approx(0.6615940468741845, abs=1e-9)
        assert (found.result.governed_by, found.result.parity) == ("complex mode", "asymmetric")
    assert found.verdict == verdict


@pytest.mark.parametrize(("phi", "delta"), [(0, 33.6739), (10, 26.1404)])
def test_neutral_points(phi, delta):
    found = neutral_at(phi)
    assert degrees(found.delta.value) == pytest.approx(delta, abs=5e-5)
    assert degrees(found.delta.error) < 1e-8
    # The line by adaptive quadrature, zero by a chord over 2e-4 degrees.
    assert (found.points[0].governed_by, found.points[0].parity) == ("line", None)
    assert [interval.lower for interval in found.intervals] == [found.delta]
    ends = degrees(found.delta.value) + np.array([-1e-4, 1e-4])
    heights = [line_by_quadrature(radial("cone", d, 10, tan(radians(phi))))[0] for d in ends]
    root = ends[0] - heights[0] * np.diff(ends)[0] / np.diff(heights)[0]
    assert abs(root - degrees(found.delta.value)) < degrees(found.delta.error) + 1e-9


# --- the number of solutions ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("hopper", "mu", "solutions"),
    [
        pytest.param(make("cone", 30, 30), 0.0, 1, marks=pytest.mark.soak),
        pytest.param(make("cone", 30, 30), 0.34, 1, marks=pytest.mark.soak),
        (make("cone", 30, 30), 0.35, 2),
        pytest.param(make("cone", 30, 30), 0.3588, 2, marks=pytest.mark.soak),
        (make("cone", 60, 10), 0.6, 1),
    ],
)
def test_number_of_solutions_by_shooting(hopper, mu, solutions):
    model, k, s = witness.describe(hopper)
    psi_wall = witness.wall_angle(model, s, atan(mu))
    largest = solve_radial(hopper, 0.0).sigma_axis
    # From just above the smooth wall's stress down to where the family has all but ended.
    excess = []
    for sigma_axis in np.geomspace(1.001 * largest, 2e-3 * largest, 60):
        _, psi = witness.shoot(model, k, s, sigma_axis, np.array([hopper.half_angle]), rtol=1e-9)
        excess.append(psi[-1] - psi_wall)
    assert np.sum(np.diff(np.sign(excess)) != 0) == solutions
    assert radial_numbers(hopper, mu).solutions == solutions


# --- errors of the radial numbers ----------------------------------------------------------------


def shot_numbers(hopper, friction_angle, near):
    """The numbers by shooting, with the stress on the axis sought ``near`` a value."""
    model, k, s = witness.describe(hopper)
    wall = hopper.half_angle
    psi_wall = witness.wall_angle(model, s, friction_angle)

    def at(sigma_axis, angles):
        return witness.shoot(model, k, s, sigma_axis, np.atleast_1d(angles))

    axis = brentq(lambda x: at(x, wall)[1, -1] - psi_wall, 0.99 * near, 1.01 * near, xtol=1e-15)

    def slope(angle):
        sigma, psi = at(axis, angle)[:, -1]
        return witness.slopes(model, k, s, angle, sigma, psi)[1]

    peak = wall if slope(wall) > 0 else brentq(slope, 0.2 * wall, wall, xtol=1e-13)
    x, weight = np.polynomial.legendre.leggauss(40)
    inside = wall * (x + 1) / 2
    integral = wall / 2 * weight @ np.tan(2 * at(axis, np.append(inside, wall))[1, :-1])
    sigma_wall = at(axis, wall)[0, -1]
    angle = degrees(wall)
    height = 2 + angle / 60 if k else 1 + angle / 180
    return {
        "sigma_axis": axis,
        "sigma_wall": sigma_wall,
        "psi_max": at(axis, peak)[1, -1],
        "theta_psi_max": peak,
        "u_wall": np.exp(-(3 if k else 2) * integral),
        "flow_factor": height * (1 + s) * sigma_wall / (2 * sin(wall)),
    }


@pytest.mark.parametrize(
    ("hopper", "mu"),
    [
        (STEEL, 0.3),
        (make("cone", 30, 30), 0.356),
        (make("wedge", 35, 40), 0.25),
        (make("cone", 25, 20), 0.1),
    ],
)
def test_numbers_by_shooting(hopper, mu):
    found = radial_numbers(hopper, mu)
    expected = shot_numbers(hopper, atan(mu), found.sigma_axis.value)
    assert found.psi_wall.value == pytest.approx(
        witness.wall_angle("mohr-coulomb", hopper.s, atan(mu)), abs=1e-14
    )
    for name in NUMBERS:
        quantity = getattr(found, name)
        # 1e-10 is the witness's own error, from its interpolation between steps.
        tolerance = quantity.error + 1e-10 * abs(quantity.value)
        assert abs(quantity.value - expected[name]) < tolerance, name
        assert quantity.error < 1e-10, name


def on_few_points(solution: RadialSolution, size: int) -> RadialSolution | None:
    """The solution on ``size`` half-grid points, with its true error."""
    grid = half_grid(size, solution.hopper.half_angle)
    closure = Closure("psi_wall", solution.psi_wall)
    member = newton(solution.hopper, grid, closure, solution.member.on(grid))
    if member is None:
        return None
    exact = solution.member.on(grid)
    change = np.abs(member.u - exact)
    error = max(change[:-1].max(), change[-1] / max(1, exact[-1]))
    return replace(solution, member=replace(member, error=error))


def random_crude_solutions(count, rng):
    while count:
        geometry = ("wedge", "cone")[count % 2]
        delta, half_angle, mu = rng.uniform([15, 2, 0], [65, 50, 0.45])
        try:
            solution = solve_radial(make(geometry, delta, half_angle), atan(mu))
            solve_velocity(solution)
        except HopperError:
            continue
        crude = on_few_points(solution, int(rng.integers(5, 12)))
        if crude is not None and 1e-10 < crude.error_estimate < 1e-3:
            count -= 1
            yield solution, crude


def test_errors_of_the_fields_reach_the_numbers():
    ratios: dict[str, list[float]] = {name: [] for name in NUMBERS}
    for solution, crude in random_crude_solutions(12, np.random.default_rng(5)):
        exact, found = describe_radial(solution), describe_radial(crude)
        for name in NUMBERS:
            quantity = getattr(found, name)
            ratios[name].append(abs(quantity.value - getattr(exact, name).value) / quantity.error)
    for name, values in ratios.items():
        assert max(values) < 1, name
        assert max(values) > 0.05, f"the error of {name} is overestimated"


@pytest.mark.parametrize("distance", [0.3, 1e-2, 1e-5, 1e-8])
def test_near_the_fold_rounding_counts(distance):
    hopper = make("cone", 30, 30)
    phi = atan(limits_of(hopper).coefficient.value * (1 - distance))
    found = assess_radial(hopper, phi)
    twins = [solve_radial(hopper, phi * (1 + k * np.finfo(float).eps)) for k in (-2, -1, 1, 2)]
    spread = np.ptp([found.sigma_axis.value, *(twin.sigma_axis for twin in twins)])
    assert spread < found.sigma_axis.error < 1e4 * max(spread, 1e-16)
    # sigma_0 depends on mu like a square root there.
    assert found.sigma_axis.error < 1e-13 * (1 + 1 / distance**0.5)


def test_errors_of_the_limits():
    hopper = make("cone", 30, 30)
    limits = limits_of(hopper)
    model, k, s = witness.describe(hopper)

    def below(sigma_axis):
        _, psi = witness.shoot(model, k, s, sigma_axis, np.array([hopper.half_angle]))
        return -witness.friction_angle(model, s, psi[-1])

    # A parabola through three points: psi_w is stationary at the fold.
    x = 1 / limits.friction.tau * np.array([0.999, 1, 1.001])
    a, b, c = np.polyfit(x - x[1], [below(one) for one in x], 2)
    fold = tan(-(c - b**2 / (4 * a)))
    assert abs(limits.coefficient.value - fold) < limits.coefficient.error + 1e-9
    # The closed form of the mass-flow limit in exact arithmetic, to 40 digits.
    sine = sp.sin(sp.pi / 6)
    wall = (sp.pi - sp.acos((1 - sine) / (2 * sine))) / 2 - sp.pi / 6
    phi = sp.atan(sine * sp.sin(2 * wall) / (1 + sine * sp.cos(2 * wall))).evalf(40)
    assert abs(limits.mass_flow.value - phi) < limits.mass_flow.error


def test_the_mass_flow_limit_is_less_certain_near_its_smallest_delta():
    least = degrees(np.arcsin(1 / 3))
    errors = [limits_of(make("cone", least + excess, 10)).mass_flow.error for excess in (10, 1e-9)]
    assert errors[1] > 100 * errors[0]


@pytest.mark.parametrize("delta", [25, 35, 45])
def test_tangency_at_the_wall(delta):
    found = tangency_of(make("cone", delta, 10))
    exact = tan(wall_tangency_friction(radians(delta)))
    assert abs(found.value - exact) < found.error < 1e-11


def test_tangency_inside():
    found = tangency_of(make("cone", 25, 30))
    before, beyond = (
        solve_radial(make("cone", 25, 30), atan(found.value + sign * max(found.error, 1e-12)))
        for sign in (-1, 1)
    )
    assert before.psi_maximum()[1] < radians(32.5) < beyond.psi_maximum()[1]


def test_no_tangency_where_even_a_smooth_wall_is_beyond_it():
    assert tangency_coefficient(make("cone", 65, 45)) is None


# --- errors of stability -------------------------------------------------------------------------

STABILITY_CASES = [("cone", 40, 20, 0.3), ("cone", 35, 10, 0.0), ("wedge", 38, 17, 0.12)]


@pytest.mark.parametrize("hopper", [*STABILITY_CASES, ("wedge", 25, 50, 0.2)])
def test_eigenvalues_by_a_second_discretisation(hopper):
    solution = radial(*hopper)
    found = stability_of(solution)
    for parity, low in {**found.modes, "all symmetric": found.spectrum}.items():
        modes = staggered_modes(solution, 80, parity.removeprefix("all "))
        near = np.abs(low.eigenvalues[:, None] - modes)
        assert np.unique(near.argmin(axis=1)).size == low.eigenvalues.size
        assert np.all(near.min(axis=1) < low.errors)
        size = np.abs(low.eigenvalues)
        assert np.all(low.errors < 1e-5 * size)
        assert np.all(np.diff(size) > 0)
    low, spectrum = found.modes["symmetric"], found.spectrum
    shared = min(low.eigenvalues.size, spectrum.eigenvalues.size)
    difference = np.abs(low.eigenvalues - spectrum.eigenvalues[: low.eigenvalues.size])[:shared]
    assert np.all(difference < (low.errors + spectrum.errors[: low.errors.size])[:shared])
    # Those with Im < 0 complete the modes followed in time.
    values = spectrum.eigenvalues
    assert found.transient.modes == 2 * np.sum(values.imag > 0) + np.sum(values.imag == 0)


def test_errors_of_the_fields_reach_the_eigenvalues():
    ratios, line_ratios = [], []
    for solution, crude in random_crude_solutions(6, np.random.default_rng(8)):
        try:
            exact, found = stability_of(solution), stability_of(crude)
        except HopperError:
            continue
        for parity, modes in found.modes.items():
            change = np.abs(modes.eigenvalues[:, None] - exact.modes[parity].eigenvalues)
            ratios.append((change.min(axis=1) / modes.errors)[:3].max())
        line_ratios.append(abs(exact.abscissa.value - found.abscissa.value) / found.abscissa.error)
    assert len(ratios) > 3
    # Ten times the error of the fields is in the modes' own estimate, besides its consequences.
    assert 0.02 < max(ratios) < 1
    assert max(line_ratios) < 1


def test_a_verdict_needs_an_abscissa_beyond_its_error():
    found = stability_of(radial("cone", 35, 10))
    for value, error, verdict in (
        (-2e-9, 1e-9, "stable"),
        (2e-9, 1e-9, "unstable"),
        (-1e-9, 1e-9, "neutral"),
        (5e-10, 1e-9, "neutral"),
        (0.0, 0.0, "neutral"),
    ):
        supremum = Quantity(value, error)
        assert replace(found, abscissa=supremum, symmetric=supremum).verdict == verdict
    # Symmetric disturbances decay at -0.2.
    assert replace(found, abscissa=Quantity(2e-9, 1e-9)).verdict == "stable_symmetric_only"


@cache
def neutral_at(phi):
    return assess_neutral("cone", radians(10), radians(phi))


def test_at_a_neutral_point_the_verdict_turns():
    neutral = neutral_at(10).delta.value
    verdicts = [
        stability_of(
            solve_radial(Hopper("cone", neutral + shift, radians(10)), radians(10))
        ).verdict
        for shift in (-1e-9, 1e-9)
    ]
    assert verdicts == ["unstable", "stable"]


POINTS = read("neutral_points", "points")


@pytest.mark.parametrize("point", [pytest.param(POINTS[2], marks=pytest.mark.soak), POINTS[4]])
def test_neutral_points_beyond_the_tangency_and_of_both_parities(point):
    angles = radians(point["half_angle"]), radians(point["phi"])
    found = assess_neutral(point["geometry"], *angles)
    assert found.delta is not None
    known = radians(point["delta_neutral_deg"])
    assert abs(found.delta.value - known) < found.delta.error + radians(point["tolerance_deg"])
    assert degrees(found.delta.error) < 1e-6
    (neutral,), (interval,) = found.points, found.intervals
    assert (neutral.governed_by, neutral.parity) == ("complex mode", point["disturbance"])
    assert interval.lower == found.delta
    if point["geometry"] == "cone":
        assert interval.upper_end == "fold"
        # The fold there is at this friction; it falls by less than a degree for a degree of delta.
        fold = friction_limit(Hopper("cone", interval.upper.value, radians(30)))
        assert abs(fold.friction_angle - angles[1]) < interval.upper.error


# --- transient growth ----------------------------------------------------------------------------


@pytest.mark.parametrize("hopper", STABILITY_CASES)
def test_transient_growth_by_matrix_exponentials(hopper):
    solution = radial(*hopper)
    found = stability_of(solution)
    transient, alpha = found.transient, found.symmetric.value
    upper = upper_eigenvalues(solution, 54)[: found.spectrum.eigenvalues.size]
    assert partner_changes(upper, found.spectrum.eigenvalues).max() < 1e-5
    kept = np.concatenate([upper, upper[upper.imag > 0].conj()])
    assert transient.modes == kept.size
    # On a mesh of its own, at times of its own, by powers of a matrix exponential.
    basis = tilted_basis(solution, 54, "symmetric", kept)
    horizon, steps = 4 * 2 * pi / found.result.line.spacing, 1000
    step = expm(horizon / steps * modal_matrix(basis))
    propagator, norms = np.eye(kept.size), [np.linalg.norm([1.0])]
    for _ in range(steps):
        propagator = step @ propagator
        norms.append(np.linalg.norm(propagator, 2))
    times = np.linspace(0, horizon, steps + 1)
    ratio = np.max(norms * np.exp(-alpha * times))
    # The largest sample is below the supremum by the curvature of the peak.
    assert ratio < transient.amplification.value * (1 + 1e-5) + transient.amplification.error
    assert ratio > transient.amplification.value * (1 - 1e-3)
    assert 1 <= transient.amplification.value <= transient.condition.value
    values = np.linalg.svd(basis.factor, compute_uv=False)
    assert abs(values[0] / values[-1] - transient.condition.value) < transient.condition.error
    if alpha < 0:
        assert max(norms) < transient.growth.value * (1 + 1e-5)
        assert max(norms) > transient.growth.value * (1 - 1e-3)
    else:
        assert transient.growth is None


# --- what cannot be answered ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("hopper", "mu", "outcome", "reason"),
    [
        (STEEL, 0.3, "stable", ""),
        (make("wedge", 35, 10), 0.0, "unstable", ""),
        (STEEL, 0.35, "stable", ""),
        (make("wedge", 40, 20), tan(radians(25)), "stable_symmetric_only", ""),
        (make("cone", 25, 30), tan(radians(23.45)), "not_converged", "lower the wall friction"),
        (STEEL, 0.47, "no_radial_solution", "the largest friction that has one"),
        (make("cone", 40, 60), 0.2, "no_radial_solution", "even for a smooth wall"),
        (make("cone", 8, 10), 0.0, "non_positive_stress", "is not positive"),
        (make("cone", 25, 30, VON_MISES), 0.2, "saint_venant", ""),
        (make("cone", 40, 30, VON_MISES), 0.2, "unstable", ""),
        (make("cone", 30, 30, VON_MISES), 0.3, "mixed", "elliptic core and hyperbolic ring"),
        (make("cone", 62, 10, VON_MISES), 0.1, "tension", "T_rr <= 0 on the axis"),
    ],
)
def test_outcomes(hopper, mu, outcome, reason):
    found = assess(hopper, atan(mu))
    assert found.outcome == outcome
    assert reason in found.reason
    coupled = found.coupled
    answered = found.stability or (coupled and (coupled.abscissa or coupled.decay_down))
    assert bool(found.reason) == (not answered)
    assert (found.radial is None) == (outcome in ("no_radial_solution", "non_positive_stress"))


def test_a_singular_velocity_leaves_the_rest():
    found = radial_numbers(make("cone", 25, 30), 0.4)
    assert found.velocity is None
    assert found.u_wall is None
    assert "velocity is singular: psi reaches pi/4" in found.notes[0]
    assert found.profiles(np.array([0.1]))[2] is None
    assert found.sigma_wall.value > 0


def test_bad_input_is_refused():
    with pytest.raises(WallFrictionError):
        assess(STEEL, radians(41))
    with pytest.raises(InvalidParameterError):
        assess(STEEL, -0.1)
    with pytest.raises(NoRadialSolutionError):
        radial_numbers(STEEL, 0.47)
    with pytest.raises(InvalidParameterError):
        assess_neutral("cone", radians(95), 0.1)


def test_profiles_are_the_fields():
    found = radial_numbers(STEEL, 0.3)
    theta = np.linspace(-STEEL.half_angle, STEEL.half_angle, 7)
    sigma, psi, u = found.profiles(theta)
    assert sigma[3] == pytest.approx(found.sigma_axis.value, rel=1e-12)
    assert psi[-1] == pytest.approx(found.psi_wall.value, rel=1e-12)
    assert u[[0, 3]] == pytest.approx([found.u_wall.value, 1], rel=1e-12)
    rate = decay_exponent(found.solution)
    integral = quad(lambda t: tan(2 * float(found.solution.psi_at(t)[0])), 0, theta[4])[0]
    assert u[4] == pytest.approx(np.exp(-rate * integral), rel=1e-11)
    assert linear_stability(found.solution).stable
