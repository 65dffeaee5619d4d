"""Where a family of radial solutions ends because psi becomes singular inside the hopper.

Written for (theta, log sigma, psi) as functions of a parameter, the radial equations are regular at
the singular angle, and the points where the slopes are 0/0 are saddles of that flow, as the sonic
point of a nozzle is. The limiting solution runs smoothly into one of them, whatever the half angle,
and leaves it along the unstable direction, with a kink.
"""

from dataclasses import dataclass, replace
from math import log

import numpy as np
import scipy

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.collocation import Member, tail
from hopper.radial.equations import flow, slopes
from hopper.radial.grid import Grid, Map, layer_clustering, mapped_grid, transfer
from hopper.radial.steps import residual_and_jacobian

_SIZES = (54, 36)
_NEWTON_STEPS = 15
# Half angles to start from, relative to where psi of a member is closest to singular, the largest
# relative distance of the saddle from there, and the largest log sigma and psi on the way.
_STARTS = 0.8, 0.9, 0.95, 0.7, 0.97, 0.6, 0.99, 0.5
_NEAR, _LARGEST = 0.6, 50.0
# Last Chebyshev coefficients of a solution that is smooth.
_SMOOTH = 1e-9
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
def limiting_solution(last: Member) -> LimitingSolution | None:
    """Return the solution that ends the family; None where there is none inside the hopper.

    ``last`` is a member whose psi comes close to the singular angle inside the hopper.

    Raises
    ------
    ConvergenceError
        If the solution is not resolved from the critical point to the wall.
    """
    found = critical_points(last)
    if found is None:
        return None
    psi_wall, other = (_psi_wall(last.hopper, point) for point in found)
    error = abs(psi_wall - other) + 10 * _RELATIVE
    if error > _ACCEPTABLE:
        raise ConvergenceError(f"end of the family not resolved: psi at the wall to {error:.1e}")
    return LimitingSolution(psi_wall, found[0].tau, error)


@checked
def critical_points(last: Member) -> tuple[CriticalPoint, CriticalPoint] | None:
    """Return the saddle where psi is closest to singular, on two grids; None if there is none.

    Up to it the limiting solution is smooth, so that collocation on the half grid of a hopper that
    ends there converges spectrally. That its half angle is unknown makes up for the equation at
    its wall that others leave out: with psi at its singular angle the two equations there ask for
    slopes that are 0/0. ``last`` as in :func:`limiting_solution`.
    """
    hopper, nearest = last.hopper, last.kink[0] * last.hopper.half_angle
    for place in _STARTS:
        start = cut(last, place * nearest, _SIZES[0])
        fine = _smooth_end(hopper, start.grid, start.u, nearest)
        if fine is None:
            continue
        point, grid, u = fine
        if point.theta >= hopper.half_angle:
            return None
        other = mapped_grid(_SIZES[1], point.theta, grid.map)
        even, odd = transfer(grid, other, "even"), transfer(grid, other, "odd")
        u = np.concatenate([even @ u[: grid.size], odd @ u[grid.size : -1], u[-1:]])
        coarse = _smooth_end(hopper, other, u, nearest)
        if coarse:
            return point, coarse[0]
    return None


def _smooth_end(
    hopper: Hopper, grid: Grid, u: Array, nearest: float
) -> tuple[CriticalPoint, Grid, Array] | None:
    """Solve for a critical point from u on a grid; None unless it is smooth and near."""
    for _ in range(_NEWTON_STEPS):
        step = _newton_step(hopper, grid, u)
        u, angle = u + step[:-1], grid.half_angle + float(step[-1])
        if not (abs(angle / nearest - 1) < _NEAR and np.abs(u[:-1]).max() < _LARGEST):
            return None
        grid = mapped_grid(grid.size, angle, grid.map)
        if np.abs(step[:-2]).max() < _TOLERANCE:
            # Solutions that are singular there are not resolved.
            if tail(u[: grid.size], u[grid.size : -1]) > _SMOOTH:
                return None
            log_sigma = float(u[grid.size - 1]) - log(u[-1])
            return CriticalPoint(angle, log_sigma, float(u[-1])), grid, u
    return None


def _newton_step(hopper: Hopper, grid: Grid, u: Array) -> Array:
    """Return the Newton correction of u and the half angle, shape (2 m + 2,)."""
    singular = hopper.material.singular_angle(hopper.delta)
    residual, jacobian = residual_and_jacobian(hopper, grid, u)
    change = _DIFFERENCE * grid.half_angle
    wider = mapped_grid(grid.size, grid.half_angle + change, grid.map)
    by_angle = (residual_and_jacobian(hopper, wider, u)[0] - residual) / change
    system = np.zeros((u.size + 1, u.size + 1))
    system[:-1, :-1], system[:-1, -1] = jacobian, by_angle
    system[-2, : grid.size] = grid.axis_row
    system[-1, -3] = 1.0
    right = np.append(residual, u[-2] - singular)
    right[-2] = grid.axis_row @ u[: grid.size]
    return -np.linalg.solve(system, right)


@checked
def cut(member: Member, angle: float, size: int = 54) -> Member:
    """Return the part of a member inside a narrower hopper."""
    by = Map(layer_clustering(member.hopper, member.tau))
    grid = mapped_grid(size, angle, by)
    even, odd = (member.grid.interpolation(grid.theta, parity) for parity in ("even", "odd"))
    u = np.concatenate([even @ member.log_ratio, odd @ member.psi, member.u[-1:]])
    return replace(member, hopper=replace(member.hopper, half_angle=angle), grid=grid, u=u)


def _psi_wall(hopper: Hopper, point: CriticalPoint) -> float:
    """Follow the limiting solution from the saddle to the wall."""
    psi = hopper.material.singular_angle(hopper.delta)
    direction = _unstable_direction(hopper, np.array([point.theta, point.log_sigma, psi]))
    left = np.array([point.log_sigma, psi]) + _OFFSET * direction

    def slope(theta: float, state: Array) -> Array:
        angle, sigma = np.array([theta]), np.exp(state[:1])
        if not np.isfinite([*sigma, *state]).all():  # of a step too long, which is then refused
            return np.full(2, np.nan)
        return np.concatenate(slopes(hopper, angle, sigma, state[1:]))

    interval = (point.theta + _OFFSET, hopper.half_angle)
    with np.errstate(all="ignore"):  # a step too far is rejected
        reached = scipy.integrate.solve_ivp(
            slope, interval, left, "DOP853", rtol=_RELATIVE, atol=_ABSOLUTE
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
