"""The one-parameter family of radial solutions: continuation from the smooth wall.

Along the family, ordered by tau = 1 / sigma_0, the wall friction first grows from the smooth wall.
In most Mohr-Coulomb cones it passes a maximum, the fold, and then tends to the mass-flow limit of
sigma_0 -> 0. Elsewhere psi reaches its singular angle first, at the wall or inside the hopper, and
the family ends there.
"""

from collections.abc import Iterator
from dataclasses import replace
from math import degrees, radians

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.errors import ConvergenceError, NoRadialSolutionError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, crude_start, newton, predicted
from hopper.radial.grid import half_grid
from hopper.radial.refinement import SIZES, TOLERANCE, fitted, grid_for, refine

SIZE = 36
_FIRST_STEP = 0.15
# Arc of (psi_w, log tau), at most; more where the layer at the axis is thin, tau theta_w > 20, and
# the solution only moves with it.
_LARGEST_STEP, _LAYER_STEP, _LAYER = 0.2, 0.4, 20.0
_SMALLEST_STEP = 1e-6
_LONGEST_WALK = 400
# Of the slope d psi_w / d log(tau), the part that the last Newton step and the last Chebyshev
# coefficients of a member may have, and their largest and smallest.
_STEP_PART, _TAIL_PART = 0.03, 1e-3
_WALK_STEP, _LEAST_STEP = 1e-3, 1e-7
_WALK_TAIL, _LEAST_TAIL = 1e-6, 1e-13
# Last coefficients of a member that is none, and relative change of tau that may be error.
_UNRESOLVED, _SAME_TAU = 1e-4, 1e-6
# Radians below the singular angle where the walk ends: at the wall, inside.
WALL_MARGIN, INTERIOR_MARGIN = 2e-3, 2e-3
# tau theta_w beyond which layers at the axis are not resolved.
_THINNEST_LAYER = 3e5


@checked
def smooth_wall_member(hopper: Hopper, size: int = SIZE) -> Member:
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
        narrow = replace(hopper, half_angle=angle)
        grid = half_grid(size, angle)
        member = newton(narrow, grid, smooth, crude_start(narrow, grid, 0.0))
        angle /= 2
    step = 0.1
    while member is not None and member.hopper.half_angle < hopper.half_angle:
        angle = min(hopper.half_angle, member.hopper.half_angle + step)
        wider = replace(hopper, half_angle=angle)
        following = newton(wider, half_grid(size, angle), smooth, member.u)
        if following is None:
            step /= 2
            if step < 1e-3:
                break
        else:
            member = following
    singular = hopper.material.singular_angle(hopper.delta)
    too_wide = member is None or member.hopper.half_angle < hopper.half_angle
    if member is None or too_wide or member.psi.max() > singular:
        raise NoRadialSolutionError(
            f"no radial solution at half_angle = {degrees(hopper.half_angle):.6g} deg, "
            f"delta = {degrees(hopper.delta):.6g} deg, even for a smooth wall: lower half_angle",
            largest_friction_angle=None,
        )
    return member


@checked
def family(hopper: Hopper) -> Iterator[Member]:
    """Yield members in order of increasing tau, from the smooth wall to the end of the family.

    Raises
    ------
    NoRadialSolutionError
        As :func:`smooth_wall_member`.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.radial.family import family
    >>> taus = [member.tau for member in family(Hopper("wedge", delta=0.7, half_angle=0.2))]
    >>> taus == sorted(taus)
    True
    """
    return family_from(smooth_wall_member(hopper))


