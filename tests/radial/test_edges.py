"""Limits and numbers of solutions where folds are flat, near, or several."""

from math import degrees, radians

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from hopper import Hopper, friction_limit, radial_solutions, solve_radial
from hopper.radial.collocation import Closure
from hopper.radial.critical_point import critical_points
from hopper.radial.family import family, neighbour
from hopper.radial.mass_flow import mass_flow_friction_angle
from hopper.radial.members import number_of_solutions
from hopper.radial.pieces import pieces
from hopper.radial.solution import solution_of
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.radial import taylor, witness


def make(delta, half_angle, material=MOHR_COULOMB):
    return Hopper("cone", radians(delta), radians(half_angle), material)


# --- the limit -----------------------------------------------------------------------------------


@pytest.mark.parametrize(("delta", "half_angle"), [(50, 5), (49.83, 5.39), (50, 7), (60, 10)])
def test_limit_is_not_below_the_mass_flow_limit(delta, half_angle):
    """Nor is any member, shot at 40 stresses on the axis, above it."""
    hopper = make(delta, half_angle)
    limit = friction_limit(hopper)
    assert limit.friction_angle >= mass_flow_friction_angle(hopper)
    tau = np.geomspace(1, 1e5, 40) / hopper.half_angle
    at = taylor.batch([hopper] * tau.size)
    shot = taylor.friction_angle(at, taylor.shoot(at, tau)[1][-1])
    assert np.all(shot <= limit.friction_angle + limit.error_estimate)


def test_a_fold_that_is_none():
    limit = friction_limit(make(50, 5))
    assert limit.end == "axis"
    assert degrees(limit.friction_angle) == pytest.approx(37.0022957, abs=1e-7)


# tau theta_w at the fold as shot. At 50 deg, 7 deg it is 7.7e-6 deg above the mass-flow limit.
@pytest.mark.parametrize(
    ("delta", "half_angle", "layer"),
    [(50, 7, 407), (49.83, 5.39, None), (65, 20, None), (30, 2, None), (30, 1.8, None)],
)
def test_flat_folds(delta, half_angle, layer):
    hopper = make(delta, half_angle)
    limit = friction_limit(hopper)
    assert limit.end == "fold"
    (tau,), (phi,) = taylor.fold([hopper], [limit.tau])
    assert abs(limit.friction_angle - phi) <= limit.error_estimate < 1e-11
    assert limit.tau == pytest.approx(float(tau), rel=1e-2)
    if layer:
        assert limit.tau * hopper.half_angle == pytest.approx(layer, rel=0.03)


def test_limits_of_narrow_cones_are_smooth():
    phi = [friction_limit(make(30, angle)).friction_angle for angle in (1.8, 1.9, 2.0, 2.1, 2.2)]
    assert np.all(np.diff(phi) < 0)
    assert np.abs(np.diff(phi, 3)).max() < 1e-2 * np.abs(np.diff(phi)).max()


# --- the number of solutions ---------------------------------------------------------------------


@pytest.mark.parametrize("distance", [1e-3, 1e-5, 1e-7, 1e-9, 1e-11])
def test_solutions_next_to_a_flat_fold(distance):
    """Close below the fold there are two, on both sides of it; each is where shooting has it."""
    hopper = make(65, 20)
    limit = friction_limit(hopper)
    phi = limit.friction_angle * (1 - distance)
    found = radial_solutions(hopper, phi)
    expected = 2 if phi > mass_flow_friction_angle(hopper) else 1
    assert number_of_solutions(hopper, phi) == len(found) == expected
    tau = np.array([solution.member.tau for solution in found])
    error = np.array([solution.error_estimate for solution in found])
    true, _, _ = taylor.solve([hopper] * len(found), [phi] * len(found), tau, 3 * error)
    assert np.all(np.abs(np.log(tau / true)) <= error)
    assert true[0] < limit.tau < (true[1] if expected == 2 else np.inf)


@pytest.mark.parametrize(("phi", "number"), [(9.89608, 3), (9.8962, 2)])
def test_three_solutions(phi, number):
    hopper = make(30, 45)
    found = radial_solutions(hopper, radians(phi))
    assert number_of_solutions(hopper, radians(phi)) == len(found) == number
    assert [one.branch for one in found] == ["physical", "second", "third"][:number]
    # Sign changes of psi_w along the family, shot from the smooth wall to a thin layer.
    at = taylor.batch([hopper] * 100)
    psi = taylor.shoot(at, np.geomspace(found[0].member.tau / 2, 5e3, 100))[1][-1]
    above = psi > taylor.wall_angle([hopper], [radians(phi)])
    assert np.sum(above[1:] != above[:-1]) == number


def test_second_fold():
    hopper = make(30, 45)
    first, second, third = pieces(hopper)
    assert [piece.rising for piece in (first, second, third)] == [True, False, True]
    phi = hopper.material.friction_angle(hopper.delta, second.end.psi_wall)
    assert degrees(phi) == pytest.approx(9.893917046, abs=1e-8)
    assert third.end.end == "axis"
    assert degrees(mass_flow_friction_angle(hopper)) == pytest.approx(9.896091, abs=1e-6)
    assert friction_limit(hopper).psi_wall == first.end.psi_wall


