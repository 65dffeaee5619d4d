"""The neutral curve of von Mises cones: sup Re(lambda) = 0 between unstable and stable delta.

At a given wall friction a hyperbolic flow is stable above a neutral delta, which lies between the
borders 35.26 and 60 deg of hyperbolic flow on the axis, or nowhere. It is the largest of the deltas
at which a mode or the upper strip is neutral: one of them is followed to its own, and where others
are then above 0, the highest of these, until none is.
"""

from dataclasses import dataclass
from math import isnan, radians

import numpy as np

from hopper.arguments import Radians, checked
from hopper.brief import brief
from hopper.errors import ConvergenceError, HopperError
from hopper.problem import Hopper
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.values import require_angle
from hopper.von_mises.characteristics import AXIS_HYPERBOLIC, TENSION
from hopper.von_mises.following import MARGIN, Followed, governing, neutral_from
from hopper.von_mises.growth import Governor, Growth, growth, resolved_growth
from hopper.von_mises.modes import SIZES
from hopper.yield_conditions import VON_MISES

# Points of a scan, radians.
SCAN: tuple[float, ...] = tuple(
    AXIS_HYPERBOLIC + radians(step)
    for step in (0.02, 0.1, 0.4, 1.2, 2.5, 4.5, 7, 10, 14, 18, 21.5, 24.7)
)
# Radians: largest distance from a guess, width of the bracket in which a mode is followed, and the
# least one.
_REACH, _NARROW, _NARROWEST = 0.1, 0.02, 1e-7
# Relative distance within which eigenvalues are one mode.
_SAME = 1e-5
_CHANGES = 20


@dataclass(frozen=True)
class NeutralDelta:
    """A delta at which sup Re(lambda) = 0; angles in radians.

    Attributes
    ----------
    delta, friction_angle : float
    error_estimate : float
        Of delta.
    frequency : float
        Im(lambda) of the neutral mode; NaN where the strip of high frequency is neutral.
    settled : bool
        Whether the test of resolution expects no mode above 0 here.
    """

    delta: float
    friction_angle: float
    error_estimate: float
    frequency: float
    settled: bool

    __repr__ = brief("delta deg", "friction_angle deg", "error_estimate deg", "frequency")

    @property
    def governed_by(self) -> Governor:
        """Whether a mode or the strip is neutral."""
        return "strip" if isnan(self.frequency) else "mode"


@checked
def neutral_point(
    half_angle: Radians, friction_angle: Radians, guess: Radians | None = None
) -> NeutralDelta | None:
    """Return the neutral delta at a given wall friction, None if there is none.

    Parameters
    ----------
    half_angle, friction_angle : float
        theta_w and phi, radians.
    guess : float, optional
        A delta (radians) close to the answer.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    ConvergenceError
        If the modes next to the neutral point are not resolved.

    Examples
    --------
    >>> from hopper.von_mises.neutral import neutral_point
    >>> round(neutral_point(half_angle=0.2, friction_angle=0.15).delta, 4)
    0.7381
    """
    require_angle("half_angle", half_angle)
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    if guess is not None:
        require_angle("guess", guess)
    found = None if guess is None else _near(half_angle, friction_angle, guess)
    found = found or neutral_flow(half_angle, friction_angle)
    return found.point if found else None


@dataclass(frozen=True)
class NeutralFlow:
    """A neutral point with what is neutral there.

    Attributes
    ----------
    point : NeutralDelta
    governor : Followed
        The mode or strip, at the neutral flow.
    slope : float
        d Re(lambda) / d delta of it, 1/radians.
    growth : Growth
        What the test of resolution found there.
    changed : bool
        Whether the mode that was followed here is not the one that governs.
    """

    point: NeutralDelta
    governor: Followed
    slope: float
    growth: Growth
    changed: bool

    __repr__ = brief("point", "changed")


@checked
def neutral_flow(half_angle: Radians, friction_angle: Radians) -> NeutralFlow | None:
    """Return the neutral flow at a wall friction by a scan of delta, None if there is none.

    Raises as :func:`neutral_point`.
    """
    require_angle("half_angle", half_angle)
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    bracket = _scan(half_angle, friction_angle)
    if bracket is None:
        return None
    low, high = bracket
    while True:
        if high - low < _NARROW:
            try:
                found = _followed_from(half_angle, friction_angle, low)
                if found.point.delta < high:
                    return found
            except HopperError:
                if high - low < _NARROWEST:
                    raise
        middle = (low + high) / 2
        if high - low < _NARROWEST:
            raise ConvergenceError(
                f"neutral point not resolved near delta = {np.degrees(middle):.6g} deg; change the "
                "wall friction"
            )
        unstable = growth(_flow(half_angle, friction_angle, middle)).abscissa > 0
        low, high = (middle, high) if unstable else (low, middle)


