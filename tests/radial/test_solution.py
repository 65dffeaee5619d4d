"""Radial stress fields against shooting, scipy's solve_bvp, the closed form and the fold."""

from functools import cache
from itertools import islice, product
from math import atan, degrees, exp, log, pi, radians, tan

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, minimize_scalar

from hopper import (
    Hopper,
    friction_limit,
    mass_flow_half_angle,
    radial_solutions,
    solve_radial,
    solve_radial_family,
)
from hopper.problem import as_geometry
from hopper.radial.collocation import Closure, crude_start, newton
from hopper.radial.family import family
from hopper.radial.grid import half_grid
from hopper.radial.mass_flow import limiting_fields, limiting_wall_angle, mass_flow_friction_angle
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.radial import witness

KINDS = {
    "wedge": ("wedge", MOHR_COULOMB),
    "cone": ("cone", MOHR_COULOMB),
    "von Mises": ("cone", VON_MISES),
}


def make(kind, delta_deg, half_angle_deg):
    geometry, material = KINDS[kind]
    return Hopper(as_geometry(geometry), radians(delta_deg), radians(half_angle_deg), material)


# The hopper of figure 3.2, at and next to its wall friction.
FIGURE_3_2 = make("cone", 30, 30)


@cache
def figure_3_2(mu, branch="physical"):
    return solve_radial(FIGURE_3_2, atan(mu), branch)


def deviation(solution, theta, sigma, psi):
    """Largest of the relative deviation in sigma and the absolute one in psi."""
    ours, angle, _, _ = solution.fields(theta)
    return max(np.abs(ours / sigma - 1).max(), np.abs(angle - psi).max())


# --- initial value problem -----------------------------------------------------------------------

GRID = list(product(KINDS, (20, 30, 45, 60), (5, 15, 30, 45), (0.0, 0.4, 0.8)))
SHOT = [pytest.param(*case, marks=pytest.mark.soak if i % 5 else ()) for i, case in enumerate(GRID)]


@pytest.mark.parametrize(("kind", "delta", "half_angle", "fraction"), SHOT)
def test_shooting_from_the_axis_meets_the_wall(kind, delta, half_angle, fraction):
    hopper = make(kind, delta, half_angle)
    model, k, s = witness.describe(hopper)
    phi = fraction * friction_limit(hopper).friction_angle
    solution = solve_radial(hopper, phi)
    theta = np.linspace(hopper.half_angle / 10, hopper.half_angle, 10)
    sigma, psi = witness.shoot(model, k, s, solution.sigma_axis, theta)
    assert deviation(solution, theta, sigma, psi) < 1e-8
    assert psi[-1] == pytest.approx(witness.wall_angle(model, s, phi), abs=1e-8)
    assert solution.error_estimate < 1e-8


@pytest.mark.parametrize("mu", [0.0, 0.2, 0.356, 0.358])
@pytest.mark.parametrize("kind", ["cone", "von Mises"])
def test_shooting_in_the_hoppers_of_the_figures(kind, mu):
    hopper = make(kind, 30, 30)
    model, k, s = witness.describe(hopper)
    solution = solve_radial(hopper, atan(mu))
    theta = np.linspace(hopper.half_angle / 40, hopper.half_angle, 40)
    sigma, psi = witness.shoot(model, k, s, solution.sigma_axis, theta)
    assert deviation(solution, theta, sigma, psi) < 1e-10
    assert witness.friction_angle(model, s, psi[-1]) == pytest.approx(atan(mu), abs=1e-10)


@pytest.mark.parametrize(("kind", "delta", "half_angle", "fraction"), GRID[::7])
def test_fields_satisfy_the_equations_of_motion(kind, delta, half_angle, fraction):
    """Differentiated as Chebyshev series, without use of the equations."""
    hopper = make(kind, delta, half_angle)
    model, k, s = witness.describe(hopper)
    solution = solve_radial(hopper, fraction * friction_limit(hopper).friction_angle)
    domain = (-hopper.half_angle, hopper.half_angle)
    sigma = Chebyshev.interpolate(lambda t: solution.fields(t)[0], 160, domain)
    psi = Chebyshev.interpolate(lambda t: solution.fields(t)[1], 160, domain)
    theta = np.linspace(hopper.half_angle / 20, hopper.half_angle * 0.98, 30)
    residuals = witness.momentum(
        model, k, s, theta, sigma(theta), psi(theta), sigma.deriv()(theta), psi.deriv()(theta)
    )
    assert np.abs(residuals).max() < 1e-9 * (1 + np.abs(sigma(theta)).max())
    # The slopes that the equations prescribe are those of the series.
    _, _, dsigma, dpsi = solution.fields(theta)
    scale = np.abs(sigma(theta)).max()
    np.testing.assert_allclose(dsigma, sigma.deriv()(theta), rtol=1e-8, atol=1e-9 * scale)
    np.testing.assert_allclose(dpsi, psi.deriv()(theta), rtol=1e-8, atol=1e-9)


