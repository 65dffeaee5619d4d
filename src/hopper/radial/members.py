"""Members of the family for a given wall, or a given stress on the axis."""

from dataclasses import replace
from itertools import pairwise
from math import exp, inf, log, sqrt

import numpy as np

from hopper.arguments import Radians, checked
from hopper.errors import ConvergenceError, NoRadialSolutionError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton
from hopper.radial.family import family_from, neighbour, smooth_wall_member
from hopper.radial.friction_limit import friction_limit
from hopper.radial.pieces import Limit, Piece, first_piece, pieces
from hopper.radial.refinement import refine, solve
from hopper.values import require_angle
from hopper.yield_conditions import MOHR_COULOMB

# Least |d psi_w / d log(tau)| at which psi_w is solved for.
_FLAT = 1e-2
_ROOT_STEPS = 40
# Relative distance from the largest friction of a material that is none.
_ROUNDING = 4 * float(np.finfo(float).eps)
# Largest error, and tau theta_w, of a member that a crude start leads to: else its place on the
# family is looked up.
_ACCURATE, _THICK_LAYER = 1e-9, 20.0


@checked
def members_with_wall_angle(hopper: Hopper, psi_wall: float) -> list[Member]:
    """Return all members with the given psi_w (radians), resolved, in order of increasing tau.

    Raises
    ------
    NoRadialSolutionError
        As :func:`smooth_wall_member`.
    ConvergenceError
        If a member, or the end of the family, is not resolved.
    """
    return [_on_piece(piece, psi_wall) for piece in pieces(hopper) if piece.contains(psi_wall)]


