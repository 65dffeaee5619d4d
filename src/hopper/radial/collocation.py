"""Chebyshev collocation and Newton iteration for the radial stress equations, (2.8), (2.9), (3.3).

Unknowns are log(sigma / sigma_0), even in theta, and psi, odd, at the positive half of a
Chebyshev grid on [-theta_w, theta_w], and tau = 1 / sigma_0, the strength of gravity relative to
the stress at the axis. The equations, divided by sigma, are regular in tau through tau = 0, where
sigma_0 passes through infinity; the apex is an ordinary point between two nodes.

All radial solutions of a hopper form a curve with one member for each tau.

References
----------
.. [TT] T. W. Tee, L. N. Trefethen, A rational spectral collocation method with adaptively
   transformed Chebyshev grid points, SIAM J. Sci. Comput. 28 (2006).
"""

from dataclasses import dataclass, replace
from math import isfinite
from typing import Literal

import numpy as np
from scipy.linalg.lapack import dgesv

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.equations import normal_weight, residual_and_jacobian
from hopper.radial.grid import Grid, half_grid, layer_clustering, transfer

# Half-grid sizes; a solution on one is confirmed on the next.
_SIZES = (12, 16, 24, 36, 54, 80, 120, 180)
_NEWTON_STEPS = 25
_TOLERANCE = 1e-12
_ACCEPTABLE = 1e-6
# Factor on the error that geometric convergence predicts; near the singular angle it is slower.
_SAFETY = 20


@dataclass(frozen=True)
class Closure:
    """What selects one member of the family: psi at the wall (radians), or tau."""

    unknown: Literal["psi_wall", "tau"]
    value: float


@dataclass(frozen=True)
class Member:
    """A solution on a grid: ``u`` = (log(sigma / sigma_0), psi, tau), ``tangent`` along the family.

    ``error`` is an estimate of the error of u: absolute in log(sigma / sigma_0) and psi, relative
    in tau where tau > 1.
    """

    hopper: Hopper
    grid: Grid
    closure: Closure
    u: Array
    tangent: Array
    error: float

    __repr__ = brief(
        "hopper.geometry",
        "hopper.delta deg",
        "hopper.half_angle deg",
        "tau",
        "psi_wall deg",
        "error",
    )

    @property
    def log_ratio(self) -> Array:
        """log(sigma / sigma_0) at the nodes."""
        return self.u[: self.grid.size]

    @property
    def psi(self) -> Array:
        """Psi (radians) at the nodes."""
        return self.u[self.grid.size : -1]

    @property
    def psi_wall(self) -> float:
        """Psi at the wall, radians."""
        return float(self.u[-2])

    @property
    def tau(self) -> float:
        """1 / sigma_0."""
        return float(self.u[-1])

    @property
    def psi_wall_by_tau(self) -> float:
        """D psi_w / d tau along the family; changes sign at a fold."""
        return float(self.tangent[-2] / self.tangent[-1])

    @checked
    def on(self, grid: Grid) -> Array:
        """Return ``u`` interpolated to another grid, stretched where the half angles differ."""
        if grid is self.grid:
            return self.u
        even, odd = transfer(self.grid, grid, "even"), transfer(self.grid, grid, "odd")
        return np.concatenate([even @ self.log_ratio, odd @ self.psi, self.u[-1:]])


def _newton_step(hopper: Hopper, grid: Grid, closure: Closure, u: Array) -> tuple[Array, Array]:
    """Return the Newton correction, and the derivative of u by the closure's value."""
    residual, jacobian = residual_and_jacobian(hopper, grid, u)
    # log(sigma / sigma_0) = 0 on the axis replaces the angular equation at the wall: that equation
    # is odd with one degree less, so one of its rows is redundant.
    residual[-2] = grid.axis_row @ u[: grid.size]
    jacobian[-2] = 0.0
    jacobian[-2, : grid.size] = grid.axis_row
    column = _column(closure)
    residual[-1] = u[column] - closure.value
    jacobian[-1, column] = 1.0
    right = np.zeros((u.size, 2), order="F")
    right[:, 0] = -residual
    right[-1, 1] = 1.0
    # LAPACK itself: at this size numpy's checks cost as much as the solution.
    _, _, solved, info = dgesv(jacobian, right, overwrite_b=True)
    if info:
        solved[:] = np.nan
    return solved[:, 0], solved[:, 1]


def _column(closure: Closure) -> int:
    return -2 if closure.unknown == "psi_wall" else -1


def _size(step: Array, u: Array) -> float:
    """Size of a step: absolute in log(sigma) and psi, relative in tau where tau > 1."""
    return max(float(np.abs(step[:-1]).max()), float(abs(step[-1])) / max(abs(u[-1]), 1.0))


