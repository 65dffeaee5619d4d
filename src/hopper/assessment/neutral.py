"""What is stable at one wall friction: neutral points and stable intervals, in numbers."""

from dataclasses import dataclass
from math import inf, radians

from hopper.arguments import Radians, checked
from hopper.assessment.propagation import ROUNDING
from hopper.assessment.stability import abscissa_with_error
from hopper.brief import brief
from hopper.domain.growth import COARSE, ROOT_TOLERANCE
from hopper.domain.neutral_points import IntervalEnd, StableInterval, stable_deltas
from hopper.errors import HopperError
from hopper.problem import Geometry, Hopper
from hopper.quantity import Quantity
from hopper.radial.friction_limit import friction_limit
from hopper.radial.solution import solve_radial
from hopper.stability.collocation import Parity
from hopper.stability.modes import Disturbances, Governor, linear_stability

# Step in delta for a slope, radians.
_STEP = 1e-6


@dataclass(frozen=True)
class NeutralPoint:
    """A delta (radians) at which the spectral abscissa vanishes, and what is neutral there."""

    delta: Quantity
    governed_by: Governor
    parity: Parity | None

    __repr__ = brief("delta deg", "governed_by", "parity")


@dataclass(frozen=True)
class Interval:
    """Hoppers with a delta (radians) between the two are stable; what ends that on each side."""

    lower: Quantity
    upper: Quantity
    lower_end: IntervalEnd
    upper_end: IntervalEnd

    __repr__ = brief("lower deg", "upper deg", "lower_end", "upper_end")


@dataclass(frozen=True)
class NeutralAssessment:
    """All neutral points and stable intervals of delta at one wall friction, in increasing order.

    ``intervals`` that two neutral points bound have them as ends.
    """

    points: tuple[NeutralPoint, ...]
    intervals: tuple[Interval, ...]

    __repr__ = brief("delta deg")

    @property
    def delta(self) -> Quantity | None:
        """The first neutral delta, None without one."""
        return self.points[0].delta if self.points else None


@checked
def assess_neutral(
    geometry: Geometry,
    half_angle: Radians,
    friction_angle: Radians,
    disturbances: Disturbances | None = None,
) -> NeutralAssessment:
    """Return what is stable of all Mohr-Coulomb hoppers with one wall; angles in radians.

    ``disturbances`` as in :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range, or asymmetric disturbances of a cone are asked for.
    NoRadialSolutionError
        If no hopper has a radial solution with this wall.
    """
    found = stable_deltas(geometry, half_angle, friction_angle, disturbances)

    def neutral(delta: float) -> NeutralPoint:
        at, beyond = (
            solve_radial(Hopper(geometry, angle, half_angle), friction_angle)
            for angle in (delta, delta + _STEP)
        )
        result, abscissa = abscissa_with_error(at, disturbances)
        slope = (linear_stability(beyond, disturbances).abscissa - abscissa.value) / _STEP
        error = (abs(abscissa.value) + abscissa.error) / abs(slope) + ROOT_TOLERANCE
        return NeutralPoint(Quantity(delta, error), result.governed_by, result.parity)

    def end(delta: float, kind: IntervalEnd) -> Quantity:
        if kind == "neutral":
            return next(point.delta for point in points if point.delta.value == delta)
        return Quantity(delta, _error_of_end(Hopper(geometry, delta, half_angle), kind))

    def quantified(one: StableInterval) -> Interval:
        lower, upper = end(one.lower, one.lower_end), end(one.upper, one.upper_end)
        return Interval(lower, upper, one.lower_end, one.upper_end)

    points = tuple(neutral(delta) for delta in found.neutral)
    return NeutralAssessment(points, tuple(quantified(one) for one in found.intervals))


def _error_of_end(hopper: Hopper, kind: IntervalEnd) -> float:
    """Return the error (radians) of the delta at which a stable interval ends but at a root."""
    if kind == "not_converged":
        return COARSE
    if kind not in ("fold", "interior", "axis"):
        return ROOT_TOLERANCE + ROUNDING
    try:
        limit, beyond = (
            friction_limit(Hopper(hopper.geometry, delta, hopper.half_angle))
            for delta in (hopper.delta, hopper.delta + _STEP)
        )
    except HopperError:
        return radians(1)
    slope = abs(beyond.friction_angle - limit.friction_angle) / _STEP
    return ROOT_TOLERANCE + (limit.error_estimate / slope if slope else inf)