def _near(half_angle: float, friction_angle: float, guess: float) -> NeutralFlow | None:
    """Return the neutral flow next to a guess, None if there is none or it is not resolved."""
    if not AXIS_HYPERBOLIC + MARGIN < guess < TENSION - MARGIN:
        return None
    try:
        found = _followed_from(half_angle, friction_angle, guess)
    except HopperError:
        return None
    return found if abs(found.point.delta - guess) < _REACH else None


def _followed_from(half_angle: float, friction_angle: float, delta: float) -> NeutralFlow:
    """Return the neutral flow that what governs at a delta leads to."""
    start = _flow(half_angle, friction_angle, delta)
    return followed_up(governing(growth(start), start), friction_angle, delta)


def _flow(half_angle: float, friction_angle: float, delta: float) -> RadialSolution:
    return solve_radial(Hopper("cone", delta, half_angle, VON_MISES), friction_angle)


def _scan(half_angle: float, friction_angle: float) -> tuple[float, float] | None:
    """Return an unstable and a stable delta next to each other; None if there are none."""
    unstable = None
    for delta in SCAN:
        try:
            value = growth(_flow(half_angle, friction_angle, delta)).abscissa
        except HopperError:
            continue
        if value > 0:
            unstable = delta
        elif unstable is not None:
            return unstable, delta
    return None


@checked
def followed_up(
    start: Followed,
    friction_angle: Radians,
    delta: Radians,
    slope: float | None = None,
    first: int | None = None,
) -> NeutralFlow:
    """Follow a mode to where it is neutral, and from there those that are above 0.

    Parameters
    ----------
    start : Followed
        Of a cone close by.
    friction_angle, delta : float
        phi, and a guess of the neutral delta, radians.
    slope : float, optional
        A guess of d Re(lambda) / d delta.
    first : int, optional
        Size in ``SIZES`` with which the test of resolution begins.

    Raises
    ------
    ConvergenceError
        If a mode is lost or the modes are not resolved.
    HopperError
        As :func:`hopper.von_mises.following.flow_at`.
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    require_angle("delta", delta)
    for changes in range(_CHANGES):
        found, slope, error = _neutral(start, friction_angle, delta, slope)
        delta = found.flow.hopper.delta
        full = resolved_near(found.flow, first)
        if not exceeded(found, full):
            frequency = found.value.imag
            point = NeutralDelta(delta, friction_angle, error, frequency, full.settled)
            return NeutralFlow(point, found, slope, full, changes > 0)
        start, slope, first = governing(full, found.flow), None, full.modes.size
    raise ConvergenceError(
        f"neutral point not resolved near delta = {np.degrees(delta):.6g} deg: modes take turns; "
        "change the wall friction"
    )


def _neutral(
    start: Followed, friction_angle: float, delta: float, slope: float | None
) -> tuple[Followed, float, float]:
    """Return a mode where it is neutral on a mesh fine enough, its slope, and delta's error."""
    found, slope, step = neutral_from(start, friction_angle, delta, slope)
    sure = found.resolved()
    while sure.size != found.size:
        found, slope, step = neutral_from(sure, friction_angle, sure.flow.hopper.delta, slope)
        sure = found.resolved()
    found = sure
    return found, slope, found.error / abs(slope) + step


@checked
def exceeded(found: Followed, full: Growth) -> bool:
    """Whether another mode than the followed one, or the strip, lies above it."""
    other = complex(full.abscissa, full.frequency)
    if abs(other - found.value) < _SAME * abs(other):
        return False
    return other.real > found.value.real + found.error + full.error_estimate


@checked
def resolved_near(flow: RadialSolution, first: int | None) -> Growth:
    """Return the supremum as :func:`resolved_growth`, beginning with a mesh that suits a neighbour.

    Rounding of the finest meshes may hide the low modes.

    Raises
    ------
    ConvergenceError
        As :func:`resolved_growth`.
    """
    try:
        return resolved_growth(flow, first=first)
    except ConvergenceError:
        if first is None:
            raise
        return resolved_growth(flow)


@checked
def first_size(found: Growth) -> int:
    """Return the size with which the test of resolution of a neighbour is to begin."""
    return SIZES[max(SIZES.index(found.modes.size) - 1, 1)]
