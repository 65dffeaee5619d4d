"""Members of the family solved on finer and finer grids, with a bound on their errors.

The error of a grid is seen on the next; what rounding makes of the solution is seen by perturbing
the equations. Grids follow the solution: to the layer at the axis, to the square root in which psi
nears its singular angle at the wall, or to a kink inside.
"""

from dataclasses import replace

from hopper.arguments import checked
from hopper.errors import ConvergenceError, not_resolved_because
from hopper.problem import Hopper
from hopper.radial.collocation import (
    FAR,
    Closure,
    Member,
    crude_start,
    newton,
    newton_with_rounding,
    predicted,
)
from hopper.radial.grid import Grid, Map, half_grid, layer_clustering, mapped_grid, wall_bend
from hopper.radial.steps import extrapolated

# Half-grid sizes; a solution on one is confirmed on the next.
SIZES = (12, 16, 24, 36, 54, 80, 120, 180, 270)
# Last Newton step of a resolved member: its tangent is that of the iterate before.
_SHARP_STEP = 1e-10
TOLERANCE = 1e-12
_ACCEPTABLE = 1e-6
# Distance over theta_w, from the wall or in width, from which on where psi is close to singular has
# a grid of its own: farther away plain ones resolve it.
_BENT = 0.05


@checked
def refine(member: Member, tolerance: float = TOLERANCE) -> Member:
    """Solve on finer grids until the error is below the tolerance, or of rounding size.

    The first Newton step on a finer grid is the error of the coarser one. That of the finer one
    follows from geometric convergence, if both are of one kind.

    Raises
    ------
    ConvergenceError
        If the error on the finest grid exceeds 1e-6.
    """
    observed: list[tuple[int, float]] = []
    for size in SIZES:
        if size <= member.grid.size:
            continue
        grid = grid_for(member, size, member.grid.map.clustering)
        start = member.on(grid)
        found = newton_with_rounding(member.hopper, grid, member.closure, start, _SHARP_STEP)
        if found is None:
            break
        finer, least = found
        error, least = finer.error, least + rounding_of_closure(finer)
        alike = grid.map.plain == member.grid.map.plain
        if not alike:
            observed.clear()
        stagnant = bool(observed) and observed[-1][1] / 2 < error < 1e-9
        observed.append((member.grid.size, error))
        if alike and not stagnant:
            error = min(error, extrapolated(observed, finer.grid))
        member = replace(finer, error=error + least)
        if error < max(tolerance, least) or stagnant:
            return member
    if member.error < _ACCEPTABLE:
        return member
    raise ConvergenceError(
        f"radial solution not resolved: {member.grid.size} half-grid points leave an error of "
        f"{member.error:.1e}; {not_resolved_because(member.psi_wall)}"
    )


@checked
def rounding_of_closure(member: Member) -> float:
    """Return what rounding of psi_w makes of u, where it is given."""
    if member.closure.unknown == "tau":
        return 0.0
    hopper = member.hopper
    of_wall = hopper.material.wall_angle_rounding(hopper.delta, member.psi_wall)
    return of_wall * member.steepness


@checked
def fitted(member: Member, last_step: float = 1e-7) -> Member:
    """Move a member to the grid of its size that resolves its apex layer and its wall.

    ``last_step`` as in :func:`newton`; where that fails the member stays as it is.
    """
    hopper = member.hopper
    grid = grid_for(member, member.grid.size, layer_clustering(hopper, member.tau))
    if grid is member.grid:
        return member
    return newton(hopper, grid, member.closure, member.on(grid), last_step) or member


@checked
def grid_for(member: Member, size: int, clustering: float) -> Grid:
    """Return the grid of that clustering with points where psi of a member is close to singular.

    One that has such points keeps them a while: convergence is seen on grids of one kind.
    """
    angle, by = member.hopper.half_angle, Map(clustering)
    bent = _BENT if member.grid.map.plain else 2 * _BENT
    if not 0 < member.gap.min() < FAR:
        return half_grid(size, angle, clustering)
    excess = member.excess
    if excess < bent:
        return mapped_grid(size, angle, replace(by, bend=wall_bend(clustering, excess)))
    place, width = member.kink
    place, slope = by.on_clustered(place)
    if width * slope < bent:
        return mapped_grid(size, angle, replace(by, kink=(place, width * slope)))
    return half_grid(size, angle, clustering)


@checked
def solve(hopper: Hopper, closure: Closure, start: Member | None = None) -> Member | None:
    """Solve from ``start`` (default: a crude guess) on a coarse grid and refine.

    Returns None where that does not converge.
    """
    for size in _coarse_sizes(start):
        if start is None or start.grid.map.plain:
            clustering = 0.0 if start is None else start.grid.map.clustering
            grid = half_grid(size, hopper.half_angle, clustering)
        else:
            grid = mapped_grid(size, hopper.half_angle, start.grid.map)
        if start is None:
            u = crude_start(hopper, grid, closure.value)
        else:
            u = predicted(start, closure).on(grid)
        member = newton(hopper, grid, closure, u)
        if member is not None:
            try:
                return refine(fitted(member))
            except ConvergenceError:
                # Too few points can have solutions of their own.
                continue
    return None


def _coarse_sizes(start: Member | None) -> tuple[int, ...]:
    """Return the grids to begin with: a neighbour needed the one after the first of them."""
    if start is None or start.grid.size not in SIZES:
        return SIZES[:3]
    first = max(0, SIZES.index(start.grid.size) - 1)
    return SIZES[first : first + 3]
