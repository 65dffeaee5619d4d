"""The radial field whose psi just reaches pi/4, and the walls that radial flow still reaches.

Fields that begin on the axis differ by tau alone, whatever the half angle: a field cut off at an
angle is that of a hopper of this half angle, with a wall on which its psi is the wall's. The
largest psi grows with tau. So a material has one field with its maximum at pi/4, and the widest
hopper of which radial flow reaches the wall ends where this field, beyond the maximum, has the psi
of the wall.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import degrees, pi, radians

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.collocation import Closure, Member, psi_row, top_of
from hopper.radial.family import smooth_wall_member
from hopper.radial.grid import Grid, half_grid, layer_clustering
from hopper.radial.refinement import SIZES, TOLERANCE
from hopper.radial.steps import (
    closed_system,
    extrapolated,
    rounding_of_rows,
    rounding_of_unknowns,
    size_of,
    solved_by,
)
from hopper.roots import root_between

# The half angle up to which fields are followed, radians.
WIDEST = radians(89)
# Degrees of delta between kept fields, and the multiples of it with which to begin, of wedges and
# of Mohr-Coulomb and von Mises cones: there the field of a smooth wall is close.
_SPACING, _FIRST = 2.5, {"wedge": 20, "cone": 9, "von Mises": 11}
_SIZE, _ACCEPTABLE = 36, 1e-8
# Least clustering of points: psi rises within a part of the angles.
_CLUSTERING = 3.0
# Last coefficients of a field that is none on its grid, and the shortest step in delta, radians.
_UNRESOLVED, _SHORTEST = 1e-3, 1e-4
_NEWTON_STEPS, _LAST_STEP, _LARGEST_STEP = 30, 1e-7, 0.5
_ROUNDING = 1e-15
_NOT_RESOLVED = "the radial field in which psi just reaches 45 deg is not resolved"


@dataclass(frozen=True)
class FlowCurve:
    """The field whose largest psi is pi/4, up to ``WIDEST``.

    ``top`` is the Chebyshev angle of that place, as :func:`hopper.radial.collocation.top_of`.
    """

    member: Member
    top: float

    __repr__ = brief("member.tau", "member.error", "top")

    @property
    def theta_top(self) -> float:
        """Where psi is pi/4, radians."""
        return WIDEST * float(self.member.grid.map.forward(np.cos([self.top]))[0][0])

    @checked
    def psi_at(self, theta: float) -> float:
        """Return psi (radians) at an angle (radians) up to ``WIDEST``."""
        return float(
            (self.member.grid.interpolation(np.array([theta]), "odd") @ self.member.psi)[0]
        )

    @checked
    def half_angle(self, psi_wall: float) -> Quantity | None:
        """Return the angle (radians) beyond the top where psi is ``psi_wall``, None if nowhere."""
        if not self.member.psi_wall < psi_wall < pi / 4:
            return None
        grid, psi = self.member.grid, self.member.psi
        error = self.member.error + _ROUNDING

        def at(level: float) -> float:
            if level >= pi / 4:
                return self.top
            return root_between(lambda x: float(psi_row(grid.size, x) @ psi) - level, 0, self.top)

        # Close to the top the error goes as the square root: the difference tells.
        levels = (psi_wall, psi_wall - error, psi_wall + error)
        y, _ = grid.map.forward(np.cos([at(level) for level in levels]))
        here, above, below = (WIDEST * y).tolist()
        return Quantity(here, max(above - here, here - below) + _ROUNDING)


@checked
def flow_curve(hopper: Hopper) -> FlowCurve | None:
    """Return the field of a hopper's material whose largest psi is pi/4; of any half angle.

    None where that is not reached before ``WIDEST``: radial flow then reaches every wall with psi
    below pi/4.

    Raises
    ------
    ConvergenceError
        If it is not resolved.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.radial.flow_curve import flow_curve
    >>> curve = flow_curve(Hopper("wedge", delta=0.7, half_angle=0.2))
    >>> round(curve.half_angle(0.6).value, 4)
    1.2467
    """
    return _curve(replace(hopper, half_angle=WIDEST))


@lru_cache(maxsize=256)
def _curve(hopper: Hopper) -> FlowCurve | None:
    number = int(degrees(hopper.delta) / _SPACING)
    # Less internal friction has a field with a wider top, or none.
    low, high = (_kept(replace(hopper, delta=_delta(i))) for i in (number, number + 1))
    if high is None:
        return None
    start = low and _between(low, high, hopper)
    start = start or _continued(high, hopper)
    if start is None:
        return None
    member = _refined(start)
    top = top_of(member.psi)
    return FlowCurve(member, top) if top else None


def _delta(number: int) -> float:
    return radians(min(max(number * _SPACING, 1.0), 89.0))


@lru_cache(maxsize=256)
def _kept(hopper: Hopper) -> Member | None:
    """Return the field on a coarse grid, continued from the one of a delta closer to the first."""
    first = _FIRST[hopper.material.name if hopper.material.hoop == 0 else hopper.geometry]
    step = round(degrees(hopper.delta) / _SPACING) - first
    if not step:
        smooth = smooth_wall_member(hopper, _SIZE)
        return _on(_grid(smooth, _SIZE), smooth)
    start = _kept(replace(hopper, delta=_delta(first + step - (1 if step > 0 else -1))))
    return start and _continued(start, hopper)


def _between(low: Member, high: Member, hopper: Hopper) -> Member | None:
    """Return the field from its interpolation between two; None if that is no good start."""
    grid = _grid(high, _SIZE)
    share = (hopper.delta - low.hopper.delta) / (high.hopper.delta - low.hopper.delta)
    u = (1 - share) * low.on(grid) + share * high.on(grid)
    return _on(grid, replace(high, hopper=hopper, grid=grid, u=u))


def _continued(member: Member, hopper: Hopper) -> Member | None:
    """Follow the field to another delta.

    None where it ends on the way: with less friction its top becomes an inflection.

    Raises
    ------
    ConvergenceError
        If it is lost on the way to more friction.
    """
    share = 1.0
    while gap := hopper.delta - member.hopper.delta:
        delta = hopper.delta if share == 1 else member.hopper.delta + share * gap
        start = replace(member, hopper=replace(hopper, delta=delta))
        following = _on(_grid(member, _SIZE), start)
        if following and following.gap.min() > 0 and following.tail < _UNRESOLVED:
            member, share = following, min(1.0, 2 * share)
        elif share * abs(gap) > _SHORTEST:
            share /= 4
        elif gap > 0:
            raise ConvergenceError(_NOT_RESOLVED)
        else:
            return None
    return member


def _grid(member: Member, size: int) -> Grid:
    clustering = max(_CLUSTERING, layer_clustering(member.hopper, member.tau))
    return half_grid(size, WIDEST, clustering)


def _refined(member: Member) -> Member:
    """Return the field resolved, as :func:`hopper.radial.refinement.refine`."""
    observed: list[tuple[int, float]] = []
    for size in SIZES[SIZES.index(_SIZE) + 1 :]:
        finer = _on(half_grid(size, WIDEST, member.grid.map.clustering), member)
        if finer is None:
            break
        observed.append((member.grid.size, finer.error))
        error = min(finer.error, extrapolated(observed, finer.grid))
        least = _rounding(finer)
        member = replace(finer, error=error + least)
        if error < max(TOLERANCE, least):
            return member
    if member.error > _ACCEPTABLE:
        raise ConvergenceError(_NOT_RESOLVED)
    return member


def _rounding(member: Member) -> float:
    jacobian = _system(member.hopper, member.grid, member.u)[1]
    moved = solved_by(jacobian, rounding_of_rows(jacobian, member.u))
    return float(rounding_of_unknowns(moved[None], member.u[None])[0])


def _on(grid: Grid, start: Member) -> Member | None:
    """Solve on one grid, as :func:`hopper.radial.collocation.newton`."""
    hopper, u, first = start.hopper, start.on(grid), 0.0
    right = np.zeros((u.size, 2))
    right[-1, 1] = 1.0
    for iteration in range(_NEWTON_STEPS):
        residual, jacobian = _system(hopper, grid, u)
        right[:, 0] = -residual
        step, tangent = solved_by(jacobian, right).T
        size = size_of(step, u)
        if not np.isfinite(size):
            return None
        u = u + step * min(1.0, _LARGEST_STEP / size)
        if np.abs(u[grid.size : -1]).max() > pi / 2:
            return None
        first = first if iteration else size
        if size < _LAST_STEP:
            return Member(hopper, grid, Closure("tau", float(u[-1])), u, tangent, first)
    return None


def _system(hopper: Hopper, grid: Grid, u: Array) -> tuple[Array, Array]:
    """Return residuals and derivatives of the equations and of largest psi = pi/4."""
    residual, jacobian = closed_system(hopper, grid, "tau", u)
    psi = u[grid.size : -1]
    row = psi_row(grid.size, top_of(psi))
    residual[-1] = row @ psi - pi / 4
    jacobian[-1] = 0.0
    jacobian[-1, grid.size : -1] = row  # where psi is largest it does not change with the place
    return residual, jacobian