# --- boundary value problem ----------------------------------------------------------------------


def collocate(hopper, psi_wall, start):
    """Solve by solve_bvp, whose singular term takes the -k psi / theta of the apex."""
    model, k, s = witness.describe(hopper)

    def slopes(theta, y):
        with np.errstate(divide="ignore", invalid="ignore"):
            dsigma, dpsi = witness.slopes(model, k, s, theta, *y)
            dpsi = dpsi + k * y[1] / theta
        if theta[0] == 0:
            dsigma[0] = 0.0
            dpsi[0] = (1 + k) * witness.apex(model, k, s, y[0, 0])[0]
        return np.vstack([dsigma, dpsi])

    theta = np.linspace(0, hopper.half_angle, 41)
    result = solve_bvp(
        slopes,
        lambda axis, wall: np.array([axis[1], wall[1] - psi_wall]),
        theta,
        start(theta),
        S=np.diag([0.0, -k]) if k else None,
        tol=1e-10,
        max_nodes=20000,
    )
    assert result.success, result.message
    return result.sol


@pytest.mark.parametrize(
    ("kind", "delta", "half_angle", "mu"),
    [
        ("wedge", 20, 45, 0.1),
        ("wedge", 35, 10, 0.17),
        ("wedge", 60, 30, 0.5),
        ("cone", 20, 5, 0.3),
        ("cone", 30, 30, 0.2),
        ("cone", 30, 30, 0.356),
        ("cone", 30, 30, 0.358),
        ("cone", 40, 15, 0.27),
        ("cone", 60, 45, 0.02),
        ("von Mises", 30, 30, 0.0),
        ("von Mises", 30, 30, 0.356),
        ("von Mises", 50, 15, 0.6),
    ],
)
def test_scipy_boundary_value_solver_agrees(kind, delta, half_angle, mu):
    hopper = make(kind, delta, half_angle)
    model, _, s = witness.describe(hopper)
    solution = solve_radial(hopper, atan(mu))
    # Two digits of the solution choose the branch, and leave the rest to scipy.
    reference = collocate(
        hopper,
        witness.wall_angle(model, s, atan(mu)),
        lambda theta: np.array(
            [float(f"{x:.1e}") for y in solution.fields(theta)[:2] for x in y]
        ).reshape(2, -1),
    )
    theta = np.linspace(0, hopper.half_angle, 60)
    assert deviation(solution, theta, *reference(theta)) < 1e-8


# --- error estimate ------------------------------------------------------------------------------

CLOSE = [("cone", 30, 30, atan(mu) / radians(19.7406)) for mu in (0.35, 0.356, 0.358)]
HARD = [("von Mises", 40, 45, 0.72), ("cone", 60, 45, 0.95), ("wedge", 60, 45, 0.9)]


@pytest.mark.parametrize(("kind", "delta", "half_angle", "fraction"), GRID[::5] + CLOSE + HARD)
def test_error_estimate_is_honest(kind, delta, half_angle, fraction):
    hopper = make(kind, delta, half_angle)
    solution = solve_radial(hopper, fraction * friction_limit(hopper).friction_angle)
    member = solution.member
    grid = half_grid(300, hopper.half_angle)
    finer = newton(hopper, grid, member.closure, member.on(grid))
    assert finer is not None
    step = finer.u - member.on(grid)
    error = max(np.abs(step[:-1]).max(), abs(step[-1]) / max(1.0, abs(finer.tau)))
    assert error <= 10 * (solution.error_estimate + 1e-13)


# --- vanishing stress on the axis ----------------------------------------------------------------


