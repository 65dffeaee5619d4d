"""Borders of the stable domain in the plane of internal and wall friction.

The domain is bounded by the neutral curve and by the limit of wall friction, at which the family of
radial solutions ends. Two levels of psi are drawn with it and bound nothing of it: at
pi/4 - delta/2 (tangency) the arcs r = const are characteristic, at pi/4 the velocity is singular,
so that no radial flow reaches the wall although stress and its stability are regular.
"""

from dataclasses import dataclass
from math import pi
from typing import Self

import numpy as np

from hopper.arguments import Positive, Radians, RealRow, checked
from hopper.arrays import Array, Mask
from hopper.brief import brief
from hopper.domain.growth import ROOT_TOLERANCE
from hopper.domain.neutral_curve import NeutralCurve
from hopper.errors import NoRadialSolutionError
from hopper.problem import Geometry, Hopper
from hopper.radial.collocation import Closure, Member, largest_psi
from hopper.radial.family import neighbour, smooth_wall_member
from hopper.radial.friction_limit import friction_limit
from hopper.radial.members import member_with_tau
from hopper.radial.pieces import physical_branch
from hopper.roots import root_between
from hopper.stability.tilted import require_mohr_coulomb, tangency_angle

# How often an interval between borders is halved at most.
_HALVINGS = 5


@checked
def friction_reaching(hopper: Hopper, psi: float) -> float | None:
    """Return the wall friction angle (radians) at which the largest psi equals ``psi`` (radians).

    None where the smooth wall already exceeds it, the physical branch ends below it, or the stress
    is not positive there.

    Raises
    ------
    ConvergenceError
        If the radial solution there is not resolved.
    """
    below: Member | None = None
    try:
        for member in physical_branch(hopper):
            # The nodes miss the largest psi by far less than this margin.
            if member.psi.max() >= 0.9 * psi and largest_psi(member) >= psi:
                return _friction_between(below, member, psi) if below else None
            below = member
    except NoRadialSolutionError:
        pass
    return None


def _friction_between(below: Member, above: Member, psi: float) -> float | None:
    """Locate the level between two members; None beyond the fold or without positive stress."""
    law, delta = below.hopper.material, below.hopper.delta
    if below.psi_wall < psi <= above.psi_wall:
        at_wall = neighbour(below, Closure("psi_wall", psi))
        if largest_psi(at_wall) <= psi + ROOT_TOLERANCE:
            return law.friction_angle(delta, psi) if at_wall.tau > 0 else None
    unknown = above.closure.unknown
    low, high = (float(getattr(member, unknown)) for member in (below, above))

    def excess(value: float) -> float:
        return largest_psi(neighbour(below, Closure(unknown, value))) - psi

    # psi at the wall is at most the largest psi: no need to look beyond the level.
    high = min(high, psi) if unknown == "psi_wall" else high
    reached = neighbour(below, Closure(unknown, root_between(excess, low, high, xtol=1e-13)))
    if reached.tau <= 0 or (unknown == "tau" and reached.psi_wall_by_tau <= 0):
        return None
    return law.friction_angle(delta, reached.psi_wall)


@checked
def tangency_friction(hopper: Hopper) -> float | None:
    """Return the wall friction angle (radians) at which psi first reaches pi/4 - delta/2.

    At the wall this is mu = sin(delta) cos(delta) / (1 + sin(delta)**2). None as
    :func:`friction_reaching`.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.domain.borders import tangency_friction
    >>> round(tangency_friction(Hopper("cone", delta=0.7, half_angle=0.2)), 4)
    0.3351
    """
    require_mohr_coulomb(hopper)
    return friction_reaching(hopper, tangency_angle(hopper.delta))


@checked
def singular_velocity_friction(hopper: Hopper) -> float | None:
    """Return the wall friction angle (radians) at which psi reaches pi/4, None as above.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.domain.borders import singular_velocity_friction
    >>> round(singular_velocity_friction(Hopper("wedge", delta=0.7, half_angle=0.2)), 4)
    0.5723
    """
    return friction_reaching(hopper, pi / 4)


@checked
def positive_stress_friction(hopper: Hopper) -> float | None:
    """Return the least wall friction angle (radians) with positive stress, None if there is none.

    It is 0 where a smooth wall has positive stress.

    Raises
    ------
    NoRadialSolutionError
        If not even a smooth wall has a radial solution.
    ConvergenceError
        If the radial solution of infinite stress on the axis is not resolved.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.domain.borders import positive_stress_friction
    >>> round(positive_stress_friction(Hopper("wedge", delta=0.15, half_angle=0.2)), 4)
    0.1033
    """
    if smooth_wall_member(hopper).tau > 0:
        return 0.0
    try:
        member = member_with_tau(hopper, 0.0)
    except NoRadialSolutionError:
        return None
    return hopper.material.friction_angle(hopper.delta, member.psi_wall) if member.rising else None


