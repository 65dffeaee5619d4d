"""Chebyshev collocation and Newton iteration for the radial stress equations, (2.8), (2.9), (3.3).

Unknowns are log(sigma / sigma_0), even in theta, and psi, odd, at the positive half of a
Chebyshev grid on [-theta_w, theta_w], and tau = 1 / sigma_0, the strength of gravity relative to
the stress at the axis. The equations, divided by sigma, are regular in tau through tau = 0, where
sigma_0 passes through infinity; the apex is an ordinary point between two nodes.

All radial solutions of a hopper form a curve with one member for each tau.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf, isfinite
from sys import float_info

import numpy as np

from hopper.arguments import Row, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.problem import Hopper
from hopper.radial.equations import slopes
from hopper.radial.grid import Grid, transfer
from hopper.radial.steps import (
    CLOSED,
    Unknown,
    closed_system,
    normal_weight,
    rounding_of_rows,
    rounding_of_unknowns,
    size_of,
    solved_by,
)
from hopper.spectral import chebyshev

_NEWTON_STEPS = 25
# Newton steps from a sample to the extremum beside it, and the last one's size.
_TO_MAXIMUM, _FLAT = 6, 1e-12
# Radians below the singular angle from which on the distance to a square root at the wall counts.
FAR = 0.3
# That distance over theta_w from which on psi_w grows up to the singular angle.
_ROUGHEST = 1e-4


@dataclass(frozen=True)
class Closure:
    """What selects one member of the family: psi at the wall (radians), or tau."""

    unknown: Unknown
    value: float


@dataclass(frozen=True)
class Member:
    """A solution on a grid: ``u`` = (log(sigma / sigma_0), psi, tau), ``tangent`` along the family.

    ``error`` bounds that of u: absolute in log(sigma / sigma_0) and psi, relative in tau where
    tau > 1. Of a member that is not resolved it is the first Newton step.
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

    @property
    def slope(self) -> float:
        """D psi_w / d log(tau) along the family."""
        return self.psi_wall_by_tau * self.tau

    @property
    def rising(self) -> bool:
        """Whether psi_w grows with tau; so it does up to where a wall is as rough as its material.

        There the derivative of tau by psi_w vanishes, and its sign is rounding.
        """
        return self.psi_wall_by_tau > 0 or self.excess < _ROUGHEST

    @property
    def steepness(self) -> float:
        """Change of u, measured as in ``error``, per change of the closure: psi_w, or log(tau)."""
        scale = 1.0 if self.closure.unknown == "psi_wall" else max(abs(self.tau), 1.0)
        return max(1.0, scale * size_of(self.tangent, self.u))

    @property
    def tail(self) -> float:
        """Largest of the last Chebyshev coefficients."""
        return tail(self.log_ratio, self.psi)

    @property
    def gap(self) -> Array:
        """Radians by which psi stays below its singular angle at the nodes."""
        return self.hopper.material.singular_angle(self.hopper.delta) - self.psi

    @property
    def excess(self) -> float:
        """Distance from the wall to where psi becomes singular, over theta_w; inf where it is far.

        psi ends there in a square root, as extrapolated from its slope at the wall.
        """
        gap = self.gap[-1]
        if not 0 < gap < FAR:
            return inf
        theta = self.grid.theta[-1:]
        sigma = np.exp(self.log_ratio[-1:]) / (self.tau or float_info.min)
        steep = slopes(self.hopper, theta, sigma, self.psi[-1:])[1][0] * theta[0]
        return float(gap / (2 * steep)) if steep > 0 else inf

    @property
    def kink(self) -> tuple[float, float]:
        """Place and width, over theta_w, of the bend of psi below its singular angle."""
        gap = self.gap
        nearest = int(np.argmin(gap))
        steepest = np.abs(self.grid.d_odd @ self.psi)[nearest // 2 :].max()
        theta = self.grid.theta
        return theta[nearest] / theta[-1], gap[nearest] / steepest / theta[-1]

    @checked
    def on(self, grid: Grid) -> Array:
        """Return ``u`` interpolated to another grid, stretched where the half angles differ."""
        return moved(self.u, self.grid, grid)


@checked
def moved(u: Array, old: Grid, new: Grid) -> Array:
    """Return unknowns, shape (..., 2 m + 1), interpolated from one grid to another."""
    if old is new:
        return u
    m = old.size
    even, odd = transfer(old, new, "even"), transfer(old, new, "odd")
    return np.concatenate([u[..., :m] @ even.T, u[..., m:-1] @ odd.T, u[..., -1:]], axis=-1)


@checked
def largest_psi(member: Member) -> float:
    """Return the largest psi (radians) on [0, theta_w]."""
    top = top_of(member.psi)
    return float(psi_row(member.grid.size, top) @ member.psi) if top else member.psi_wall


@checked
def top_of(psi: Row) -> float:
    """Return where psi, given at the points of a grid, is largest: 0 at the wall, pi/2 on the axis.

    The Chebyshev point of such an angle is its cosine.
    """
    coefficients, angles, samples, bend_at_wall = _psi_samples(psi.size)
    top = int((samples @ psi).argmax())
    if not top and bend_at_wall @ psi >= 0:
        return 0.0
    series, odd = coefficients @ psi, _degrees(psi.size)
    angle, step = float(angles[top]), angles[1]
    if not top:
        angle = step / 2  # psi falls towards the wall, from a maximum before it
    # Newton's iteration for the slope of the series of cos(odd * angle).
    for _ in range(_TO_MAXIMUM):
        slope = float(np.sin(odd * angle) @ (odd * series))
        bend = float(np.cos(odd * angle) @ (odd * odd * series))
        if bend <= 0 or abs(slope) < _FLAT * bend:
            break
        angle = min(max(angle - slope / bend, angles[top] - step), angles[top] + step)
    return float(angle)


@checked
def psi_row(size: int, angle: float) -> Array:
    """Return the row from psi at ``size`` points to its value at an angle of :func:`top_of`."""
    return np.cos(angle * _degrees(size)) @ _psi_samples(size)[0]


def _degrees(size: int) -> Array:
    """Return 1, 3, ...: psi is a series of cos(x), cos(3 x), ..."""
    return np.arange(1.0, 2 * size, 2)


@lru_cache(maxsize=64)
def _psi_samples(size: int) -> tuple[Array, Array, Array, Array]:
    """Return the matrix from psi to its coefficients, angles, and that to values at them.

    And the row to minus its second derivative by the angle, at the wall. The Chebyshev point of an
    angle is its cosine: 0 is the wall, pi/2 the axis.
    """
    coefficients = chebyshev.last_half_coefficients(size, "odd", size)
    angles = np.linspace(0, np.pi / 2, 4 * size)
    odd = _degrees(size)
    values = np.cos(np.outer(angles, odd)) @ coefficients
    return coefficients, angles, values, odd**2 @ coefficients


@checked
def tail(log_ratio: Row, psi: Row) -> float:
    """Return the largest of the last Chebyshev coefficients: what their grid does not resolve."""
    even = chebyshev.last_half_coefficients(log_ratio.size, "even", 2) @ log_ratio
    odd = chebyshev.last_half_coefficients(psi.size, "odd", 2) @ psi
    return float(max(np.abs(even).max(), np.abs(odd).max()))


def _newton_step(
    hopper: Hopper, grid: Grid, closure: Closure, u: Array, rounded: bool
) -> tuple[Array, Array, Array]:
    """Return Newton's correction, the derivative of u by the closure's value, and roundings."""
    residual, jacobian = closed_system(hopper, grid, closure.unknown, u)
    residual[-1] = u[CLOSED[closure.unknown]] - closure.value
    right = np.zeros((u.size, 2))
    right[:, 0] = -residual
    right[-1, 1] = 1.0
    if rounded:
        right = np.concatenate([right, rounding_of_rows(jacobian, u)], axis=1)
    solved = solved_by(jacobian, right)
    return solved[:, 0], solved[:, 1], solved[:, 2:]


def _iterated(
    hopper: Hopper, grid: Grid, closure: Closure, u: Array, last_step: float, rounded: bool
) -> tuple[Member, Array] | None:
    column = CLOSED[closure.unknown]
    first = size = 0.0
    with np.errstate(over="ignore", invalid="ignore"):
        for iteration in range(_NEWTON_STEPS):
            previous = size
            step, tangent, moved = _newton_step(hopper, grid, closure, u, rounded)
            size = size_of(step, u)
            u = u + step
            # Linear, so met after one step but for rounding, which differs between processors.
            u[column] = closure.value
            if not isfinite(size) or np.abs(u[grid.size : -1]).max() > np.pi / 2:
                return None
            if iteration == 0:
                first = size
            # Small steps that no longer shrink are rounding themselves.
            if size < last_step or (size < 1e-6 and size > previous / 2):
                return Member(hopper, grid, closure, u, tangent, first), moved
    return None


@checked
def newton(
    hopper: Hopper, grid: Grid, closure: Closure, u: Array, last_step: float = 1e-7
) -> Member | None:
    """Solve on one grid from the start ``u``; None where the iteration fails.

    Convergence is quadratic: after a step of size ``last_step`` the error is of the order of its
    square, by default of rounding size. The member's ``error`` is the size of the first step.
    """
    found = _iterated(hopper, grid, closure, u, last_step, rounded=False)
    return found and found[0]


@checked
def newton_with_rounding(
    hopper: Hopper, grid: Grid, closure: Closure, u: Array, last_step: float
) -> tuple[Member, float] | None:
    """Return a member as :func:`newton` does, with what rounding of the equations makes of u."""
    found = _iterated(hopper, grid, closure, u, last_step, rounded=True)
    if found is None:
        return None
    member, moved = found
    return member, float(rounding_of_unknowns(moved[None], member.u[None])[0])


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
def predicted(start: Member, closure: Closure) -> Member:
    """Move along the tangent to where the closure holds to first order."""
    column = CLOSED[closure.unknown]
    step = (closure.value - start.u[column]) / start.tangent[column]
    return replace(start, u=start.u + step * start.tangent) if isfinite(step) else start