@pytest.mark.parametrize("delta", [19.5, 30, 40, 60])
def test_closed_form_satisfies_the_equations_of_motion(delta):
    hopper = make("cone", delta, 30)
    theta = np.linspace(0.01, hopper.half_angle, 50)
    sigma, psi = limiting_fields(hopper, theta)
    # sigma is proportional to sin(theta), and psi + theta is constant.
    np.testing.assert_allclose(sigma / np.sin(theta), sigma[-1] / np.sin(theta[-1]), rtol=1e-14)
    np.testing.assert_allclose(psi + theta, limiting_wall_angle(hopper) + theta[-1], rtol=1e-14)
    model, k, s = witness.describe(hopper)
    slope = sigma / np.tan(theta)
    residuals = witness.momentum(model, k, s, theta, sigma, psi, slope, -np.ones(50))
    assert np.abs(residuals).max() < 1e-11


def test_members_of_small_axis_stress_approach_the_closed_form():
    hopper = make("cone", 40, 30)
    grid = half_grid(160, hopper.half_angle, 11.0)
    wall = Closure("psi_wall", 0.3)
    member = newton(hopper, grid, wall, crude_start(hopper, grid, 0.3))
    while member is not None and member.tau < 5.3e4:
        tau = min(1.3 * member.tau, 5.3e4)
        guess = member.u + member.tangent * (tau - member.tau) / member.tangent[-1]
        member = newton(hopper, grid, Closure("tau", tau), guess)
    assert member is not None
    sigma, psi = limiting_fields(hopper, grid.theta)
    assert abs(member.psi_wall - limiting_wall_angle(hopper)) < 1e-11
    # The deviation decays away from the axis.
    change = np.abs(np.exp(member.log_ratio) / member.tau / sigma - 1)
    assert change[-1] < 1e-10
    outer = grid.theta > radians(10)
    assert max(change[outer].max(), np.abs(member.psi - psi)[outer].max()) < 1e-9


def test_family_member_of_small_axis_stress():
    """tau theta_w = 260, close to where the public function ends the family."""
    hopper = make("cone", 40, 30)
    model, k, s = witness.describe(hopper)
    solution = solve_radial_family(hopper, 0.002)
    assert solution.sigma_axis == pytest.approx(0.002, rel=1e-15)
    assert solution.branch == "second"
    theta = np.linspace(0.01, hopper.half_angle, 20)
    sigma, psi = witness.shoot(model, k, s, 0.002, theta)
    assert deviation(solution, theta, sigma, psi) < 1e-10
    phi = witness.friction_angle(model, s, psi[-1])
    assert solution.friction_angle == pytest.approx(phi, abs=1e-10)


@pytest.mark.parametrize(
    ("kind", "sigma_axis"),
    [("wedge", 0.9), ("wedge", 0.2), ("cone", 0.37), ("cone", 0.05), ("von Mises", 0.1)],
)
def test_family_member_by_shooting(kind, sigma_axis):
    hopper = make(kind, 40, 15)
    model, k, s = witness.describe(hopper)
    solution = solve_radial_family(hopper, sigma_axis)
    theta = np.linspace(0.01, hopper.half_angle, 20)
    sigma, psi = witness.shoot(model, k, s, sigma_axis, theta)
    assert deviation(solution, theta, sigma, psi) < 1e-10
    phi = witness.friction_angle(model, s, psi[-1])
    assert solution.friction_angle == pytest.approx(phi, abs=1e-10)


def test_mass_flow_half_angle_inverts_the_friction_angle():
    hopper = make("cone", 40, 30)
    phi = mass_flow_friction_angle(hopper)
    assert mass_flow_half_angle(hopper, phi) == pytest.approx(hopper.half_angle, abs=1e-14)


# --- fold ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("delta", "half_angle", "fold", "limit"),
    [(30, 10, 28.61, 28.33), (30, 30, 19.74, 19.107), (40, 30, 17.90, 17.78)],
)
def test_fold_and_limit_of_the_reference_table(delta, half_angle, fold, limit):
    hopper = make("cone", delta, half_angle)
    found = friction_limit(hopper)
    assert found.end == "fold"
    assert degrees(found.friction_angle) == pytest.approx(fold, abs=0.01)
    assert degrees(mass_flow_friction_angle(hopper)) == pytest.approx(limit, abs=0.006)


def test_fold_of_figure_3_2_as_a_coefficient_of_friction():
    assert tan(friction_limit(FIGURE_3_2).friction_angle) == pytest.approx(0.3588, abs=1e-4)