@checked
def newton(
    hopper: Hopper, grid: Grid, closure: Closure, u: Array, last_step: float = 1e-7
) -> Member | None:
    """Solve on one grid from the start ``u``; None where the iteration fails.

    Convergence is quadratic: after a step of size ``last_step`` the error is of the order of its
    square, by default of rounding size. The member's ``error`` is the size of the first step.
    """
    column = _column(closure)
    first = size = 0.0
    with np.errstate(over="ignore", invalid="ignore"):
        for iteration in range(_NEWTON_STEPS):
            previous = size
            step, tangent = _newton_step(hopper, grid, closure, u)
            size = _size(step, u)
            u = u + step
            # Linear, so met after one step but for rounding, which differs between processors.
            u[column] = closure.value
            if not isfinite(size) or np.abs(u[grid.size : -1]).max() > np.pi / 2:
                return None
            if iteration == 0:
                first = size
            # Small steps that no longer shrink are rounding themselves.
            if size < last_step or (size < 1e-6 and size > previous / 2):
                return Member(hopper, grid, closure, u, tangent, first)
    return None


@checked
def crude_start(hopper: Hopper, grid: Grid, psi_wall: float) -> Array:
    """Return linear psi, with tau and the curvature of log(sigma) that the apex then asks for."""
    k, s, law = hopper.curvature, hopper.s, hopper.material
    slope = psi_wall / hopper.half_angle
    apex = 1 - s * (k * law.hoop + normal_weight(hopper))
    tau = 2 * s * (1 + k) * slope - apex
    shape = 2 * law.angular + k * (law.angular - law.hoop_cosine)
    curvature = (2 * s * slope * (shape * slope + 3 + k) + tau) / (1 + law.angular * s)
    log_ratio = curvature / 2 * grid.theta**2
    return np.concatenate([log_ratio, slope * grid.theta, [tau]])


@checked
def refine(member: Member) -> Member:
    """Solve on finer grids until the error is of rounding size.

    The first Newton step on a finer grid is the error of the coarser one. Errors decay
    geometrically with the number of points, so that of the finer grid is about this step to the
    power of the ratio of their sizes.

    Raises
    ------
    ConvergenceError
        If the error on the finest grid exceeds 1e-6.
    """
    for size in _SIZES:
        if size <= member.grid.size:
            continue
        grid = half_grid(size, member.hopper.half_angle, member.grid.clustering)
        finer = newton(member.hopper, grid, member.closure, member.on(grid))
        if finer is None:
            break
        stagnant = finer.error < 1e-9 and finer.error > member.error / 2
        error = finer.error
        if not stagnant:
            error = min(error, _SAFETY * error ** (size / member.grid.size))
        member = replace(finer, error=max(error, np.finfo(float).eps * size))
        if member.error < _TOLERANCE or stagnant:
            return member
    if member.error < _ACCEPTABLE:
        return member
    raise ConvergenceError(
        f"radial solution not resolved: {member.grid.size} half-grid points leave an error of "
        f"{member.error:.1e}; psi is too close to its singular value, lower the wall friction"
    )


@checked
def fitted(member: Member, last_step: float = 1e-7) -> Member:
    """Move a member to the grid of its size that resolves its apex layer.

    ``last_step`` as in :func:`newton`; where that fails the member stays as it is.
    """
    hopper = member.hopper
    clustering = layer_clustering(hopper, member.tau)
    grid = half_grid(member.grid.size, hopper.half_angle, clustering)
    if grid is member.grid:
        return member
    return newton(hopper, grid, member.closure, member.on(grid), last_step) or member


@checked
def solve(hopper: Hopper, closure: Closure, start: Member | None = None) -> Member | None:
    """Solve from ``start`` (default: a crude guess) on a coarse grid and refine.

    Returns None where that does not converge.
    """
    for size in _coarse_sizes(start):
        clustering = 0.0 if start is None else start.grid.clustering
        grid = half_grid(size, hopper.half_angle, clustering)
        if start is None:
            u = crude_start(hopper, grid, closure.value)
        else:
            u = _predicted(start, closure).on(grid)
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
    if start is None or start.grid.size not in _SIZES:
        return _SIZES[:3]
    first = max(0, _SIZES.index(start.grid.size) - 1)
    return _SIZES[first : first + 3]


def _predicted(start: Member, closure: Closure) -> Member:
    """Move along the tangent to where the closure holds to first order."""
    column = _column(closure)
    step = (closure.value - start.u[column]) / start.tangent[column]
    return replace(start, u=start.u + step * start.tangent) if isfinite(step) else start