@dataclass(frozen=True)
class Borders:
    """Wall friction angles (radians) at which something ends, over delta; NaN where it does not.

    Attributes
    ----------
    delta : array, shape (n,)
    limit : array
        Largest friction with a radial solution.
    limit_error : array
        Its error estimate.
    end : tuple of n
        What ends the branch there, as in FrictionLimit; "none" where not even a smooth wall has a
        solution.
    tangency : array
        psi reaches pi/4 - delta/2.
    singular_velocity : array
        psi reaches pi/4.
    positive_stress : array
        The stress is positive above; 0 where it is for a smooth wall.
    """

    delta: Array
    limit: Array
    limit_error: Array
    end: tuple[str, ...]
    tangency: Array
    singular_velocity: Array
    positive_stress: Array

    __repr__ = brief("delta deg", "limit deg", "tangency deg")

    def thinned(self) -> Self:
        """Return every second point, the last included: for an error estimate."""
        every = slice((self.delta.size - 1) % 2, None, 2)
        return type(self)(*(values[every] for values in vars(self).values()))


@checked
def borders(geometry: Geometry, half_angle: Radians, deltas: RealRow) -> Borders:
    """Return the borders of what is known about a hopper's stability over ``deltas`` (radians).

    Raises
    ------
    ConvergenceError
        If a radial solution on a border is not resolved.
    """
    delta = np.asarray(deltas)
    table = np.full((5, delta.size), np.nan)
    ends = []
    for i, value in enumerate(delta):
        hopper = Hopper(geometry, float(value), half_angle)
        try:
            limit = friction_limit(hopper)
        except NoRadialSolutionError:
            ends.append("none")
            continue
        ends.append(limit.end)
        levels = (
            tangency_friction(hopper),
            singular_velocity_friction(hopper),
            positive_stress_friction(hopper),
        )
        table[:, i] = (
            limit.friction_angle,
            limit.error_estimate,
            *(np.nan if phi is None else phi for phi in levels),
        )
    return Borders(delta, table[0], table[1], tuple(ends), *table[2:])


@checked
def traced_borders(
    geometry: Geometry, half_angle: Radians, deltas: RealRow, chord: Positive
) -> Borders:
    """Return the borders over ``deltas`` (radians), and over more where they bend or begin.

    An interval is halved, up to five times, while the chord beside it is off by more than ``chord``
    (radians), or a border begins in it.

    Raises
    ------
    ConvergenceError
        As :func:`borders`.
    """
    found = borders(geometry, half_angle, deltas)
    for _ in range(_HALVINGS):
        rough = _rough(found, chord)
        if not rough.any():
            break
        middles = (found.delta[:-1] + found.delta[1:])[rough] / 2
        found = _merged(found, borders(geometry, half_angle, middles))
    return found


def _merged(one: Borders, other: Borders) -> Borders:
    """Return two results as one, over increasing delta."""
    both = {name: (*vars(one)[name], *vars(other)[name]) for name in vars(one)}
    order = np.argsort(both["delta"])
    ends = both.pop("end")
    arrays = {name: np.array(values)[order] for name, values in both.items()}
    return Borders(**arrays, end=tuple(ends[index] for index in order))


def _rough(found: Borders, chord: float) -> Mask:
    """Return the intervals in which a line between neighbours is not the border, shape (n - 1,)."""
    x = found.delta
    rough = np.zeros(x[1:].size, dtype=bool)
    for y in (found.limit, found.tangency, found.singular_velocity, found.positive_stress):
        known = np.isfinite(y)
        rough |= known[:-1] != known[1:]
        line = y[:-2] + (y[2:] - y[:-2]) * (x[1:-1] - x[:-2]) / (x[2:] - x[:-2])
        with np.errstate(invalid="ignore"):
            off = np.abs(y[1:-1] - line) > chord
        rough[:-1] |= off
        rough[1:] |= off
    return rough


@checked
def stable_outline(curve: NeutralCurve, found: Borders) -> tuple[Array, Array]:
    """Return delta and phi (radians) along the outline of the stable domain, closed by the caller.

    From the smooth wall along the neutral curve, then along the limit of wall friction to the
    largest delta of ``found``, and down to phi = 0. The limit must be known at every delta beyond
    the curve's end.
    """
    beyond = (found.delta > curve.delta[-1]) & np.isfinite(found.limit)
    right = found.delta[-1:]
    return (
        np.concatenate([curve.delta, found.delta[beyond], right, curve.delta[:1]]),
        np.concatenate([curve.friction_angle, found.limit[beyond], [0.0, 0.0]]),
    )


@checked
def stable_area(curve: NeutralCurve, found: Borders) -> tuple[float, float]:
    """Return the area (radians squared) of the stable domain, and of its part with psi < pi/4.

    Up to the largest delta of ``found``. In the rest of the domain no radial flow reaches the wall.
    """
    delta, phi = stable_outline(curve, found)
    unreached = np.isnan(found.singular_velocity)
    level = np.where(unreached, pi / 2, found.singular_velocity)
    below = np.minimum(phi, np.interp(delta, found.delta, level))
    return _enclosed(delta, phi), _enclosed(delta, below)


def _enclosed(x: Array, y: Array) -> float:
    """Return the area inside a closed polygon, or of its part below a level that cuts ``y``."""
    return float(abs(np.sum((np.roll(x, -1) - x) * (np.roll(y, -1) + y))) / 2)
