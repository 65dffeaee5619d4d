"""The neutral curve, which separates unstable from stable hoppers.

It begins on the smooth wall. In cones that have a fold it ends on the fold in a *corner* of the
stable domain: there two modes vanish together, as the pair that was neutral becomes real and one
mode is zero at every fold. Elsewhere it runs on below the limit of wall friction as far as one
looks.
"""

from dataclasses import dataclass
from functools import partial
from math import exp, log, prod
from typing import Literal, Self, get_args

import numpy as np

from hopper.arguments import Positive, Radians, RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.domain.growth import ROOT_TOLERANCE, Hoppers, root, root_near
from hopper.domain.neutral_points import neutral_delta
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.problem import Geometry
from hopper.radial.collocation import Member
from hopper.roots import root_between
from hopper.stability.collocation import Parity
from hopper.stability.modes import Disturbances, Governor, LinearStability

CurveEnd = Literal["fold", "largest_delta", "not_converged"]
CURVE_ENDS: tuple[CurveEnd, ...] = get_args(CurveEnd)

# Smallest step, relative to the largest; the largest along the arc, and the unit of its length in
# delta (radians) and log(tau).
_LEAST_STEP = 1e-3
_ARC_STEP = 0.08
_UNIT = np.array([0.05, 1.0])
# Last secant step in delta for a corner, radians: rounding of the fold leaves a tenth of it.
_CORNER_TOLERANCE = 1e-8


@dataclass(frozen=True)
class NeutralCurve:
    """Points of a neutral curve from the smooth wall on; radians.

    Attributes
    ----------
    friction_angle, delta : arrays, shape (n,)
    governed_by : tuple of n
        What is neutral: the line, a complex or a real mode.
    parity : tuple of n
        Of the disturbance: "symmetric" or "asymmetric", None for the line.
    end : "fold", "largest_delta" or "not_converged"
        What ends it: the last point is the corner on the fold, or has the largest delta asked for.
    """

    friction_angle: Array
    delta: Array
    governed_by: tuple[Governor, ...]
    parity: tuple[Parity | None, ...]
    end: CurveEnd

    __repr__ = brief("friction_angle deg", "delta deg", "end")

    @checked
    def first_delta(self, friction_angle: RealLike) -> Array:
        """Return the least delta on the curve at wall frictions, interpolated; NaN above it."""
        rising = slice(0, int(np.argmax(self.friction_angle)) + 1)
        known = self.friction_angle[rising], self.delta[rising]
        return np.interp(np.asarray(friction_angle, dtype=float), *known, right=np.nan)

    def thinned(self) -> Self:
        """Return every second point, and the last: for an error estimate."""
        index = np.append(np.arange(0, self.delta.size - 1, 2), self.delta.size - 1)
        return type(self)(
            self.friction_angle[index],
            self.delta[index],
            tuple(self.governed_by[i] for i in index),
            tuple(self.parity[i] for i in index),
            self.end,
        )


@dataclass(frozen=True)
class _Point:
    member: Member
    result: LinearStability

    @property
    def delta(self) -> float:
        return self.member.hopper.delta

    @property
    def friction_angle(self) -> float:
        return self.member.hopper.material.friction_angle(self.delta, self.member.psi_wall)

    @property
    def place(self) -> Array:
        """Delta and log tau, in units in which the curve is as long in both."""
        return np.array([self.delta, log(self.member.tau)]) / _UNIT


@checked
def neutral_curve(
    geometry: Geometry,
    half_angle: Radians,
    step: Positive,
    largest_delta: float = np.pi / 3,
    disturbances: Disturbances | None = None,
) -> NeutralCurve:
    """Trace the neutral curve from the smooth wall, by continuation.

    Parameters
    ----------
    geometry : "wedge" or "cone"
        Shape of the hopper.
    half_angle : float
        theta_w, radians.
    step : float
        Largest step in phi, radians.
    largest_delta : float
        Where to stop, radians, if the curve does not end on a fold before.
    disturbances : "symmetric" or "any", optional
        Default: any for wedges, symmetric for cones.

    Raises
    ------
    InvalidParameterError
        If the step is not a positive number.
    NoNeutralPointError
        If not even the smooth wall has a neutral delta.

    Examples
    --------
    >>> from hopper import neutral_curve
    >>> curve = neutral_curve("cone", half_angle=0.2, step=0.1)
    >>> print(curve.delta[:2].round(4), curve.friction_angle[:2].round(4))
    [0.5873 0.4982] [0.  0.1]
    """
    hoppers = Hoppers(geometry, half_angle, disturbances)
    start = neutral_delta(geometry, half_angle, 0.0, disturbances=disturbances)
    if largest_delta <= start:
        raise InvalidParameterError(
            f"largest_delta = {np.degrees(largest_delta):.6g} deg is out of range: the curve "
            f"starts at {np.degrees(start):.6g} deg"
        )
    points = [_point(hoppers, hoppers.at_wall(start, 0.0))]
    end = _follow_phi(hoppers, points, step, largest_delta)
    if end is None:
        end = _follow_arc(hoppers, points)
    return NeutralCurve(
        np.array([point.friction_angle for point in points]),
        np.array([point.delta for point in points]),
        tuple(point.result.governed_by for point in points),
        tuple(point.result.parity for point in points),
        end,
    )


