"""The family in pieces along which the wall friction only rises or only falls with tau.

A piece ends at an extremum of psi_w (the first is the fold of the physical branch) or where the
family ends. A wall has one radial solution on every piece that reaches its friction. Near an
extremum psi_w determines a solution badly and tau does well: there tau is what to solve for.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import islice
from math import degrees, exp, log
from typing import Literal

from hopper.arguments import checked
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton, predicted
from hopper.radial.critical_point import cut, limiting_solution
from hopper.radial.family import WALL_MARGIN, family, family_from, neighbour, smooth_wall_member
from hopper.radial.grid import mapped_grid
from hopper.radial.mass_flow import limiting_wall_angle
from hopper.radial.refinement import fitted
from hopper.roots import root_between
from hopper.yield_conditions import MOHR_COULOMB

End = Literal["fold", "wall", "interior", "axis"]
# log(tau) to which an extremum is bracketed on coarse grids, and half widths of the bracket of
# resolved slopes from which it is interpolated.
_COARSE_ROOT, _BRACKETS = 1e-4, (1e-4, 1e-3, 1e-2)
_LAST_STEP = 1e-9
# Radians below the singular angle at which the end of the family is looked for on falling pieces.
_EARLY = 2e-2
# psi_w (radians) that counts as the mass-flow limit, its decay rates' relative distance from their
# limit and change per step in log(tau) at which nothing more happens, and the least tau theta_w.
_AT_LIMIT, _AT_RATE, _STEADY, _THIN_LAYER = 1e-11, 0.1, 0.1, 10.0
# Radians below the singular angle where a wall end is confirmed.
_CONFIRMED = 1e-5
# Factors by which a hopper is widened.
_WIDENING, _LEAST_WIDENING = 1.1, 1.001


@dataclass(frozen=True)
class Limit:
    """Where a piece ends: psi at the wall (radians) with its error, and tau, there.

    Of an extremum, called a fold, ``member`` is the resolved member, ``curvature`` the second
    derivative of psi_w by log(tau). Of a wall ``closest`` is a resolved member next to it.
    """

    end: End
    psi_wall: float
    tau: float
    error: float
    member: Member | None = None
    curvature: float = 0.0
    closest: Member | None = None

    __repr__ = brief("end", "psi_wall deg", "tau", "error deg")


@dataclass(frozen=True)
class Piece:
    """Members in order of tau, all on one side of the extrema of psi_w, and the limits.

    ``start`` is None for the piece that begins with the smooth wall.
    """

    rising: bool
    members: tuple[Member, ...]
    start: Limit | None
    end: Limit

    __repr__ = brief("rising", "end.end", "end.psi_wall deg")

    @checked
    def contains(self, psi_wall: float) -> bool:
        """Whether a member has this psi_w; an extremum belongs to the piece before it."""
        first = self.members[0].psi_wall if self.start is None else self.start.psi_wall
        sign = 1 if self.rising else -1
        reached = sign * (self.end.psi_wall - psi_wall)
        if self.start is None:
            begun = sign * (psi_wall - first) >= 0
        else:
            begun = sign * (psi_wall - first) > self.start.error
        return begun and (reached >= -self.end.error if self.end.member else reached > 0)


@checked
@lru_cache(maxsize=128)
def first_piece(hopper: Hopper) -> Piece:
    """Return the piece that begins with the smooth wall: the physical branch.

    Raises
    ------
    NoRadialSolutionError
        If not even a smooth wall has a radial solution.
    ConvergenceError
        If its end is not resolved.
    """
    return next(pieces_from(smooth_wall_member(hopper)))


@checked
def physical_branch(hopper: Hopper) -> Iterator[Member]:
    """Yield members of the physical branch in order of tau, a fold last; as :func:`first_piece`.

    Where its end is not resolved, members up to there.
    """
    try:
        piece = first_piece(hopper)
    except ConvergenceError:
        yield from family(hopper)
        return
    yield from piece.members
    if piece.end.member:
        yield piece.end.member
    elif piece.end.end == "axis":  # a piece ends when nothing more happens, the family later
        yield from islice(family_from(piece.members[-1]), 1, None)


@checked
@lru_cache(maxsize=128)
def pieces(hopper: Hopper) -> tuple[Piece, ...]:
    """Return all pieces of the family, as :func:`first_piece`."""
    first = first_piece(hopper)
    if first.end.member is None:
        return (first,)
    return (first, *pieces_from(first.end.member, first.end))


@checked
def pieces_from(member: Member, start: Limit | None = None) -> Iterator[Piece]:
    """Yield the pieces of the family from a member on; ``start`` is the extremum it is at.

    Raises
    ------
    ConvergenceError
        If the end of one is not resolved.
    """
    rising = start is None or start.curvature > 0
    members: list[Member] = []
    looked_for = _EARLY
    for following in family_from(member):
        members.append(following)
        if len(members) < 2:
            continue
        if turned(following, rising) and (turn := _extremum(members[-2], following, rising)):
            yield Piece(rising, tuple(members[:-1]), start, turn)
            rising, start, members = not rising, turn, [following]
        elif has_mass_flow_limit(member.hopper):
            if _steady(members):
                break
        elif not rising and float(following.gap.min()) < looked_for:
            # A falling piece ends inside the hopper: no need to walk there.
            looked_for = float(following.gap.min()) / 3
            limit = _interior_end(following)
            if limit and limit.psi_wall < following.psi_wall:
                yield Piece(rising, tuple(members), start, limit)
                return
    yield Piece(rising, tuple(members), start, _end(members))


@checked
def turned(member: Member, rising: bool) -> bool:
    """Whether psi_w falls along the family at a member where it rose, or the reverse."""
    # Where psi_w is the parameter it moves as it should; the sign of the slope may be rounding.
    return member.closure.unknown == "tau" and (member.psi_wall_by_tau > 0) is not rising


def _extremum(below: Member, above: Member, rising: bool) -> Limit | None:
    """Locate d psi_w / d log(tau) = 0 between two members; None if the slope's sign was noise."""
    start = above if above.grid.map == below.grid.map else below

    def slope(log_tau: float) -> float:
        return neighbour(start, Closure("tau", exp(log_tau))).slope

    @cache
    def coarse(log_tau: float) -> float:
        closure = Closure("tau", exp(log_tau))
        guess = predicted(start, closure).u
        member = newton(start.hopper, start.grid, closure, guess, _LAST_STEP)
        return member.slope if member else slope(log_tau)

    ends, sign = (log(below.tau), log(above.tau)), 1 if rising else -1
    if not sign * coarse(ends[0]) > 0 > sign * coarse(ends[1]):
        return None
    root = root_between(coarse, *ends, xtol=_COARSE_ROOT)
    for half in _BRACKETS:
        # One secant step on resolved members: psi_w is stationary, so its error is of higher order.
        left, right = slope(root - half), slope(root + half)
        if sign * left > 0 > sign * right:
            shift = half * (left + right) / (left - right)
            top = neighbour(start, Closure("tau", exp(root + shift)), tolerance=0.0)
            curvature = (right - left) / (2 * half)
            error = top.error + top.slope**2 / abs(curvature)
            return Limit("fold", top.psi_wall, top.tau, error, top, curvature)
    return None


