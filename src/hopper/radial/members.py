"""Members of the family for a given wall, or a given stress on the axis."""

from collections.abc import Iterator
from itertools import pairwise
from math import degrees

import numpy as np
from scipy.optimize import brentq

from hopper.arguments import Radians, checked
from hopper.errors import ConvergenceError, NoRadialSolutionError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton, refine, solve
from hopper.radial.family import (
    family,
    family_from,
    locate_fold,
    neighbour,
    past_fold,
    smooth_wall_member,
)
from hopper.radial.friction_limit import friction_limit

# Radians within which a wall angle is that of the fold.
_SAME_ANGLE = 1e-12


@checked
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
        if past_fold(member) and (top := locate_fold(last, member)):
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


@checked
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


@checked
def physical_member(
    hopper: Hopper, friction_angle: Radians, start: Member | None = None
) -> Member | None:
    """Return the member of the physical branch, None beyond its end; tau may be negative.

    As :func:`solve_radial`, for sweeps that need no reason where there is no solution. ``start``
    is a member of this hopper or of one close to it.

    Raises
    ------
    WallFrictionError
        If the material cannot transmit the wall's friction.
    ConvergenceError
        If the fields cannot be resolved.
    """
    psi_wall = hopper.material.wall_angle(hopper.delta, friction_angle)
    closure = Closure("psi_wall", psi_wall)
    for guess in (start, None) if start else (None,):
        member = solve(hopper, closure, guess)
        if member is not None and member.psi_wall_by_tau > 0:
            return member
    if start and not (start.hopper == hopper and start.psi_wall_by_tau > 0):
        start = None
    if start and start.psi_wall >= psi_wall:
        start = None
    try:
        found = members_with_wall_angle(hopper, psi_wall, start)
    except NoRadialSolutionError:
        return None
    return found[0] if found else None
