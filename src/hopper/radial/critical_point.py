"""Where a family of radial solutions ends because psi becomes singular inside the hopper.

Written for (theta, log sigma, psi) as functions of a parameter, the radial equations are regular at
the singular angle, and the points where the slopes are 0/0 are saddles of that flow, as the sonic
point of a nozzle is. The limiting solution runs smoothly into one of them, whatever the half angle,
and leaves it along the unstable direction, with a kink.
"""

from dataclasses import dataclass
from math import degrees, log

import numpy as np
from scipy.integrate import solve_ivp

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton
from hopper.radial.equations import flow, slopes
from hopper.radial.grid import half_grid

_SIZES = (36, 54)
_SECANT_STEPS = 40
_TOLERANCE = 1e-12
_ACCEPTABLE = 1e-8
# Distance from the saddle (radians) to which the unstable direction is followed: its error is of
# second order.
_OFFSET = 1e-6
_DIFFERENCE = 1e-5
_RELATIVE, _ABSOLUTE = 1e-11, 1e-12


@dataclass(frozen=True)
class CriticalPoint:
    """The saddle: polar angle ``theta`` (radians), log sigma, and tau = 1 / sigma_0."""

    theta: float
    log_sigma: float
    tau: float

    __repr__ = brief("theta deg", "log_sigma", "tau")


@dataclass(frozen=True)
class LimitingSolution:
    """psi at the wall (radians) and tau of the limiting solution, with the error of psi."""

    psi_wall: float
    tau: float
    error_estimate: float

    __repr__ = brief("psi_wall deg", "tau", "error_estimate deg")


@checked
def limiting_solution(hopper: Hopper, start: Member) -> LimitingSolution | None:
    """Return the solution that ends the family; None where psi becomes singular only at the wall.

    ``start`` is a member of a narrower hopper of the same material whose psi at the wall is close
    to the singular angle.

    Raises
    ------
    ConvergenceError
        If the critical point is not resolved to 1e-8.
    """
    coarse, fine = (critical_point(hopper, start, size) for size in _SIZES)
    if coarse is None or fine is None:
        return None
    psi_wall = _psi_wall(hopper, fine)
    error = abs(psi_wall - _psi_wall(hopper, coarse)) + 10 * _RELATIVE
    if error > _ACCEPTABLE:
        raise ConvergenceError(f"end of the family not resolved: psi at the wall to {error:.1e}")
    return LimitingSolution(psi_wall, fine.tau, error)


@checked
def critical_point(hopper: Hopper, start: Member, size: int) -> CriticalPoint | None:
    """Return the saddle nearest to the axis, None if there is none inside the hopper.

    In narrower hoppers psi can reach the singular angle at the wall. Widening one until the slopes
    there are 0/0 leads to the saddle; the solution up to it is smooth, so that collocation on
    ``size`` points of the half grid converges spectrally.

    Raises
    ------
    ConvergenceError
        If the iteration fails.
    """
    singular = Closure("psi_wall", hopper.material.singular_angle(hopper.delta))

    def widened(angle: float, near: Member) -> tuple[float, Member]:
        narrow = Hopper(hopper.geometry, hopper.delta, angle, hopper.material)
        grid = half_grid(size, angle)
        member = newton(narrow, grid, singular, near.on(grid))
        if member is None:
            raise ConvergenceError(
                f"end of the family not resolved at theta = {degrees(angle):.6g} deg"
            )
        return float(flow(narrow, *_end(member))[2][0]), member

    before = start.hopper.half_angle
    at_before, member = widened(before, start)
    angle = min(1.05 * before, hopper.half_angle)
    for _ in range(_SECANT_STEPS):
        excess, member = widened(angle, member)
        if excess == at_before:
            break
        following = angle - excess * (angle - before) / (excess - at_before)
        if abs(following - angle) < _TOLERANCE:
            theta, sigma, _ = _end(member)
            return CriticalPoint(float(theta[0]), log(sigma[0]), member.tau)
        # The excess decreases and is convex: a secant from the left does not overshoot a zero.
        if not angle < following < hopper.half_angle and excess > 0:
            if angle == hopper.half_angle:
                return None
            following = hopper.half_angle
        before, at_before, angle = angle, excess, following
    raise ConvergenceError(f"end of the family not resolved near theta = {degrees(angle):.6g} deg")


def _end(member: Member) -> tuple[Array, Array, Array]:
    """Return (theta, sigma, psi) at the wall, each of shape (1,)."""
    sigma = np.exp(member.log_ratio[-1:]) / member.tau
    return member.grid.theta[-1:], sigma, member.psi[-1:]


def _psi_wall(hopper: Hopper, point: CriticalPoint) -> float:
    """Follow the limiting solution from the saddle to the wall."""
    psi = hopper.material.singular_angle(hopper.delta)
    direction = _unstable_direction(hopper, np.array([point.theta, point.log_sigma, psi]))
    left = np.array([point.log_sigma, psi]) + _OFFSET * direction

    def slope(theta: float, state: Array) -> Array:
        if not np.isfinite(state).all():  # of a step too long, which is then refused
            return np.full(2, np.nan)
        angle, sigma = np.array([theta]), np.exp(state[:1])
        return np.concatenate(slopes(hopper, angle, sigma, state[1:]))

    reached = solve_ivp(
        slope,
        (point.theta + _OFFSET, hopper.half_angle),
        left,
        "DOP853",
        rtol=_RELATIVE,
        atol=_ABSOLUTE,
    )
    if not reached.success:
        raise ConvergenceError(f"limiting solution not resolved: {reached.message}")
    return float(reached.y[1, -1])


def _unstable_direction(hopper: Hopper, point: Array) -> Array:
    """Return d(log sigma, psi)/d theta with which the solution leaves the saddle."""
    steps = _DIFFERENCE * np.vstack([np.eye(3), -np.eye(3)])
    theta, log_sigma, psi = (point + steps).T
    values = np.array(flow(hopper, theta, np.exp(log_sigma), psi))
    jacobian = (values[:, :3] - values[:, 3:]) / (2 * _DIFFERENCE)
    rates, directions = np.linalg.eig(jacobian)
    leaving = directions[:, np.argmax(rates.real)].real
    return leaving[1:] / leaving[0]