@pytest.mark.parametrize(("delta", "half_angle"), [(30, 10), (30, 30), (40, 30)])
def test_fold_by_maximising_over_shot_solutions(delta, half_angle):
    hopper = make("cone", delta, half_angle)
    model, k, s = witness.describe(hopper)
    wall = np.array([hopper.half_angle])

    def phi(log_tau):
        return witness.friction_angle(
            model, s, witness.shoot(model, k, s, exp(-log_tau), wall)[1, 0]
        )

    # The bracket is wide: every fold of the table lies inside.
    top = minimize_scalar(lambda t: -phi(t), bounds=(log(5), log(120)), method="bounded")
    found = friction_limit(hopper)
    assert found.friction_angle == pytest.approx(-top.fun, abs=1e-8)
    assert log(found.tau) == pytest.approx(top.x, abs=1e-4)
    assert found.error_estimate < 1e-10


def test_two_solutions_below_the_fold():
    physical, second = figure_3_2(0.356), figure_3_2(0.356, "second")
    model, k, s = witness.describe(FIGURE_3_2)
    assert physical.sigma_axis > 1.5 * second.sigma_axis
    assert friction_limit(FIGURE_3_2).tau < 1 / second.sigma_axis
    theta = np.linspace(0.01, FIGURE_3_2.half_angle, 30)
    for solution in (physical, second):
        sigma, psi = witness.shoot(model, k, s, solution.sigma_axis, theta)
        assert deviation(solution, theta, sigma, psi) < 1e-10
        assert witness.friction_angle(model, s, psi[-1]) == pytest.approx(atan(0.356), abs=1e-11)


# Gaps to the fold, relative to the distance of fold and mass-flow limit.
@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize(("delta", "half_angle"), [(30, 30), (40, 30), (36.5, 26.5)])
def test_both_solutions_next_to_the_fold(delta, half_angle, gap):
    hopper = make("cone", delta, half_angle)
    model, k, s = witness.describe(hopper)
    fold = friction_limit(hopper)
    phi = fold.friction_angle - gap * (fold.friction_angle - mass_flow_friction_angle(hopper))
    physical, second = solve_radial(hopper, phi), solve_radial(hopper, phi, "second")
    assert 1 / physical.sigma_axis < fold.tau < 1 / second.sigma_axis
    for solution in (physical, second):
        psi = witness.shoot(model, k, s, solution.sigma_axis, np.array([hopper.half_angle]))[1, 0]
        assert witness.friction_angle(model, s, psi) == pytest.approx(phi, abs=1e-10)


@pytest.mark.parametrize(
    ("kind", "delta", "half_angle"),
    [("cone", 30, 30), ("cone", 60, 15), ("cone", 45, 6), ("wedge", 30, 10), ("von Mises", 30, 10)],
)
def test_physical_branch_reaches_up_to_the_friction_limit(kind, delta, half_angle):
    hopper = make(kind, delta, half_angle)
    largest = friction_limit(hopper).friction_angle
    for fraction in (0.9, 0.99, 0.999):
        solution = solve_radial(hopper, fraction * largest)
        assert solution.error_estimate < 1e-6
        assert solution.member.psi_wall_by_tau > 0


@pytest.mark.parametrize(
    ("kind", "delta", "half_angle"),
    [
        ("von Mises", 31.98401948694577, 48.472005623414645),
        ("von Mises", 59.088189815809024, 41.898479298407864),
        ("wedge", 77.8767481714816, 58.32514598435617),
        pytest.param("cone", 30, 30, marks=pytest.mark.soak),
    ],
)
def test_family_comes_to_an_end(kind, delta, half_angle):
    """Where psi at the wall grows steeply with tau, the walk must not turn back and forth."""
    members = list(islice(family(make(kind, delta, half_angle)), 300))
    assert len(members) < 300
    tau, psi_wall = (np.array([getattr(m, name) for m in members]) for name in ("tau", "psi_wall"))
    # Close to the end psi_w is what moves, and tau only by its rounding.
    assert np.all((np.diff(tau) > 1e-6 * tau[1:]) | (np.diff(psi_wall) > 0))
    assert np.all(np.diff(tau) > -1e-6 * tau[1:])


