"""The physical branch of one hopper at many wall frictions, solved together.

At these sizes most of the time of a Newton step is numpy's overhead, which a stack of members pays
once. A coarse walk along the family starts them; what is not resolved this way is left to
:func:`hopper.radial.members.physical_member`.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import Row, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.problem import Hopper
from hopper.radial.collocation import FAR, Closure, Member, moved
from hopper.radial.family import family_from, smooth_wall_member
from hopper.radial.friction_limit import fold_on
from hopper.radial.grid import Grid, half_grid, layer_clustering
from hopper.radial.pieces import turned
from hopper.radial.refinement import SIZES, TOLERANCE, grid_for, rounding_of_closure
from hopper.radial.steps import (
    closed_system,
    extrapolated,
    rounding_of_rows,
    rounding_of_unknowns,
    sizes_of,
)

# Half-grid points of the stacks.
_SIZES = SIZES[:5]
_FOLD_SIZE = 36
# Last coefficients of a fold on one grid that places it, and radians within which it does not
# decide on which side a wall is.
_FOLD_TAIL, _FOLD_MARGIN = 1e-7, 1e-6
# Parameters between two members of the walk at which psi_w is tabulated.
_TABLE = np.linspace(0, 1, 33)
# The last Newton step on the first grid, whose error is larger, and on others.
_CRUDE_STEP, _LAST_STEP = 1e-4, 1e-7
_NEWTON_STEPS, _LARGEST_STEP = 6, 0.5
_Rows = NDArray[np.intp]


@dataclass(frozen=True)
class Branch:
    """Members along the physical branch on coarse grids, by increasing tau.

    ``fold`` is psi_w (radians) at the fold before the last member; None without one, or where it is
    not resolved.
    """

    members: tuple[Member, ...]
    fold: float | None

    __repr__ = brief("fold deg")

    @property
    def reach(self) -> float:
        """The psi_w (radians) beyond which the fold excludes members; inf without a fold."""
        return inf if self.fold is None else self.fold + _FOLD_MARGIN


@checked
def branch_up_to(hopper: Hopper, psi_wall: float) -> Branch:
    """Walk along the physical branch up to a psi_w (radians), or to a member beyond its end.

    Raises
    ------
    NoRadialSolutionError
        If not even a smooth wall has a radial solution.
    """
    members: list[Member] = []
    for member in family_from(smooth_wall_member(hopper, _SIZES[0])):
        members.append(member)
        if len(members) > 1 and turned(member, rising=True):
            fold = _fold_between(*members[-2:])
            return Branch((*members[:-1], fold or member), fold.psi_wall if fold else None)
        # Beyond that, walls are too rough for the grids of the stacks.
        if member.psi_wall >= psi_wall or not member.grid.map.plain:
            break
    return Branch(tuple(members), None)


def _fold_between(low: Member, high: Member) -> Member | None:
    """Return the fold between two members on one grid, None if it is not resolved there."""
    data = _hermite_data(low, high)
    top = int((_hermite(_TABLE) @ data[:, -2]).argmax())
    start = _hermite(_TABLE[top : top + 1]) @ data
    grid = half_grid(_FOLD_SIZE, low.hopper.half_angle, low.grid.map.clustering)
    fold = fold_on(low.hopper, grid, replace(low, u=start[0]))
    known = fold is not None and fold.tail < _FOLD_TAIL and low.tau < fold.tau < high.tau
    return fold if known else None


@checked
def members_on(branch: Branch, psi_walls: Row, tolerance: float = TOLERANCE) -> list[Member | None]:
    """Return the members with given psi_w (radians), None for each that is not resolved here."""
    hopper = branch.members[0].hopper
    found: list[Member | None] = [None] * psi_walls.size
    starts: dict[float, list[tuple[_Rows, Array]]] = {}
    for rows, grid, u in _interpolated(branch, psi_walls):
        layers = np.array([layer_clustering(hopper, float(tau)) for tau in u[:, -1]])
        for layer in map(float, set(layers)):
            chosen, first = layers == layer, half_grid(_SIZES[0], hopper.half_angle, layer)
            starts.setdefault(layer, []).append((rows[chosen], moved(u[chosen], grid, first)))
    for layer, parts in starts.items():
        rows = np.concatenate([part[0] for part in parts])
        u = np.concatenate([part[1] for part in parts])
        for row, member in _resolved(hopper, layer, u, tolerance):
            # The family has one member for each tau: this one lies on the branch.
            if member.tau <= branch.members[-1].tau and member.rising:
                found[rows[row]] = member
    return found


def _interpolated(branch: Branch, psi_walls: Array) -> Iterator[tuple[_Rows, Grid, Array]]:
    """Yield, for each two members, the rows of psi_w between them, a grid and u on it."""
    for low, high in pairwise(branch.members):
        known = _hermite_data(low, high)
        table = _hermite(_TABLE) @ known[:, -2]
        top = int(table.argmax()) + 1
        rows = np.flatnonzero((psi_walls >= table[0]) & (psi_walls < table[top - 1]))
        if rows.size:
            at = np.interp(psi_walls[rows], table[:top], _TABLE[:top])
            start = _hermite(at) @ known
            start[:, -2] = psi_walls[rows]
            yield rows, low.grid, start


def _hermite_data(low: Member, high: Member) -> Array:
    """Return u of two members and its slopes along the arc of (psi_w, arsinh tau), shape (4, n)."""
    u = np.array([low.u, moved(high.u, high.grid, low.grid)])
    scale = np.hypot(1, u[:, -1])
    arc = np.hypot(u[1, -2] - u[0, -2], np.arcsinh(u[1, -1]) - np.arcsinh(u[0, -1]))
    slopes = np.array([low.tangent, moved(high.tangent, high.grid, low.grid)])
    slopes *= (arc / np.hypot(slopes[:, -2], slopes[:, -1] / scale))[:, None]
    return np.vstack([u, slopes])


def _hermite(t: Array) -> Array:
    """Return the weights of two values and two slopes at 0 and 1, shape (n, 4)."""
    s = 1 - t
    return np.stack([s * s * (1 + 2 * t), t * t * (1 + 2 * s), t * s * s, -t * t * s], axis=1)


def _resolved(
    hopper: Hopper, layer: float, u: Array, tolerance: float
) -> Iterator[tuple[int, Member]]:
    """Yield rows of u and their members, refined as :func:`hopper.radial.refinement.refine` does.

    Rows of members that are not resolved, or have better grids, are left out.
    """
    coarse, *finer = (half_grid(size, hopper.half_angle, layer) for size in _SIZES)
    far = hopper.material.singular_angle(hopper.delta) - FAR
    found = _newton(hopper, coarse, u, _CRUDE_STEP)
    rows, u = found.rows, found.u
    observed: dict[int, list[tuple[int, float]]] = {row: [] for row in rows.tolist()}
    for grid in finer:
        if not rows.size:
            return
        found = _newton(hopper, grid, moved(u, coarse, grid), _LAST_STEP)
        rows, going_on = rows[found.rows], np.ones(found.rows.size, dtype=bool)
        for i, row in enumerate(rows.tolist()):
            first, least = float(found.first[i]), float(found.least[i])
            observed[row].append((coarse.size, first))
            error = min(first, extrapolated(observed[row], grid)) + least
            if error < tolerance:
                going_on[i] = False
                closure = Closure("psi_wall", float(found.u[i, -2]))
                known = hopper, grid, closure, found.u[i], found.tangents[i]
                member = Member(*known, error + rounding_of_closure(Member(*known, error)))
                # Far from singular no other grid is better; it is most of the members.
                if member.psi.max() < far or grid_for(member, grid.size, layer) is grid:
                    yield row, member
        rows, u, coarse = rows[going_on], found.u[going_on], grid


@dataclass(frozen=True)
class _Found:
    """The ``rows`` of a stack that Newton's iteration solves, and of each the result.

    ``first`` is the size of the first step, ``least`` what rounding leaves.
    """

    rows: _Rows
    u: Array
    tangents: Array
    first: Array
    least: Array


def _newton(hopper: Hopper, grid: Grid, u: Array, last_step: float) -> _Found:
    """Solve on one grid as :func:`hopper.radial.collocation.newton`, from ``u``; psi_w is held."""
    u, psi_walls = u.copy(), u[:, -2].copy()
    tangents, first, least = np.empty(u.shape), np.zeros(len(u)), np.empty(len(u))
    active, solved_rows = np.arange(len(u)), np.zeros(len(u), dtype=bool)
    for iteration in range(_NEWTON_STEPS):
        residual, jacobian = closed_system(hopper, grid, "psi_wall", u[active])
        right = np.zeros((*residual.shape, 2))
        right[..., 0], right[:, -1, 1] = -residual, 1.0
        right = np.concatenate([right, rounding_of_rows(jacobian, u[active])], axis=-1)
        try:
            solved = np.linalg.solve(jacobian, right)
        except np.linalg.LinAlgError:
            break
        size = sizes_of(solved[..., 0], u[active])
        u[active] += solved[..., 0]
        u[active, -2] = psi_walls[active]
        if iteration == 0:
            first[active] = size
        done = size < last_step
        tangents[active[done]] = solved[done, :, 1]
        least[active[done]] = rounding_of_unknowns(solved[done, :, 2:], u[active[done]])
        solved_rows[active[done]] = True
        # Steps that are larger lead astray, and to overflow.
        active = active[~done & (size < _LARGEST_STEP)]
        if not active.size:
            break
    (rows,) = np.nonzero(solved_rows)
    return _Found(rows, u[rows], tangents[rows], first[rows], least[rows])
