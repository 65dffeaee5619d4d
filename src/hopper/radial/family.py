"""The one-parameter family of radial solutions: continuation, fold, all solutions for a wall.

Along the family, ordered by tau = 1 / sigma_0, the wall friction first grows from the smooth wall.
In most Mohr-Coulomb cones it passes a maximum, the fold, and then tends to the mass-flow limit of
sigma_0 -> 0. Elsewhere psi reaches its singular angle first, at the wall or inside the hopper, and
the family ends there.
"""

from collections.abc import Iterator
from math import degrees, exp, log, radians

import numpy as np
from scipy.optimize import brentq

from hopper.arguments import checked
from hopper.errors import NoRadialSolutionError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, crude_start, fitted, newton, refine
from hopper.radial.grid import half_grid

SIZE = 36
_FIRST_STEP = 0.05
_LARGEST_STEP = 0.2
_SMALLEST_STEP = 1e-3
_LONGEST_WALK = 300
# Members of a walk only start what is resolved later: an error of 1e-6 is as good as rounding.
_WALK_STEP = 1e-3
# log(tau) to which the fold is found before its members are resolved.
_FOLD_STEP = 1e-4
# Radians below the singular angle where the family counts as ended: at the wall, inside.
WALL_MARGIN, INTERIOR_MARGIN = 2e-3, 2e-2
# tau theta_w beyond which the axis counts as free of stress.
FREE_AXIS = 300.0


@checked
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
        grid = half_grid(SIZE, angle)
        member = newton(narrow, grid, smooth, crude_start(narrow, grid, 0.0))
        angle /= 2
    step = 0.1
    while member is not None and member.hopper.half_angle < hopper.half_angle:
        angle = min(hopper.half_angle, member.hopper.half_angle + step)
        wider = Hopper(hopper.geometry, hopper.delta, angle, hopper.material)
        following = newton(wider, half_grid(SIZE, angle), smooth, member.u)
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


@checked
def family(hopper: Hopper) -> Iterator[Member]:
    """Yield members in order of increasing tau, from the smooth wall to the end of the family.

    Raises
    ------
    NoRadialSolutionError
        As :func:`smooth_wall_member`.
    """
    return family_from(smooth_wall_member(hopper))


@checked
def family_from(member: Member) -> Iterator[Member]:
    """Yield members along the family from the given one, towards larger tau, to its end.

    The parameter is psi_w where psi_w changes fast, tau where tau does.
    """
    member, step = fitted(member, _WALK_STEP), _FIRST_STEP
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
        member, step = fitted(following, _WALK_STEP), min(1.5 * step, _LARGEST_STEP)
        yield member


def _ended(member: Member) -> bool:
    hopper = member.hopper
    singular = hopper.material.singular_angle(hopper.delta)
    return (
        member.psi_wall > singular - WALL_MARGIN
        or member.psi[:-1].max() > max(singular - INTERIOR_MARGIN, member.psi_wall)
        or member.tau * hopper.half_angle > FREE_AXIS
    )


@checked
def past_fold(member: Member) -> bool:
    """Whether the wall friction decreases along the family at a member."""
    # Where psi_w is the parameter the sign of this slope is that of rounding near the end.
    return member.closure.unknown == "tau" and member.psi_wall_by_tau <= 0


@checked
def neighbour(member: Member, closure: Closure) -> Member:
    """Return the resolved member with the given closure, close to ``member``.

    Raises
    ------
    ConvergenceError
        If it is not resolved.
    """
    near = newton(member.hopper, member.grid, closure, member.u)
    return refine(near or Member(member.hopper, member.grid, closure, member.u, member.tangent, 1))


@checked
def locate_fold(below: Member, above: Member) -> Member | None:
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