@pytest.mark.parametrize(
    ("kind", "delta", "half_angle", "fraction"),
    [("cone", 45, 6, 0.99), ("von Mises", 65.177, 15.158, 0.999), ("wedge", 69.596, 65.864, 0.472)],
)
def test_solution_that_a_crude_start_misses(kind, delta, half_angle, fraction):
    """Newton's first answer on a coarse grid is no solution: only the family leads to one."""
    hopper = make(kind, delta, half_angle)
    model, k, s = witness.describe(hopper)
    phi = fraction * friction_limit(hopper).friction_angle
    solution = solve_radial(hopper, phi)
    assert solution.error_estimate < 1e-10
    psi = witness.shoot(model, k, s, solution.sigma_axis, np.array([hopper.half_angle]))[1, 0]
    assert witness.friction_angle(model, s, psi) == pytest.approx(phi, abs=1e-6)


def test_solution_at_the_fold_itself():
    fold = friction_limit(FIGURE_3_2)
    solution = solve_radial(FIGURE_3_2, fold.friction_angle)
    # A double root: psi_w is exact to rounding, so tau only to its square root.
    assert solution.sigma_axis == pytest.approx(1 / fold.tau, rel=1e-5)


# --- figure 3.2 ----------------------------------------------------------------------------------


def test_reference_values_of_figure_3_2():
    solution = figure_3_2(0.356)
    theta, psi = solution.psi_maximum()
    assert psi == pytest.approx(0.73156, abs=5e-6)
    assert degrees(theta) == pytest.approx(13.92, abs=5e-3)
    # sigma(0) anew: the root of the shot wall friction on the side of larger stress.
    model, k, s = witness.describe(FIGURE_3_2)

    def excess(sigma_axis):
        wall = witness.shoot(model, k, s, sigma_axis, np.array([pi / 6]))[1, 0]
        return witness.friction_angle(model, s, wall) - atan(0.356)

    sigma_axis = brentq(excess, 0.055, 0.2, xtol=1e-14)
    assert solution.sigma_axis == pytest.approx(sigma_axis, rel=1e-9)
    fine = np.linspace(0.2, pi / 6, 4001)
    shot_sigma, shot_psi = witness.shoot(model, k, s, sigma_axis, fine)
    assert solution.sigma_wall == pytest.approx(shot_sigma[-1], rel=1e-9)
    assert psi == pytest.approx(shot_psi.max(), abs=1e-7)
    assert theta == pytest.approx(fine[np.argmax(shot_psi)], abs=1e-4)


# --- properties of the returned solution ---------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_parity(kind):
    hopper = make(kind, 35, 20)
    solution = solve_radial(hopper, radians(12))
    theta = np.linspace(0.003, hopper.half_angle, 41)
    right, left = solution.fields(theta), solution.fields(-theta)
    for (ours, mirrored), sign in zip(zip(right, left, strict=True), (1, -1, -1, 1), strict=True):
        np.testing.assert_allclose(mirrored, sign * ours, rtol=1e-12, atol=1e-13)
    np.testing.assert_array_equal(solution.psi_at(theta), right[1])


@pytest.mark.parametrize("kind", KINDS)
def test_fields_at_nodes_and_ends(kind):
    hopper = make(kind, 35, 20)
    model, k, s = witness.describe(hopper)
    solution = solve_radial(hopper, radians(12))
    sigma, psi, _, _ = solution.fields(solution.theta)
    np.testing.assert_allclose(sigma, solution.sigma, rtol=1e-14)
    np.testing.assert_allclose(psi, solution.psi, rtol=1e-14)
    assert solution.theta[-1] == hopper.half_angle
    assert solution.sigma_wall == sigma[-1]
    assert solution.psi_wall == pytest.approx(witness.wall_angle(model, s, radians(12)), abs=1e-14)
    axis = solution.fields(0.0)
    assert axis[0] == pytest.approx(solution.sigma_axis, rel=1e-13)
    assert axis[1] == pytest.approx(0, abs=1e-15)
    assert axis[2] == 0
    assert axis[3] == pytest.approx(witness.apex(model, k, s, solution.sigma_axis)[0], rel=1e-12)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("theta", [1e-16, 1e-13, 1e-10, 1e-7])
def test_slopes_next_to_the_axis(kind, theta):
    """Sampling -theta_w..theta_w rarely hits 0 exactly; slopes may not lose digits there."""
    solution = solve_radial(make(kind, 35, 20), radians(12))
    _, _, dsigma, dpsi = solution.fields(np.array([0.0, theta]))
    assert dpsi[1] == pytest.approx(dpsi[0], rel=1e-9)
    assert dsigma[1] == pytest.approx(dsigma[0], abs=1e-6)


