"""The largest wall friction with a radial solution, and what ends the family there."""

from dataclasses import dataclass
from functools import lru_cache
from math import exp, log

import numpy as np

from hopper.arguments import checked
from hopper.brief import brief
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton
from hopper.radial.family import SIZE, neighbour
from hopper.radial.grid import Grid, half_grid
from hopper.radial.pieces import End as End
from hopper.radial.pieces import Limit, first_piece

# Secant in log(tau) for the fold: first step, and the step at which it ends; rounding of the slope
# leaves 1e-8.
_FOLD_PROBE, _FOLD_TOLERANCE, _FOLD_STEPS = 1e-3, 1e-6, 20
_LAST_STEP = 1e-10
# Of an angle computed from another, radians.
_ROUNDING = 1e-15


@dataclass(frozen=True)
class FrictionLimit:
    """The largest wall friction with a radial solution on the physical branch.

    Attributes
    ----------
    friction_angle : float
        phi, radians.
    end : "fold", "wall", "interior" or "axis"
        What ends the branch: a second branch; a wall as rough as the material; psi at its singular
        angle inside the hopper; or vanishing stress on the axis (the mass-flow limit).
    tau, psi_wall : float
        1 / sigma_0, and psi(theta_w) in radians, there.
    error_estimate : float
        Of ``friction_angle``, radians.
    """

    friction_angle: float
    end: End
    tau: float
    psi_wall: float
    error_estimate: float

    __repr__ = brief("end", "friction_angle deg", "tau", "psi_wall deg", "error_estimate deg")


@checked
@lru_cache(maxsize=256)
def friction_limit(hopper: Hopper) -> FrictionLimit:
    """Return the largest wall friction that has a radial solution.

    Raises
    ------
    NoRadialSolutionError
        If not even a smooth wall has one.
    ConvergenceError
        If the end of the branch is not resolved.

    Examples
    --------
    >>> from hopper import Hopper, friction_limit
    >>> limit = friction_limit(Hopper("cone", delta=0.7, half_angle=0.35))
    >>> limit.end, round(limit.friction_angle, 4)
    ('fold', 0.4372)
    """
    return _of(hopper, first_piece(hopper).end)


def _of(hopper: Hopper, end: Limit) -> FrictionLimit:
    law, delta = hopper.material, hopper.delta
    phi = law.friction_angle(delta, end.psi_wall)
    sides = (law.friction_angle(delta, end.psi_wall + side) for side in (-end.error, end.error))
    error = max(abs(side - phi) for side in sides) + _ROUNDING
    return FrictionLimit(phi, end.end, end.tau, end.psi_wall, error)


@checked
def fold_near(hopper: Hopper, start: Member) -> Member | None:
    """Return the resolved member at the fold, from a member close to it, None if that fails.

    ``start`` may be of a hopper close to this one.
    """
    for size in (SIZE, start.grid.size):
        grid = half_grid(size, hopper.half_angle, start.grid.map.clustering)
        if near := fold_on(hopper, grid, start):
            break
    else:
        return None
    resolved = neighbour(near, Closure("tau", near.tau))
    # Where the stress on the axis is small the mesh moves the fold.
    fold = fold_on(hopper, resolved.grid, resolved)
    return fold and neighbour(fold, Closure("tau", fold.tau))


@checked
def fold_on(hopper: Hopper, grid: Grid, start: Member) -> Member | None:
    """Return the fold on one grid by the secant method in log(tau), None if that fails."""
    u, log_tau = start.on(grid), log(start.tau)
    before, at_before, curvature = log_tau + _FOLD_PROBE, np.nan, np.nan
    for _ in range(_FOLD_STEPS):
        # The tangent is that of the last iterate but one.
        member = newton(hopper, grid, Closure("tau", exp(log_tau)), u, _LAST_STEP)
        if member is None:
            return None
        u, slope = member.u, member.slope
        if abs(log_tau - before) > _FOLD_PROBE / 2:  # closer, their difference is rounding
            curvature = (slope - at_before) / (log_tau - before)
            before, at_before = log_tau, slope
        step = -slope / curvature if curvature < 0 else _FOLD_PROBE
        log_tau += float(np.clip(step, -0.5, 0.5))
        if abs(step) < _FOLD_TOLERANCE:
            return newton(hopper, grid, Closure("tau", exp(log_tau)), u, _LAST_STEP)
    return None