@pytest.mark.parametrize(
    ("delta", "half_angle", "distance"),
    [
        (65, 20, 1e-14),
        (30, 30, 0),
        (30, 30, 1e-14),
        (30, 30, 3e-12),
        *(
            pytest.param(delta, half_angle, distance, marks=pytest.mark.soak)
            for delta, half_angle in ((65, 20), (45, 6), (38.5, 12), (30, 45), (52, 30))
            for distance in (0, 1e-15, 1e-13, 3e-12)
        ),
    ],
)
def test_solution_within_rounding_of_the_fold(delta, half_angle, distance):
    hopper = make(delta, half_angle)
    limit = friction_limit(hopper)
    phi = limit.friction_angle * (1 - distance)
    solution = solve_radial(hopper, phi)
    error = solution.error_estimate
    tau, largest = taylor.fold([hopper], [limit.tau])
    # Rounding may put phi beyond the fold: then the fold is what comes nearest.
    if phi < largest[0]:
        tau, _, _ = taylor.solve([hopper], [phi], [solution.member.tau], [3 * error])
    assert abs(np.log(solution.member.tau / tau[0])) <= error


# --- the jump of the limit of wide von Mises cones -----------------------------------------------


def stable_rate(hopper):
    """Return the rate at which the limiting solution is approached at its critical point.

    From the equations of the witness times their determinant, regular where psi is singular.
    """
    model, k, s = witness.describe(hopper)
    *_, last = family(hopper)
    found = critical_points(last)
    if found is None:
        return None

    def field(point):
        theta, log_sigma, psi = point
        sigma = np.exp(log_sigma)
        (_, tt, rt, _), (tt_psi, rt_psi) = witness.components(model, s, psi)
        determinant = rt * tt_psi - rt_psi * tt
        dsigma, dpsi = witness.slopes(model, k, s, theta, sigma, psi)
        return determinant * np.array([1.0, dsigma / sigma, dpsi])

    # Beside the singular angle itself, where the quotients of the witness are 0/0.
    psi = hopper.material.singular_angle(hopper.delta)
    point = np.array([found[0].theta, found[0].log_sigma, psi])
    steps = 1e-5 * np.eye(3)
    jacobian = np.transpose([(field(point + h) - field(point - h)) / 2e-5 for h in steps])
    return np.min(np.linalg.eigvals(jacobian).real)


def test_critical_point_vanishes_where_the_limit_jumps():
    """The limits of 34.5 deg below delta = 39.7245 deg and of 20.6 deg above are both right.

    Above, psi becomes singular inside at a saddle. It meets a second critical point there, its
    rate going to 0 as the square root of the distance, and below there is none: solutions pass.
    """
    deltas = np.array([39.73, 39.74, 39.76])
    squares = np.array([stable_rate(make(delta, 60, VON_MISES)) ** 2 for delta in deltas])
    slope = (squares[1] - squares[0]) / (deltas[1] - deltas[0])
    vanishing = deltas[0] - squares[0] / slope
    assert vanishing == pytest.approx(39.7245, abs=2e-4)
    assert squares[2] == pytest.approx(slope * (deltas[2] - vanishing), rel=0.05)
    for delta, end, phi in (
        (vanishing - 1e-3, "wall", 34.5131),
        (vanishing + 1e-3, "interior", 20.5),
    ):
        limit = friction_limit(make(delta, 60, VON_MISES))
        assert limit.end == end
        assert degrees(limit.friction_angle) == pytest.approx(phi, abs=0.2)


def test_a_solution_of_scipy_beyond_the_smaller_limit():
    """At delta = 39.72 deg solve_bvp has one of psi_w = 55 deg, phi = 34.5 deg, below singular."""
    hopper = make(39.72, 60, VON_MISES)
    model, k, s = witness.describe(hopper)
    closest = pieces(hopper)[-1].end.closest
    assert closest is not None
    start = solution_of(neighbour(closest, Closure("psi_wall", radians(55))))

    def slopes(theta, y):
        with np.errstate(divide="ignore", invalid="ignore"):
            dsigma, dpsi = witness.slopes(model, k, s, theta, *y)
            dpsi = dpsi + k * y[1] / theta
        dsigma[0], dpsi[0] = 0.0, (1 + k) * witness.apex(model, k, s, y[0, 0])[0]
        return np.vstack([dsigma, dpsi])

    theta = np.concatenate([[0.0], start.theta])
    reached = solve_bvp(
        slopes,
        lambda axis, wall: np.array([axis[1], wall[1] - radians(55)]),
        theta,
        np.array(start.fields(theta)[:2]),
        S=np.diag([0.0, -k]),
        tol=1e-6,
        max_nodes=20000,
    )
    assert reached.success
    assert reached.y[1].max() < hopper.material.singular_angle(hopper.delta)
    assert degrees(witness.friction_angle(model, s, radians(55))) > 34
    assert np.abs(start.psi_at(reached.x) - reached.y[1]).max() < 1e-6


def test_integration_towards_an_end_that_overflows():
    """Steps along the limiting solution that are too long, to infinite stress, are refused."""
    cone = Hopper("cone", 0.5144322640519391, 0.3062345695018068)
    (solution,) = radial_solutions(cone, 0.7 * friction_limit(cone).friction_angle)
    assert solution.branch == "physical"