@pytest.mark.parametrize(("kind", "delta", "half_angle", "fraction"), GRID[::5] + CLOSE)
def test_psi_maximum_against_dense_samples(kind, delta, half_angle, fraction):
    hopper = make(kind, delta, half_angle)
    solution = solve_radial(hopper, fraction * friction_limit(hopper).friction_angle)
    angle, largest = solution.psi_maximum()
    theta = np.linspace(0, hopper.half_angle, 20001)
    sampled = solution.psi_at(theta)
    assert largest == pytest.approx(sampled.max(), abs=1e-6)
    assert largest >= sampled.max() - 1e-13
    assert solution.psi_at(angle)[0] == pytest.approx(largest, abs=1e-14)


def test_psi_maximum_just_inside_the_wall():
    hopper = make("cone", 30, 10)

    def wall_slope(phi):
        return solve_radial(hopper, phi).fields(hopper.half_angle)[3][0]

    peak_at_wall = brentq(wall_slope, 0.0, 0.02, xtol=1e-13)
    # A little less friction moves the peak inside, by less than the spacing of a coarse search.
    solution = solve_radial(hopper, peak_at_wall - 1e-5)
    theta = np.linspace(0.9 * hopper.half_angle, hopper.half_angle, 20001)
    sampled = solution.psi_at(theta)
    assert theta[np.argmax(sampled)] < hopper.half_angle
    assert solution.psi_maximum()[1] >= sampled.max() - 1e-13


@pytest.mark.parametrize(
    ("hopper", "mu", "before"),
    [
        (FIGURE_3_2, 0.356, figure_3_2(0.35)),
        (FIGURE_3_2, 0.358, figure_3_2(0.1)),
        (FIGURE_3_2, 0.35, figure_3_2(0.356, "second")),
        (FIGURE_3_2, 0.0, figure_3_2(0.358)),
        (make("cone", 31, 29), 0.36, figure_3_2(0.356)),
        (make("wedge", 35, 10), 0.3, figure_3_2(0.356)),
        (make("von Mises", 30, 30), 0.2, figure_3_2(0.2)),
    ],
)
def test_warm_start_gives_the_cold_solution(hopper, mu, before):
    cold = solve_radial(hopper, atan(mu))
    warm = solve_radial(hopper, atan(mu), start=before)
    theta = np.linspace(0, hopper.half_angle, 50)
    assert warm.hopper == hopper
    assert warm.sigma_axis == pytest.approx(cold.sigma_axis, rel=1e-10)
    assert deviation(warm, theta, *cold.fields(theta)[:2]) < 1e-10
    assert warm.error_estimate < 1e-10


@pytest.mark.parametrize(("delta", "half_angle"), [(40, 30), (60, 30)])
@pytest.mark.parametrize("before", [(0.5, "physical"), (1e-3, "physical"), (0.5, "second")])
@pytest.mark.parametrize("gap", [2.0, 0.5, 1e-3])
def test_warm_start_never_loses_a_solution(delta, half_angle, before, gap):
    """From either side of the fold; gaps are relative to the distance of fold and limit."""
    hopper = make("cone", delta, half_angle)
    fold = friction_limit(hopper).friction_angle
    width = fold - mass_flow_friction_angle(hopper)
    start = solve_radial(hopper, fold - before[0] * width, before[1])
    cold = solve_radial(hopper, fold - gap * width)
    warm = solve_radial(hopper, fold - gap * width, start=start)
    assert warm.sigma_axis == pytest.approx(cold.sigma_axis, rel=1e-7)


def test_arrays_shared_between_solutions_are_read_only():
    solution = figure_3_2(0.2)
    with pytest.raises(ValueError, match="read-only"):
        solution.theta[0] = 0.0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("delta", "half_angle"), [(25, 10), (30, 30), (40, 20), (47, 5), (55, 33)])
def test_wall_angle_is_met_exactly(kind, delta, half_angle):
    """A wall angle of -1e-33, by rounding, would make a smooth wall a second solution's end."""
    hopper = make(kind, delta, half_angle)
    smooth, rougher = islice(family(hopper), 2)
    assert smooth.psi_wall == 0.0 == smooth.closure.value
    assert rougher.closure.value in (rougher.psi_wall, rougher.tau)
    assert [found.psi_wall for found in radial_solutions(hopper, 0.0)] == [0.0]