@checked
def family_from(member: Member) -> Iterator[Member]:
    """Yield members along the family from the given one, towards larger tau, to its end.

    The parameter is psi_w where psi_w changes fast, tau where tau does. Members are resolved as far
    as the sign of d psi_w / d tau needs it.
    """
    member, step = _resolved(fitted(member, _WALK_STEP)), _FIRST_STEP
    heading = np.array([0.0, 1.0])
    yield member
    for _ in range(_LONGEST_WALK):
        if _ended(member) or step < _SMALLEST_STEP:
            return
        # Oriented by the last step: near the end the sign of d tau alone is rounding.
        direction = np.array([member.tangent[-2], member.tangent[-1] / (1 + abs(member.tau))])
        scale = np.sign(direction @ heading) / np.hypot(*direction)
        following = _following(member, step, scale, direction)
        if following is None:
            step /= 2
            continue
        heading, member = direction * scale, following
        thin = member.tau * member.hopper.half_angle > _LAYER
        step = min(1.5 * step, _LAYER_STEP if thin else _LARGEST_STEP)
        yield member


def _following(member: Member, step: float, scale: float, direction: Array) -> Member | None:
    """Take a step along the tangent; None where it does not lead to the family.

    That is to a solution of a grid which is too coarse, or back.
    """
    guess = member.u + step * scale * member.tangent
    by_wall = abs(direction[0]) > abs(direction[1]) / 2
    closure = Closure("psi_wall", _below_singular(member, guess[-2]))
    closure = closure if by_wall else Closure("tau", guess[-1])
    # Close to the end of the family psi_w moves by much while tau moves by less than rounding.
    onward = member.tau - _SAME_TAU * abs(member.tau) * by_wall
    following = newton(member.hopper, member.grid, closure, guess, _last_step(member))
    if following is None or following.error > step:
        return None
    following = _resolved(fitted(following, _last_step(member)))
    found = following.tau > onward and following.gap.min() > 0 and following.tail < _UNRESOLVED
    return following if found else None


def _below_singular(member: Member, psi_wall: float) -> float:
    """Approach the singular angle at the wall by factors of 4 at most."""
    singular = member.hopper.material.singular_angle(member.hopper.delta)
    return min(psi_wall, singular - (singular - member.psi_wall) / 4)


def _last_step(member: Member) -> float:
    return float(np.clip(_STEP_PART * abs(member.slope), _LEAST_STEP, _WALK_STEP))


def _resolved(member: Member) -> Member:
    """Move a member to a grid fine enough for the sign of its slope."""
    for size in SIZES[:-1]:
        if member.tail < np.clip(_TAIL_PART * abs(member.slope), _LEAST_TAIL, _WALK_TAIL):
            break
        if size > member.grid.size:
            grid = grid_for(member, size, member.grid.map.clustering)
            finer = newton(member.hopper, grid, member.closure, member.on(grid), _last_step(member))
            member = finer or member
    return member


def _ended(member: Member) -> bool:
    hopper = member.hopper
    singular = hopper.material.singular_angle(hopper.delta)
    return (
        member.psi_wall > singular - WALL_MARGIN
        or member.psi[:-1].max() > max(singular - INTERIOR_MARGIN, member.psi_wall)
        or member.tau * hopper.half_angle > _THINNEST_LAYER
    )


@checked
def neighbour(member: Member, closure: Closure, tolerance: float = TOLERANCE) -> Member:
    """Return the resolved member with the given closure, close to ``member``; as :func:`refine`.

    Raises
    ------
    ConvergenceError
        If it is not resolved.
    """
    for size in _coarser(member.grid.size):
        grid = member.grid
        if size != grid.size:
            grid = grid_for(member, size, grid.map.clustering)
        for start in (predicted(member, closure), member):
            near = newton(member.hopper, grid, closure, start.on(grid))
            if near is None:
                continue
            try:
                return refine(near, tolerance)
            except ConvergenceError:
                # Too few points can have solutions of their own.
                continue
    return refine(replace(member, closure=closure, error=1.0), tolerance)


def _coarser(size: int) -> tuple[int, ...]:
    """Return the sizes to start from: a fine grid may be the one that confirmed a coarser one."""
    return (SIZES[SIZES.index(size) - 1], size) if size > SIZE and size in SIZES else (size,)