@checked
def has_mass_flow_limit(hopper: Hopper) -> bool:
    """Whether the family goes on to sigma_0 = 0: the limit's psi is below the singular angle."""
    return hopper.geometry == "cone" and hopper.material == MOHR_COULOMB and hopper.s > 0.5 - 1e-12


def _steady(members: list[Member]) -> bool:
    """Whether psi_w approaches the mass-flow limit in a power of tau that no longer changes.

    Linearised about the limit, disturbances of the layer at the axis decay as tau^-3 and
    tau^-(3s-1)/(2s-1). A rate between the two that decreases, or stays at the slower one, is one
    of a sum that will not change its sign.
    """
    before, last = members[-2:]
    limit, s = limiting_wall_angle(last.hopper), last.hopper.s
    if last.tau * last.hopper.half_angle < _THIN_LAYER:
        return False
    distance, earlier = last.psi_wall - limit, before.psi_wall - limit
    if max(abs(distance), abs(last.slope)) < _AT_LIMIT:
        return True
    rates = 3.0, (3 * s - 1) / max(2 * s - 1, 1e-12)
    if not earlier:  # a smooth wall at the half angle up to which there is mass flow
        return False
    rate, old = -last.slope / distance, -before.slope / earlier
    steady = abs(rate - old) < _STEADY * log(last.tau / before.tau)
    at_rate = steady and abs(rate / min(rates) - 1) < _AT_RATE
    return 0 < rate < max(rates) and (at_rate or rate < old)


