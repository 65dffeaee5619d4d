"""The radial velocity against an independent integration, and its singularity."""

import pickle
from math import atan, degrees, pi, radians, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from hopper import Hopper, solve_radial, solve_radial_family, solve_velocity
from hopper.errors import SingularVelocityError
from hopper.radial.velocity import decay_exponent
from hopper.yield_conditions import VON_MISES
from tests.radial import witness

WEDGE = Hopper("wedge", radians(35), radians(20))
CONE = Hopper("cone", radians(30), radians(30))
CONE_VON_MISES = Hopper("cone", radians(30), radians(30), VON_MISES)
DECAY = {"wedge": 2.0, "cone": 3.0, "von Mises": sqrt(12)}


def integrate(hopper, sigma_axis, theta):
    """Shoot sigma, psi and log u together; return log u at ``theta``."""
    model, k, s = witness.describe(hopper)
    decay = DECAY["von Mises" if model == "von-mises" else hopper.geometry]
    slope, curvature = witness.apex(model, k, s, sigma_axis)
    start = 1e-5 * sigma_axis * theta[-1]

    def slopes(t, y):
        return [*witness.slopes(model, k, s, t, y[0], y[1]), -decay * np.tan(2 * y[1])]

    result = solve_ivp(
        slopes,
        (start, theta[-1]),
        [sigma_axis + curvature * start**2 / 2, slope * start, -decay * slope * start**2],
        method="DOP853",
        rtol=1e-13,
        atol=1e-15,
        t_eval=theta,
    )
    assert result.success, result.message
    return result.y[2]


@pytest.mark.parametrize(
    ("hopper", "mu"),
    [
        (WEDGE, 0.0),
        (WEDGE, 0.1),
        (WEDGE, 0.4),
        (CONE, 0.0),
        (CONE, 0.2),
        (CONE, 0.356),
        (CONE, 0.358),
        (CONE_VON_MISES, 0.0),
        (CONE_VON_MISES, 0.2),
        (CONE_VON_MISES, 0.356),
    ],
)
def test_velocity_by_shooting(hopper, mu):
    solution = solve_radial(hopper, atan(mu))
    velocity = solve_velocity(solution)
    theta = np.linspace(hopper.half_angle / 40, hopper.half_angle, 40)
    log_u = integrate(hopper, solution.sigma_axis, theta)
    error = np.abs(np.log(velocity.at(theta)) - log_u).max()
    assert error < 1e-9
    assert velocity.error_estimate < 1e-10
    assert velocity.wall == pytest.approx(np.exp(log_u[-1]), rel=1e-9)
    np.testing.assert_allclose(velocity.at(-theta), velocity.at(theta), rtol=1e-13)
    assert velocity.at(0.0) == pytest.approx(1, abs=1e-13)


@pytest.mark.parametrize(("hopper", "decay"), [(WEDGE, 2), (CONE, 3), (CONE_VON_MISES, sqrt(12))])
def test_decay_exponent(hopper, decay):
    assert decay_exponent(solve_radial(hopper, 0.1)) == decay


def test_decay_exponent_of_von_mises_from_levy_s_flow_rule():
    """The rate of deformation of v = -u / r^2 is proportional to the deviator T - p."""
    psi = 0.3
    (rr, tt, rt, pp), _ = witness.components("von-mises", 0.5, psi)
    # V_rr = 2 u / r^3 and V_rt = -u' / (2 r^3).
    ratio = rt / (rr - (rr + tt + pp) / 3)
    assert -4 * ratio == pytest.approx(-DECAY["von Mises"] * np.tan(2 * psi), rel=1e-13)


def test_wall_velocity_of_figure_3_2():
    assert solve_velocity(solve_radial(CONE, atan(0.356))).wall == pytest.approx(
        1.4147e-3, abs=5e-8
    )


@pytest.mark.parametrize("gap", [1e-2, 1e-3])
def test_velocity_next_to_its_singularity(gap):
    """The largest psi stays below pi/4 by ``gap`` only: tan(2 psi) is large and narrow."""

    def excess(sigma_axis):
        return solve_radial_family(CONE, sigma_axis).psi_maximum()[1] - (pi / 4 - gap)

    solution = solve_radial_family(CONE, brentq(excess, 0.0406, 0.0684))
    velocity = solve_velocity(solution)
    theta = np.linspace(0.01, CONE.half_angle, 20)
    error = np.abs(np.log(velocity.at(theta)) - integrate(CONE, solution.sigma_axis, theta)).max()
    # An error of 1e-12 in psi grows to one of 1e-12 / (2 gap**2) in tan(2 psi).
    assert error < 10 * velocity.error_estimate + 1e-12 / gap**2


def test_velocity_is_singular_on_the_second_branch():
    solution = solve_radial(CONE, atan(0.356), "second")
    model, k, s = witness.describe(CONE)

    def excess(theta):
        return witness.shoot(model, k, s, solution.sigma_axis, np.array([theta]))[1, 0] - pi / 4

    theta = brentq(excess, radians(1), radians(8), xtol=1e-12)
    message = rf"psi reaches pi/4 at theta = {degrees(theta):.6g} deg; lower the wall friction"
    with pytest.raises(SingularVelocityError, match=message) as raised:
        solve_velocity(solution)
    assert raised.value.theta == pytest.approx(theta, abs=1e-9)


def test_velocity_is_singular_at_a_very_rough_wall():
    hopper = Hopper("wedge", radians(50), radians(10))
    phi = radians(49.5)
    solution = solve_radial(hopper, phi)
    assert solution.psi_wall > pi / 4
    model, k, s = witness.describe(hopper)
    fine = np.linspace(0.01, hopper.half_angle, 2000)
    _, psi = witness.shoot(model, k, s, solution.sigma_axis, fine)
    with pytest.raises(SingularVelocityError, match=r"psi reaches pi/4") as raised:
        solve_velocity(solution)
    assert raised.value.theta == pytest.approx(np.interp(pi / 4, psi, fine), abs=1e-5)


@pytest.mark.parametrize("hopper", [CONE, CONE_VON_MISES])
def test_solution_from_another_process_has_the_same_velocity(hopper):
    solution = solve_radial(hopper, 0.2)
    copy = pickle.loads(pickle.dumps(solution))
    assert solve_velocity(copy).wall == solve_velocity(solution).wall
