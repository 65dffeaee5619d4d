"""The largest wall friction with a radial solution, and what ends the family there."""

from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from itertools import takewhile
from math import degrees, exp, log
from typing import Literal

import numpy as np

from hopper.arguments import checked
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton
from hopper.radial.critical_point import limiting_solution
from hopper.radial.family import (
    FREE_AXIS,
    INTERIOR_MARGIN,
    SIZE,
    WALL_MARGIN,
    family,
    family_from,
    locate_fold,
    neighbour,
    past_fold,
    smooth_wall_member,
)
from hopper.radial.grid import Grid, half_grid
from hopper.radial.mass_flow import limiting_wall_angle

End = Literal["fold", "wall", "interior", "axis"]
# Secant in log(tau) for the fold: first step, and the step at which it ends; rounding of the slope
# leaves 1e-8.
_FOLD_PROBE, _FOLD_TOLERANCE, _FOLD_STEPS = 1e-3, 1e-6, 20
_LAST_STEP = 1e-10
# Half angles, relative to the hopper's, from which its end is approached.
_NARROWINGS = (0.5, 0.35, 0.25, 0.15, 0.1, 0.05)


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
        If the fold is not resolved.
    """
    return friction_limit_from(smooth_wall_member(hopper))


@checked
def friction_limit_from(member: Member) -> FrictionLimit:
    """Return the same from any member of the physical branch; the closer to the limit, the faster.

    Raises
    ------
    ConvergenceError
        If the fold is not resolved.
    """
    hopper, last = member.hopper, member
    for following in family_from(member):
        if past_fold(following) and (top := locate_fold(last, following)):
            phi = hopper.material.friction_angle(hopper.delta, top.psi_wall)
            return FrictionLimit(phi, "fold", top.tau, top.psi_wall, top.error)
        last = following
    law = hopper.material
    if last.psi_wall > law.singular_angle(hopper.delta) - WALL_MARGIN:
        return _wall_end(last)
    reached = law.friction_angle(hopper.delta, last.psi_wall)
    if last.tau * hopper.half_angle > FREE_AXIS:
        # Other hoppers than cones with a mass-flow limit become singular all the same.
        with suppress(InvalidParameterError):
            wall = limiting_wall_angle(hopper)
            phi = law.friction_angle(hopper.delta, wall)
            return FrictionLimit(phi, "axis", last.tau, wall, abs(phi - reached))
    return _singular_end(last)


@checked
def fold_near(hopper: Hopper, start: Member) -> Member | None:
    """Return the resolved member at the fold, from a member close to it, None if that fails.

    ``start`` may be of a hopper close to this one.
    """
    near = _fold_on(hopper, half_grid(SIZE, hopper.half_angle, start.grid.clustering), start)
    if near is None:
        return None
    resolved = neighbour(near, Closure("tau", near.tau))
    # Where the stress on the axis is small the mesh moves the fold.
    fold = _fold_on(hopper, resolved.grid, resolved)
    return fold and neighbour(fold, Closure("tau", fold.tau))


def _fold_on(hopper: Hopper, grid: Grid, start: Member) -> Member | None:
    """Return the fold on one grid by the secant method in log(tau), None if that fails."""
    u, log_tau = start.on(grid), log(start.tau)
    before, at_before, curvature = log_tau + _FOLD_PROBE, np.nan, np.nan
    for _ in range(_FOLD_STEPS):
        # The tangent is that of the last iterate but one.
        member = newton(hopper, grid, Closure("tau", exp(log_tau)), u, _LAST_STEP)
        if member is None:
            return None
        u, slope = member.u, member.psi_wall_by_tau * member.tau
        if abs(log_tau - before) > _FOLD_PROBE / 2:  # closer, their difference is rounding
            curvature = (slope - at_before) / (log_tau - before)
            before, at_before = log_tau, slope
        step = -slope / curvature if curvature < 0 else _FOLD_PROBE
        log_tau += float(np.clip(step, -0.5, 0.5))
        if abs(step) < _FOLD_TOLERANCE:
            return newton(hopper, grid, Closure("tau", exp(log_tau)), u, _LAST_STEP)
    return None


def _singular_end(member: Member) -> FrictionLimit:
    """Return the limit where psi becomes singular inside the hopper, or at the wall after all."""
    hopper, law = member.hopper, member.hopper.material
    singular = law.singular_angle(hopper.delta)
    for narrowing in _NARROWINGS:
        # Narrow enough, psi becomes singular at the wall: from there to the critical point.
        half_angle = narrowing * hopper.half_angle
        narrow = Hopper(hopper.geometry, hopper.delta, half_angle, law)
        *_, start = takewhile(lambda near: near.psi_wall < singular, family(narrow))
        if start.psi_wall < singular - 2 * INTERIOR_MARGIN:
            continue
        try:
            end = limiting_solution(hopper, start)
        except ConvergenceError:
            continue
        if end is None:
            return _wall_end(member)
        phi = law.friction_angle(hopper.delta, end.psi_wall)
        lower = law.friction_angle(hopper.delta, end.psi_wall - end.error_estimate)
        return FrictionLimit(phi, "interior", end.tau, end.psi_wall, phi - lower)
    raise ConvergenceError(
        f"largest wall friction not resolved at delta = {degrees(hopper.delta):.6g} deg, "
        f"half_angle = {degrees(hopper.half_angle):.6g} deg: psi becomes singular near the axis; "
        "lower half_angle"
    )


def _wall_end(member: Member) -> FrictionLimit:
    law, delta = member.hopper.material, member.hopper.delta
    phi = law.largest_friction_angle(delta)
    return FrictionLimit(phi, "wall", member.tau, law.singular_angle(delta), error_estimate=0.0)