@checked
def number_of_solutions(hopper: Hopper, friction_angle: float) -> int:
    """Return the number of radial solutions for a wall of that friction angle (radians).

    One on each piece of the family on which psi_w only rises or falls; at the fold itself one.

    Raises
    ------
    WallFrictionError
        If the material cannot transmit the wall's friction.
    NoRadialSolutionError
        As :func:`smooth_wall_member`.
    ConvergenceError
        If the end of the family is not resolved.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.radial.members import number_of_solutions
    >>> number_of_solutions(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.43)
    1
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    psi_wall = hopper.material.wall_angle(hopper.delta, friction_angle)
    return sum(piece.contains(psi_wall) for piece in pieces(hopper))


def _on_piece(piece: Piece, psi_wall: float) -> Member:
    """Return the member of a piece with that psi_w, resolved."""
    known = list(piece.members)
    first, last = (limit and limit.member for limit in (piece.start, piece.end))
    known = [first, *known] if first else known
    known = [*known, last] if last else known
    for low, high in pairwise(known):
        if (low.psi_wall - psi_wall) * (high.psi_wall - psi_wall) <= 0:
            if piece.start and low is first:
                return _between(low, high, psi_wall, piece.start)
            return _between(low, high, psi_wall, piece.end if high is last else None)
    if last and piece.contains(psi_wall):
        return _with_error(last, psi_wall, piece.end)
    # Beyond the last member: on towards the end of the family.
    low = known[-1]
    for high in family_from(low):
        if (low.psi_wall - psi_wall) * (high.psi_wall - psi_wall) <= 0:
            return _between(low, high, psi_wall, None)
        low = high
    return _near_end(low, piece.end.closest, psi_wall)


def _near_end(last: Member, closest: Member | None, psi_wall: float) -> Member:
    """Return the member with that psi_w between the last member of a walk and the end."""
    known = (last, closest) if closest else (last,)
    starts = sorted(known, key=lambda member: abs(member.psi_wall - psi_wall))
    try:
        return neighbour(starts[0], Closure("psi_wall", psi_wall))
    except ConvergenceError:
        return neighbour(starts[-1], Closure("psi_wall", psi_wall))


def _between(low: Member, high: Member, psi_wall: float, fold: Limit | None) -> Member:
    """Return the member with that psi_w between two members; ``fold`` is an extremum at one."""
    if low.psi_wall == psi_wall:
        return refine(low)
    positive = low.tau > 0  # where it is not, log(tau) is no parameter
    if not positive or min(abs(low.slope), abs(high.slope)) > _FLAT:
        closure = Closure("psi_wall", psi_wall)
        fraction = (psi_wall - low.psi_wall) / (high.psi_wall - low.psi_wall)
        guess = low.u + fraction * (high.on(low.grid) - low.u)
        member = newton(low.hopper, low.grid, closure, guess)
        if member is not None and low.tau <= member.tau <= high.tau:
            return refine(member)
    if not positive:
        return neighbour(high, Closure("psi_wall", psi_wall))
    return _by_tau(low, high, psi_wall, fold)


def _by_tau(low: Member, high: Member, psi_wall: float, fold: Limit | None) -> Member:
    """Solve for tau by Newton steps that stay in a bracket."""
    ends = [log(low.tau), log(high.tau)]
    rising = high.psi_wall > low.psi_wall
    if fold is None:
        fraction = (psi_wall - low.psi_wall) / (high.psi_wall - low.psi_wall)
        log_tau = ends[0] + fraction * (ends[1] - ends[0])
    else:
        distance = sqrt(2 * abs((fold.psi_wall - psi_wall) / fold.curvature))
        log_tau = log(fold.tau) + (distance if fold.member is low else -distance)
    member, before = low, inf
    for _ in range(_ROOT_STEPS):
        if not ends[0] <= log_tau <= ends[1]:
            log_tau = (ends[0] + ends[1]) / 2
        member = neighbour(member, Closure("tau", exp(log_tau)))
        excess = member.psi_wall - psi_wall
        # Where it no longer shrinks it is rounding.
        if excess == 0 or (abs(excess) < member.error and abs(excess) > before / 2):
            break
        before = abs(excess)
        ends[(excess > 0) is rising] = log_tau
        log_tau -= excess / member.slope
        if ends[1] - ends[0] < np.finfo(float).eps:
            break
    # Close to a fold the slightest error of psi_w counts.
    return _with_error(neighbour(member, member.closure, tolerance=0.0), psi_wall, fold)


def _with_error(member: Member, psi_wall: float, fold: Limit | None) -> Member:
    """Return a member found by tau with what the error of psi_w makes of it."""
    law, delta = member.hopper.material, member.hopper.delta
    error = (
        abs(member.psi_wall - psi_wall) + member.error + law.wall_angle_rounding(delta, psi_wall)
    )
    slope = abs(member.slope)
    if fold is None:
        shift = error / slope if slope else inf
    else:
        # Near an extremum errors go as the square root: psi_w is a parabola there.
        curvature = abs(fold.curvature)
        least = sqrt(max(0.0, slope**2 - 2 * error * curvature))
        shift = 2 * error / (slope + least) if least else sqrt(2 * error / curvature)
    return replace(member, error=member.error + shift * member.steepness)


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
    if tau < low.tau:
        raise _no_member(hopper, tau, f"at least {low.tau:.6g} (smooth wall)")
    for high in family_from(low):
        if low.tau <= tau <= high.tau:
            nearer = low if tau - low.tau < high.tau - tau else high
            return neighbour(nearer, Closure("tau", tau))
        low = high
    raise _no_member(hopper, tau, f"at most {low.tau:.6g}, where the family ends")


def _no_member(hopper: Hopper, tau: float, bound: str) -> NoRadialSolutionError:
    return NoRadialSolutionError(
        f"no radial solution with sigma_axis = {1 / tau if tau else np.inf:.6g}: "
        f"1 / sigma_axis must be {bound}",
        friction_limit(hopper).friction_angle,
    )


@checked
def physical_member(
    hopper: Hopper, friction_angle: Radians, start: Member | None = None, reached: float = 0.0
) -> Member | None:
    """Return the member of the physical branch, None beyond its end; tau may be negative.

    As :func:`solve_radial`, for sweeps that need no reason where there is no solution. ``start``
    is a member of this hopper or of one close to it, ``reached`` a tau that the branch surely
    reaches.

    Raises
    ------
    WallFrictionError
        If the material cannot transmit the wall's friction.
    ConvergenceError
        If the fields cannot be resolved.
    """
    psi_wall = hopper.material.wall_angle(hopper.delta, friction_angle)
    largest = hopper.material.largest_friction_angle(hopper.delta)
    if friction_angle >= largest * (1 - _ROUNDING):
        return None
    closure = Closure("psi_wall", psi_wall)
    member = solve(hopper, closure, start)
    if member is not None and member.rising and _certain(member, reached):
        return member
    try:
        piece = first_piece(hopper)
    except NoRadialSolutionError:
        return None
    return _on_piece(piece, psi_wall) if piece.contains(psi_wall) else None


def _certain(member: Member, reached: float) -> bool:
    """Whether a member is accurate, and of the physical branch if psi_w rises along the family.

    Cones can have a third piece, rising as well, on which the layer at the axis is thin.
    """
    hopper = member.hopper
    cone = hopper.geometry == "cone" and hopper.material == MOHR_COULOMB
    thick = member.tau < max(reached, _THICK_LAYER / hopper.half_angle)
    return member.error < _ACCURATE and (thick or not cone)
