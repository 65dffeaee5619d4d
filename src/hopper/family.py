"""The one-parameter family of radial solutions: continuation, fold, all solutions for a wall.

Along the family, ordered by tau = 1 / sigma_0, the wall friction first grows from the smooth wall.
In most Mohr-Coulomb cones it passes a maximum, the fold, and then tends to the mass-flow limit of
sigma_0 -> 0. Elsewhere psi reaches its singular angle first, at the wall or inside the hopper, and
the family ends there.
"""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise, takewhile
from math import degrees, exp, log, radians
from typing import Literal

import numpy as np
from scipy.optimize import brentq

from hopper.critical_point import limiting_solution
from hopper.errors import ConvergenceError, InvalidParameterError, NoRadialSolutionError
from hopper.mass_flow import limiting_wall_angle
from hopper.problem import Hopper
from hopper.radial_collocation import (
    Closure,
    Member,
    crude_start,
    half_grid,
    newton,
    refine,
)

End = Literal["fold", "wall", "interior", "axis"]

_SIZE = 36
_FIRST_STEP = 0.05
_LARGEST_STEP = 0.2
_SMALLEST_STEP = 1e-3
_LONGEST_WALK = 300
# Members of a walk only start what is resolved later: an error of 1e-6 is as good as rounding.
_WALK_STEP = 1e-3
# log(tau) to which the fold is found before its members are resolved.
_FOLD_STEP = 1e-4
# Radians within which a wall angle is that of the fold.
_SAME_ANGLE = 1e-12
# Radians below the singular angle where the family counts as ended: at the wall, inside.
_WALL_MARGIN, _INTERIOR_MARGIN = 2e-3, 2e-2
# Half angles, relative to the hopper's, from which its end is approached.
_NARROWINGS = (0.5, 0.35, 0.25, 0.15, 0.1, 0.05)
# tau theta_w beyond which the axis counts as free of stress.
_FREE_AXIS = 300.0


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


def smooth_wall_member(hopper: Hopper) -> Member:
    """Return the member with psi_w = 0, on a coarse grid; its tau is negative for small delta.

    Raises
    ------
    NoRadialSolutionError
        If the hopper is so wide that even a smooth wall has no radial solution.
    """
    smooth = Closure("psi_wall", 0.0)
    member, angle = None, hopper.half_angle
    narrowest = min(angle, radians(1))
    while member is None and angle >= narrowest:
        narrow = Hopper(hopper.geometry, hopper.delta, angle, hopper.material)
        grid = half_grid(_SIZE, angle)
        member = newton(narrow, grid, smooth, crude_start(narrow, grid, 0.0))
        angle /= 2
    step = 0.1
    while member is not None and member.hopper.half_angle < hopper.half_angle:
        angle = min(hopper.half_angle, member.hopper.half_angle + step)
        wider = Hopper(hopper.geometry, hopper.delta, angle, hopper.material)
        following = newton(wider, half_grid(_SIZE, angle), smooth, member.u)
        if following is None:
            step /= 2
            if step < 1e-3:
                break
        else:
            member = following
    if member is None or member.hopper.half_angle < hopper.half_angle:
        raise NoRadialSolutionError(
            f"no radial solution at half_angle = {degrees(hopper.half_angle):.6g} deg, "
            f"delta = {degrees(hopper.delta):.6g} deg, even for a smooth wall: lower half_angle",
            largest_friction_angle=None,
        )
    return member


def family(hopper: Hopper) -> Iterator[Member]:
    """Yield members in order of increasing tau, from the smooth wall to the end of the family.

    Raises
    ------
    NoRadialSolutionError
        As :func:`smooth_wall_member`.
    """
    return family_from(smooth_wall_member(hopper))