def _point(hoppers: Hoppers, result: object) -> _Point:
    if not isinstance(result, LinearStability) or hoppers.last is None:
        raise ConvergenceError(f"neutral point lost: {result}")
    return _Point(hoppers.last, result)


def _follow_phi(
    hoppers: Hoppers, points: list[_Point], step: float, largest_delta: float
) -> CurveEnd | None:
    """Add points at growing phi; None if the fold is near."""
    current, slope = step, None
    while current > step / 20:
        last = points[-1]
        hoppers.last, phi = last.member, last.friction_angle + current
        at_wall = partial(hoppers.at_wall, friction_angle=phi)
        guess = _extrapolated([(point.friction_angle, point.delta) for point in points], phi)
        found, point = root_near(at_wall, guess, slope), None
        if found and found.at > phi:
            point = _point(hoppers, at_wall(found.at))
        if found is None or point is None or _at_fold(hoppers, point):
            current, slope = current / 2, None
            continue
        if point.delta > largest_delta:
            points.append(_at_delta(hoppers, largest_delta, last, phi))
            return "largest_delta"
        points.append(point)
        current, slope = min(2 * current, step), found.slope
    return None if hoppers.geometry == "cone" else "not_converged"


def _at_fold(hoppers: Hoppers, point: _Point) -> bool:
    """Whether what is neutral is the zero mode of a fold, as all that is real in a cone."""
    return hoppers.geometry == "cone" and point.result.governed_by == "real mode"


def _extrapolated(known: list[tuple[float, float]], x: float) -> float:
    """Return y at x of the polynomial through the last three (x, y), or as many as there are."""
    at = known[-3:]
    return sum(
        y * prod((x - other) / (here - other) for other, _ in at if other != here) for here, y in at
    )


def _at_delta(hoppers: Hoppers, delta: float, below: _Point, above: float) -> _Point:
    """Return the neutral point with a given delta, between two frictions."""

    def growth(phi: float) -> float:
        result = hoppers.at_wall(delta, phi)
        return result.abscissa if isinstance(result, LinearStability) else np.inf

    try:
        phi = root_between(growth, below.friction_angle, above, xtol=ROOT_TOLERANCE)
    except ValueError:  # no change of sign
        raise ConvergenceError(
            f"neutral point lost at delta = {np.degrees(delta):.6g} deg: give a smaller step"
        ) from None
    return _point(hoppers, hoppers.at_wall(delta, phi))


def _follow_arc(hoppers: Hoppers, points: list[_Point]) -> CurveEnd:
    """Add points along the arc of the curve up to the fold, and the corner there.

    Near the corner phi turns back, and in narrow cones so does tau.
    """
    step, slope = _ARC_STEP, None
    while step > _LEAST_STEP * _ARC_STEP:
        last = points[-1]
        hoppers.last = last.member
        along = last.place - points[-2].place if len(points) > 1 else np.array([0.0, 1.0])
        along /= np.hypot(*along)
        at = partial(_beside, hoppers, last.place + step * along, np.array([-along[1], along[0]]))
        found = root_near(at, 0.0, slope)
        # A root farther off than the step is long may lie behind.
        result = at(found.at) if found and abs(found.at) < step else None
        if found and isinstance(result, LinearStability):
            slope, point = found.slope, _point(hoppers, result)
            if point.member.psi_wall_by_tau > 0 and not _at_fold(hoppers, point):
                points.append(point)
                continue
        end = _corner(hoppers, last)
        if end and np.hypot(*(end.place - last.place)) < 2 * step:
            points.append(end)
            return "fold"
        step, slope = step / 2, None
    return "not_converged"


def _beside(hoppers: Hoppers, place: Array, normal: Array, distance: float) -> object:
    """Return the stability at a distance from a place, both in the unit of ``_Point.place``."""
    delta, log_tau = (place + distance * normal) * _UNIT
    return hoppers.with_tau(float(delta), exp(log_tau))


def _corner(hoppers: Hoppers, near: _Point) -> _Point | None:
    """Return the corner: a fold with no other growing mode, where the neutral curve arrives."""
    hoppers.last = near.member
    found = root(hoppers.at_fold, near.delta, tolerance=_CORNER_TOLERANCE)
    if found is None:
        return None
    hoppers.at_fold(found.at)
    return _point(hoppers, near.result)


@checked
def corner(curve: NeutralCurve) -> tuple[float, float] | None:
    """Return delta and phi (radians) of the corner that ends a neutral curve; None without one."""
    if curve.end != "fold":
        return None
    return float(curve.delta[-1]), float(curve.friction_angle[-1])
