"""The mode that is neutral where the family of radial solutions folds.

The family's tangent solves the linear equations without t, and at a fold of phi its psi1 vanishes
at the wall: lambda = 0 is an eigenvalue, to which the tangent belongs.
"""

from dataclasses import dataclass
from math import exp

import numpy as np

from hopper.arguments import checked
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.collocation import Closure, Member, newton
from hopper.radial.family import neighbour
from hopper.radial.friction_limit import fold_near, friction_limit
from hopper.radial.grid import half_grid
from hopper.radial.members import member_with_tau
from hopper.radial.solution import solution_of
from hopper.stability.low_modes import upper_eigenvalues

_SIZE, _COARSE_SIZE = 80, 54
# Distance in log(tau) from the fold at which growing real modes are counted.
_BESIDE = 1e-2
_LAST_STEP = 1e-10
# Of d psi_w / d log(tau), whose zero is the fold; and what its iteration leaves of log(tau).
_ROUNDING, _ITERATION = 1e-14, 1e-9


@dataclass(frozen=True)
class FoldMode:
    """The symmetric mode of least modulus at a fold, and growing real modes beside it.

    ``error`` is its change from a coarser mesh, and what rounding of the fold's place in tau makes
    of it: where the stress on the axis is small, psi_w hardly bends there. ``before`` and
    ``behind`` are numbers of real modes with lambda > 0 on the physical branch and on the second
    one: they differ by one where one mode passes 0.
    """

    friction_angle: float
    modulus: float
    error: float
    before: int
    behind: int

    __repr__ = brief("friction_angle deg", "modulus", "error", "before", "behind")


@checked
def fold_mode(hopper: Hopper) -> FoldMode | None:
    """Return what is neutral at the fold of a hopper, None if its family does not end in one.

    Raises
    ------
    ConvergenceError
        If the fold is not resolved.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.evidence.folds import fold_mode
    >>> mode = fold_mode(Hopper("cone", delta=0.7, half_angle=0.35))
    >>> mode.before, mode.behind
    (0, 1)
    """
    limit = friction_limit(hopper)
    if limit.end != "fold":
        return None
    fold = fold_near(hopper, member_with_tau(hopper, limit.tau))
    if fold is None:
        raise ConvergenceError(f"fold not resolved: {hopper}")
    before, behind = (
        neighbour(fold, Closure("tau", fold.tau * exp(side * _BESIDE))) for side in (-1, 1)
    )
    slopes = [beside.slope for beside in (before, behind)]
    modes = [upper_eigenvalues(solution_of(beside), _SIZE) for beside in (before, behind)]
    fine, coarse = (
        np.abs(upper_eigenvalues(solution_of(fold), size)).min() for size in (_SIZE, _COARSE_SIZE)
    )
    rate = max(float(np.abs(found).min()) for found in modes) / _BESIDE
    left = _ROUNDING + sum(abs(member.slope) for member in (fold, _on_finer_grid(fold)))
    place = _ITERATION + left * 2 * _BESIDE / abs(slopes[1] - slopes[0])
    growing = [int(np.sum((found.imag == 0) & (found.real > 0))) for found in modes]
    error = float(abs(fine - coarse)) + rate * place
    return FoldMode(limit.friction_angle, float(fine), error, growing[0], growing[1])


def _on_finer_grid(fold: Member) -> Member:
    """Return the same member on a finer grid: what rounding leaves of its slope is another."""
    grid = half_grid(2 * fold.grid.size, fold.hopper.half_angle, fold.grid.map.clustering)
    return newton(fold.hopper, grid, fold.closure, fold.on(grid), _LAST_STEP) or fold