def family_from(member: Member) -> Iterator[Member]:
    """Yield members along the family from the given one, towards larger tau, to its end.

    The parameter is psi_w where psi_w changes fast, tau where tau does.
    """
    member, step = _regrid(member), _FIRST_STEP
    heading = np.array([0.0, 1.0])
    yield member
    for _ in range(_LONGEST_WALK):
        if _ended(member) or step < _SMALLEST_STEP:
            return
        # Oriented by the last step: near the end the sign of d tau alone is rounding.
        direction = np.array([member.tangent[-2], member.tangent[-1] / (1 + abs(member.tau))])
        scale = np.sign(direction @ heading) / np.hypot(*direction)
        direction *= scale
        guess = member.u + step * scale * member.tangent
        by_wall = abs(direction[0]) > abs(direction[1]) / 2
        closure = Closure("psi_wall", guess[-2]) if by_wall else Closure("tau", guess[-1])
        following = newton(member.hopper, member.grid, closure, guess, _WALK_STEP)
        if following is None or following.error > step or following.tau <= member.tau:
            step /= 2
            continue
        heading = direction
        member, step = _regrid(following), min(1.5 * step, _LARGEST_STEP)
        yield member


def _ended(member: Member) -> bool:
    hopper = member.hopper
    singular = hopper.material.singular_angle(hopper.delta)
    return (
        member.psi_wall > singular - _WALL_MARGIN
        or member.psi[:-1].max() > max(singular - _INTERIOR_MARGIN, member.psi_wall)
        or member.tau * hopper.half_angle > _FREE_AXIS
    )


def _regrid(member: Member) -> Member:
    """Move a member to the grid that resolves its apex layer, of width 1 / tau."""
    half_angle = member.hopper.half_angle
    layer = 1.15 * float(np.arcsinh(member.tau * half_angle / 4))
    grid = half_grid(_SIZE, half_angle, 0.5 * round(2 * max(0.0, layer)))
    if grid is member.grid:
        return member
    return newton(member.hopper, grid, member.closure, member.on(grid), _WALK_STEP) or member


def _past_fold(member: Member) -> bool:
    # Where psi_w is the parameter the sign of this slope is that of rounding near the end.
    return member.closure.unknown == "tau" and member.psi_wall_by_tau <= 0


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


def friction_limit_from(member: Member) -> FrictionLimit:
    """Return the same from any member of the physical branch; the closer to the limit, the faster.

    Raises
    ------
    ConvergenceError
        If the fold is not resolved.
    """
    hopper, last = member.hopper, member
    for following in family_from(member):
        if _past_fold(following) and (top := _fold(last, following)):
            phi = hopper.material.friction_angle(hopper.delta, top.psi_wall)
            return FrictionLimit(phi, "fold", top.tau, top.psi_wall, top.error)
        last = following
    law = hopper.material
    if last.psi_wall > law.singular_angle(hopper.delta) - _WALL_MARGIN:
        return _wall_end(last)
    reached = law.friction_angle(hopper.delta, last.psi_wall)
    if last.tau * hopper.half_angle > _FREE_AXIS:
        # Other hoppers than cones with a mass-flow limit become singular all the same.
        with suppress(InvalidParameterError):
            wall = limiting_wall_angle(hopper)
            phi = law.friction_angle(hopper.delta, wall)
            return FrictionLimit(phi, "axis", last.tau, wall, abs(phi - reached))
    return _singular_end(last)


def _singular_end(member: Member) -> FrictionLimit:
    """Return the limit where psi becomes singular inside the hopper, or at the wall after all."""
    hopper, law = member.hopper, member.hopper.material
    singular = law.singular_angle(hopper.delta)
    for narrowing in _NARROWINGS:
        # Narrow enough, psi becomes singular at the wall: from there to the critical point.
        half_angle = narrowing * hopper.half_angle
        narrow = Hopper(hopper.geometry, hopper.delta, half_angle, law)
        *_, start = takewhile(lambda near: near.psi_wall < singular, family(narrow))
        if start.psi_wall < singular - 2 * _INTERIOR_MARGIN:
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


def neighbour(member: Member, closure: Closure) -> Member:
    """Return the resolved member with the given closure, close to ``member``.

    Raises
    ------
    ConvergenceError
        If it is not resolved.
    """
    near = newton(member.hopper, member.grid, closure, member.u)
    return refine(near or Member(member.hopper, member.grid, closure, member.u, member.tangent, 1))


