"""Design charts: wall friction against half angle, for one internal friction.

What Jenike's charts show, the line of mass flow and the flow factor, with the limits that they
lack. At each half angle a limit is a root in the friction of the wall.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from math import nan, pi
from typing import TypeVar

import numpy as np

from hopper.arguments import Radians, RealRow, checked
from hopper.arrays import Array
from hopper.assessment.propagation import ROUNDING
from hopper.brief import brief
from hopper.design.neutral import last_run, neutral_between
from hopper.domain.stability_map import sweep_friction
from hopper.errors import HopperError, InvalidParameterError, NoRadialSolutionError
from hopper.problem import Geometry, Hopper
from hopper.quantity import Quantity
from hopper.radial.branch import branch_up_to, members_on
from hopper.radial.family import smooth_wall_member
from hopper.radial.flow_curve import FlowCurve, flow_curve
from hopper.radial.flow_factor import flow_factor
from hopper.radial.friction_limit import friction_limit
from hopper.radial.mass_flow import (
    limiting_wall_angle,
    mass_flow_friction_angle,
    mass_flow_half_angle,
)
from hopper.radial.members import physical_member
from hopper.radial.solution import solution_of, solve_radial
from hopper.stability.modes import linear_stability

_Found = TypeVar("_Found")
_LINES = ("classical", "limit", "velocity", "stability", "stable_from")
# Wall frictions at which stability is looked at, relative to the limit, and where roots end.
_LOOKED_AT = np.array([0.0, 0.2, 0.4, 0.6, 0.8, 0.93, 0.995])
_ROOT = 1e-9
# Parabolas through the three samples around the lowest one where none is stable.
_PARABOLAS = 3
# The largest wall friction of flow factors, relative to the limit of mass flow.
_LAST = 0.999
_STEP = 1e-6
# How close the end of radial solutions for smooth walls is approached, radians.
_END = 1e-4
# Halvings of the step in the half angle where the stable interval ends.
_HALVINGS = 6


@dataclass(frozen=True)
class ChartLine:
    """A limit of wall friction (radians) over half angles, with errors, each of shape (n,).

    NaN where there is none.
    """

    friction_angle: Array
    error: Array

    __repr__ = brief("friction_angle deg")


@dataclass(frozen=True)
class Chart:
    """Limits of wall friction over the half angle, and flow factors below that of mass flow.

    Attributes
    ----------
    half_angle : array, shape (n,)
        Radians, increasing.
    classical, limit, velocity, stability : ChartLine
        As those of :class:`hopper.design.half_angles.HalfAngles`, in the friction of the wall.
    stable_from : ChartLine
        The least friction of the stable interval that ends at ``stability``; NaN where walls that
        are smoother are stable too.
    friction_angle, flow_factor : arrays, shape (n, m)
        Wall frictions (radians) from 0 to the limit of mass flow, and flow factors there.
    """

    half_angle: Array
    classical: ChartLine
    limit: ChartLine
    velocity: ChartLine
    stability: ChartLine
    stable_from: ChartLine
    friction_angle: Array
    flow_factor: Array

    __repr__ = brief("half_angle deg")


@checked
def chart(
    geometry: Geometry, delta: Radians, half_angle_row: RealRow, frictions: int = 16
) -> Chart:
    """Return the chart of Mohr-Coulomb hoppers for one internal friction (radians).

    ``half_angle_row`` (radians) increases; half angles at which a limit has a corner or ends are
    added. ``frictions`` is the number of wall frictions at which flow factors are computed.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range, the half angles do not increase, or there are fewer than two,
        or fewer than two frictions.

    Examples
    --------
    >>> from hopper.design.charts import chart
    >>> chart("cone", delta=0.7, half_angle_row=[0.2, 0.3, 0.4], frictions=2)
    Chart(half_angle=11.4592 deg..22.9183 deg (3))
    """
    angles = np.asarray(half_angle_row)
    if angles.size < 2 or np.any(np.diff(angles) <= 0):
        raise InvalidParameterError("half_angle_row must be two at least, and increase: sort them")
    if frictions < 2:
        raise InvalidParameterError(f"frictions = {frictions} is too few: give 2 at least")
    field = _or_none(lambda: flow_curve(Hopper(geometry, delta, 0.1)))
    narrow = Hopper(geometry, delta, float(angles[0]))
    angles = _with_corners(narrow, angles, field)
    columns = _with_noses([_column(replace(narrow, half_angle=a), field) for a in angles.tolist()])
    angles = np.array([column.half_angle for column in columns])
    flows = [column.mass_flow for column in columns]
    rows = np.outer(flows, np.linspace(0, _LAST, frictions))
    factors = [
        _factors(Hopper(geometry, delta, a), row) for a, row in zip(angles, rows, strict=True)
    ]
    lines = {name: _line([column.limits[name] for column in columns]) for name in _LINES}
    return Chart(angles, friction_angle=rows, flow_factor=np.array(factors), **lines)


def _with_corners(narrow: Hopper, angles: Array, field: FlowCurve | None) -> Array:
    """Return half angles with those of corners and ends within their range."""
    ends = (
        field and field.theta_top,
        _or_none(lambda: mass_flow_half_angle(narrow, 0.0)),
        _last_smooth(narrow, *angles[[0, -1]].tolist()),
    )
    inside = [end for end in ends if end and angles[0] < end < angles[-1]]
    return np.unique(np.append(angles, inside))


def _last_smooth(hopper: Hopper, low: float, high: float) -> float:
    """Return the widest half angle between two with a radial solution for a smooth wall."""
    angle = high
    while high - low > _END:
        try:
            smooth_wall_member(replace(hopper, half_angle=angle))
        except NoRadialSolutionError:
            high = angle
        else:
            low = angle
        angle = (low + high) / 2
    return low


@dataclass(frozen=True)
class _Column:
    """All limits at one half angle, by name."""

    hopper: Hopper
    field: FlowCurve | None
    limits: dict[str, Quantity | None]

    @property
    def half_angle(self) -> float:
        return self.hopper.half_angle

    @property
    def mass_flow(self) -> float:
        """The wall friction up to which there is mass flow, radians; NaN where there is none."""
        cone = self.hopper.geometry == "cone"
        found = self.limits["classical" if cone else "velocity"]
        found = found or (None if cone else self.limits["limit"])
        return found.value if found else nan


def _column(hopper: Hopper, field: FlowCurve | None) -> _Column:
    found: dict[str, Quantity | None] = dict.fromkeys(_LINES)
    limit = found["limit"] = _or_none(lambda: _limit(hopper))
    found["classical"] = _or_none(lambda: _classical(hopper))
    if limit and field:
        found["velocity"] = _velocity(hopper, field, limit.value)
    if limit:
        found["stable_from"], found["stability"] = _stable(hopper, limit)
    return _Column(hopper, field, found)


def _with_noses(columns: list[_Column]) -> list[_Column]:
    """Return columns with more of them where the stable interval shrinks to nothing."""
    found = columns[:1]
    for low, last in pairwise(columns):
        high, more = last, list[_Column]()
        if low.limits["limit"] and high.limits["limit"]:
            for _ in range(_HALVINGS):
                if bool(low.limits["stability"]) == bool(high.limits["stability"]):
                    break
                angle = (low.half_angle + high.half_angle) / 2
                middle = _column(replace(low.hopper, half_angle=angle), low.field)
                more.append(middle)
                alike = bool(middle.limits["stability"]) == bool(low.limits["stability"])
                low, high = (middle, high) if alike else (low, middle)
        found += [*more, last]
    return sorted(found, key=lambda one: one.half_angle)


def _or_none(find: Callable[[], _Found]) -> _Found | None:
    try:
        return find()
    except HopperError:
        return None


def _line(found: list[Quantity | None]) -> ChartLine:
    known = [(one.value, one.error) if one else (nan, nan) for one in found]
    return ChartLine(*np.array(known).T)


def _limit(hopper: Hopper) -> Quantity:
    found = friction_limit(hopper)
    return Quantity(found.friction_angle, found.error_estimate)


def _classical(hopper: Hopper) -> Quantity | None:
    if limiting_wall_angle(hopper) < -ROUNDING:
        return None
    return Quantity(mass_flow_friction_angle(hopper), ROUNDING)


def _velocity(hopper: Hopper, field: FlowCurve, most: float) -> Quantity | None:
    """Return the friction with largest psi pi/4: at the wall, or inside, as in the field of that.

    None beyond the limit, or where the field is not of the physical branch.
    """
    wall = hopper.half_angle < field.theta_top
    psi_wall = pi / 4 if wall else field.psi_at(hopper.half_angle)
    if psi_wall < 0:
        return None
    phi, beside = (
        hopper.material.friction_angle(hopper.delta, psi_wall + step) for step in (0.0, _STEP)
    )
    if phi > most or not (wall or field.member.tau <= friction_limit(hopper).tau):
        return None
    return Quantity(phi, abs(beside - phi) / _STEP * field.member.error + ROUNDING)


def _stable(hopper: Hopper, limit: Quantity) -> tuple[Quantity | None, Quantity | None]:
    """Return the ends of the last stable interval of wall friction; the first None at 0."""

    def abscissa(phi: float) -> float:
        return linear_stability(solve_radial(hopper, phi)).abscissa

    def root(low: float, high: float) -> Quantity | None:
        return _or_none(lambda: neutral_between(partial(solve_radial, hopper), low, high, _ROOT))

    phis = limit.value * _LOOKED_AT
    values = sweep_friction(hopper, phis).abscissa
    phis, values = _with_lowest(abscissa, phis, values)
    run = last_run(values < 0)
    if run is None:
        return None, None
    first, last = run
    low = root(*phis[first - 1 : first + 1]) if first else None
    if last + 1 == phis.size:  # at a fold a mode is neutral
        return low, limit
    if np.isnan(values[last + 1]):
        return low, None
    return low, root(*phis[last : last + 2])


def _with_lowest(
    abscissa: Callable[[float], float], phis: Array, values: Array
) -> tuple[Array, Array]:
    """Return samples with the least between them, where none is negative: by parabolas."""
    for _ in range(_PARABOLAS):
        if not np.isfinite(values).any() or np.nanmin(values) < 0:
            break
        lowest = int(np.nanargmin(values))
        around = slice(lowest - 1, lowest + 2)
        if not 0 < lowest < phis.size - 1 or np.isnan(values[around]).any():
            break
        a, b, _ = np.polyfit(phis[around], values[around], 2)
        at = -b / (2 * a)
        if np.abs(phis - at).min() < _ROOT:
            break
        place = int(np.searchsorted(phis, at))
        phis = np.insert(phis, place, at)
        values = np.insert(values, place, _or_none(partial(abscissa, float(at))) or nan)
    return phis, values


def _factors(hopper: Hopper, frictions: Array) -> Array:
    """Return flow factors at wall frictions (radians) of one hopper, NaN where there is none."""
    factors = np.full(frictions.size, nan)
    if np.isnan(frictions).any():
        return factors
    psi_walls = np.array([hopper.material.wall_angle(hopper.delta, phi) for phi in frictions])
    branch = _or_none(lambda: branch_up_to(hopper, float(psi_walls.max())))
    members = members_on(branch, psi_walls) if branch else [None] * frictions.size
    for i, (phi, member) in enumerate(zip(frictions.tolist(), members, strict=True)):
        found = member or _or_none(partial(physical_member, hopper, phi))
        if found and found.tau > 0:
            factors[i] = flow_factor(solution_of(found))
    return factors