def _end(members: list[Member]) -> Limit:
    """Return the limit after the last member of a walk."""
    last, hopper = members[-1], members[-1].hopper
    if last.gap[-1] < 2 * WALL_MARGIN and (limit := _wall_end(last)):
        return limit
    if has_mass_flow_limit(hopper) and last.tau * hopper.half_angle > _THIN_LAYER:
        psi_wall = limiting_wall_angle(hopper)
        error = _AT_LIMIT if _steady(members) else abs(last.psi_wall - psi_wall)
        return Limit("axis", psi_wall, last.tau, error)
    # The last member, closest to the end, may not be resolved.
    for member in members[:-4:-1]:
        if limit := _interior_end(member) or _wall_end(_widened(member)):
            return limit
    raise ConvergenceError(
        f"largest wall friction not resolved at delta = {degrees(hopper.delta):.6g} deg, "
        f"half_angle = {degrees(hopper.half_angle):.6g} deg: psi becomes singular near "
        f"theta = {degrees(last.kink[0] * hopper.half_angle):.6g} deg; lower half_angle"
    )


def _wall_end(last: Member | None) -> Limit | None:
    """Return the limit of a wall as rough as the material, None if psi_w does not get there."""
    if last is None:
        return None
    singular = last.psi_wall + float(last.gap[-1])
    try:
        closest = neighbour(last, Closure("psi_wall", singular - _CONFIRMED))
    except ConvergenceError:
        return None
    if not (closest.gap.min() > 0 and closest.excess < 1):
        return None
    return Limit("wall", singular, closest.tau, 0.0, closest=closest)


def _widened(last: Member) -> Member | None:
    """Return a member with psi close to singular at the wall only, None if there is none.

    Narrower hoppers have one where psi of ``last`` is closest to singular.
    """
    hopper, wall = last.hopper, last.hopper.half_angle
    angle, factor = last.kink[0] * wall, _WIDENING
    member = cut(last, angle)
    closure = Closure("psi_wall", last.psi.max() + last.gap.min() - _CONFIRMED)
    while factor > _LEAST_WIDENING:
        wider = replace(hopper, half_angle=angle)
        grid = mapped_grid(member.grid.size, angle, member.grid.map)
        following = newton(wider, grid, closure, member.on(grid))
        following = following and fitted(following)
        if following is None or following.gap.min() <= 0 or following.excess > 1:
            factor = factor**0.5
        elif angle == wall:
            return following
        else:
            member = following
        angle = min(member.hopper.half_angle * factor, wall)
    return None


def _interior_end(last: Member) -> Limit | None:
    """Return the limit where psi becomes singular inside the hopper."""
    try:
        found = limiting_solution(last)
    except ConvergenceError:
        return None
    if found is None:
        return None
    return Limit("interior", found.psi_wall, found.tau, found.error_estimate)