def _fold(below: Member, above: Member) -> Member | None:
    """Locate d psi_w / d tau = 0 between two members; None if the slope's sign was noise."""
    start = above if above.grid.clustering == below.grid.clustering else below

    def at(log_tau: float) -> Closure:
        return Closure("tau", exp(log_tau))

    def coarse_slope(log_tau: float) -> float:
        member = newton(start.hopper, start.grid, at(log_tau), start.u, _FOLD_STEP)
        return (member or neighbour(start, at(log_tau))).psi_wall_by_tau

    ends = log(below.tau), log(above.tau)
    if not coarse_slope(ends[0]) > 0 > coarse_slope(ends[1]):
        return None
    root = brentq(coarse_slope, *ends, xtol=_FOLD_STEP)
    # One secant step on resolved members: psi_w is stationary, so its error is of fourth order.
    before, after = root - _FOLD_STEP, root + _FOLD_STEP
    left, right = (neighbour(start, at(side)).psi_wall_by_tau for side in (before, after))
    return neighbour(start, at(before + (after - before) * left / (left - right)))


def members_with_wall_angle(
    hopper: Hopper, psi_wall: float, start: Member | None = None
) -> list[Member]:
    """Return all resolved members with the given psi_w (radians), in order of increasing tau.

    With ``start``, a member of the same hopper, only those of larger tau.

    Raises
    ------
    NoRadialSolutionError
        As :func:`smooth_wall_member`.
    ConvergenceError
        If a member is not resolved.
    """
    found: list[Member] = []
    members = family_from(start) if start else family(hopper)
    for low, high in pairwise(_with_fold(members)):
        if abs(high.psi_wall - psi_wall) < _SAME_ANGLE and high.psi_wall_by_tau < _SAME_ANGLE:
            return [*found, high]
        if (low.psi_wall - psi_wall) * (high.psi_wall - psi_wall) <= 0 != high.psi_wall - psi_wall:
            found += [_at_wall_angle(low, high, psi_wall)]
    return found


def _with_fold(members: Iterator[Member]) -> Iterator[Member]:
    """Insert the member at the fold when the walk passes it."""
    last = next(members)
    yield last
    for member in members:
        if _past_fold(member) and (top := _fold(last, member)):
            yield top
            yield member
            break
        yield member
        last = member
    yield from members


def _at_wall_angle(low: Member, high: Member, psi_wall: float) -> Member:
    if low.psi_wall == psi_wall:
        return refine(low)
    closure = Closure("psi_wall", psi_wall)
    fraction = (psi_wall - low.psi_wall) / (high.psi_wall - low.psi_wall)
    guess = low.u + fraction * (high.on(low.grid) - low.u)
    member = newton(low.hopper, low.grid, closure, guess)
    if member is not None and low.tau <= member.tau <= high.tau:
        return refine(member)

    # Near the fold Newton in psi_w can slip to the other branch; tau cannot.
    def excess(tau: float) -> float:
        return neighbour(low, Closure("tau", tau)).psi_wall - psi_wall

    if not excess(low.tau) * excess(high.tau) <= 0:
        raise ConvergenceError(
            f"radial solution not resolved at psi_w = {degrees(psi_wall):.6g} deg: psi is too "
            "close to its singular value; lower the wall friction"
        )
    tau = brentq(excess, low.tau, high.tau, xtol=1e-13, rtol=1e-14)
    return neighbour(low, Closure("tau", tau))


def member_with_tau(hopper: Hopper, tau: float) -> Member:
    """Return the resolved member with the given tau = 1 / sigma_0.

    Raises
    ------
    NoRadialSolutionError
        If tau lies outside the part of the family between the smooth wall and its end.
    ConvergenceError
        If the member is not resolved.
    """
    low = smooth_wall_member(hopper)
    least = low.tau
    for high in family(hopper):
        if low.tau <= tau <= high.tau:
            nearer = low if tau - low.tau < high.tau - tau else high
            return neighbour(nearer, Closure("tau", tau))
        low = high
    raise NoRadialSolutionError(
        f"no radial solution with sigma_axis = {1 / tau if tau else np.inf:.6g}: "
        f"1 / sigma_axis must lie between {least:.6g} (smooth wall) and {low.tau:.6g}",
        friction_limit(hopper).friction_angle,
    )
