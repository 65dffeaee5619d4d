"""Neutral points and stable intervals of internal friction, at one wall friction."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from math import degrees, radians
from typing import Literal

import numpy as np

from hopper.arguments import Positive, Radians, checked
from hopper.brief import brief
from hopper.domain.growth import COARSE, ROOT_TOLERANCE, Hoppers, Missing, root_near
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NoRadialSolutionError,
)
from hopper.problem import Geometry
from hopper.radial.friction_limit import End, friction_limit
from hopper.roots import root_between
from hopper.stability.modes import Disturbances, LinearStability
from hopper.values import require_angle

IntervalEnd = Literal[
    "neutral", End, "stress_not_positive", "not_converged", "steepest_looked_at", "tension"
]  # fmt: skip

# Of delta: step of the scan, and its largest value.
_STEP, _STEEPEST = radians(1), radians(89)
# Distance from an edge at which the abscissa is looked at.
_INSIDE = 1e-7
_LEAST_STEP = 1e-4


class NoNeutralPointError(HopperError):
    """At this wall friction no delta separates stable from unstable hoppers."""


@dataclass(frozen=True)
class StableInterval:
    """Hoppers with ``lower`` < delta < ``upper`` (radians) are stable, and what ends that.

    Ends are a neutral point; a limit of the family of radial solutions: fold, wall, interior or
    axis; stress that is not positive, or tensile; or where modes are no longer resolved or looked
    at.
    """

    lower: float
    upper: float
    lower_end: IntervalEnd
    upper_end: IntervalEnd

    __repr__ = brief("lower deg", "upper deg", "lower_end", "upper_end")


@dataclass(frozen=True)
class StableDeltas:
    """What is stable at one wall friction (radians): neutral deltas, and intervals of delta."""

    friction_angle: float
    neutral: tuple[float, ...]
    intervals: tuple[StableInterval, ...]

    __repr__ = brief("friction_angle deg", "neutral")


@dataclass(frozen=True)
class _Sample:
    """A delta with its spectral abscissa; at an edge also what ends the hoppers beyond it."""

    delta: float
    abscissa: float
    edge: IntervalEnd | None = None


@checked
def stable_deltas(
    geometry: Geometry,
    half_angle: Radians,
    friction_angle: Radians,
    disturbances: Disturbances | None = None,
    step: Positive = _STEP,
) -> StableDeltas:
    """Return all neutral deltas and stable intervals at one wall friction.

    Delta is scanned from phi to 89 deg. Two neutral points less than a step apart are found if the
    abscissa between its values there is a parabola.

    Parameters
    ----------
    geometry : "wedge" or "cone"
        Shape of the hopper.
    half_angle, friction_angle : float
        theta_w and phi, radians.
    disturbances : "symmetric" or "any", optional
        Default: any for wedges, symmetric for cones.
    step : float
        Of the scan, radians.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range, or asymmetric disturbances of a cone are asked for.
    NoRadialSolutionError
        If no hopper has a radial solution at this wall friction.

    Examples
    --------
    >>> from hopper import stable_deltas
    >>> [interval] = stable_deltas("cone", half_angle=0.2, friction_angle=0.2).intervals
    >>> round(interval.lower, 4), interval.lower_end, interval.upper_end
    (0.4567, 'neutral', 'steepest_looked_at')
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    if step < _LEAST_STEP:
        raise InvalidParameterError(
            f"step = {step:.3g} is too short: give {_LEAST_STEP:.0e} radians at least"
        )
    hoppers = Hoppers(geometry, half_angle, disturbances)
    neutral: list[float] = []
    intervals: list[StableInterval] = []
    runs = list(_runs(hoppers, friction_angle, step))
    if not runs:
        raise NoRadialSolutionError(
            f"no {geometry} of half angle {degrees(half_angle):.6g} deg has a resolved radial "
            f"solution at phi = {degrees(friction_angle):.6g} deg: "
            + ("lower the wall friction" if friction_angle else "narrow the hopper"),
            None,
        )
    for run in runs:
        marks = list(_marks(hoppers, friction_angle, run))
        neutral += [delta for delta, end in marks if end == "neutral"]
        for lower, upper in zip(marks[::2], marks[1::2], strict=True):
            intervals.append(StableInterval(lower[0], upper[0], lower[1], upper[1]))
    return StableDeltas(friction_angle, tuple(neutral), tuple(intervals))


def _marks(
    hoppers: Hoppers, friction_angle: float, run: list[_Sample]
) -> Iterator[tuple[float, IntervalEnd]]:
    """Yield the lower and upper ends of stable intervals in turn."""
    if run[0].abscissa < 0:
        yield run[0].delta, run[0].edge or "steepest_looked_at"
    for before, after in pairwise(run):
        if (before.abscissa < 0) != (after.abscissa < 0):
            yield _between(hoppers, friction_angle, before, after), "neutral"
    if run[-1].abscissa < 0:
        yield run[-1].delta, run[-1].edge or "steepest_looked_at"


@checked
def neutral_delta(
    geometry: Geometry,
    half_angle: Radians,
    friction_angle: Radians,
    guess: float | None = None,
    disturbances: Disturbances | None = None,
) -> float:
    """Return the least delta (radians) at which the spectral abscissa vanishes.

    Parameters
    ----------
    geometry : "wedge" or "cone"
        Shape of the hopper.
    half_angle, friction_angle : float
        theta_w and phi, radians.
    guess : float, optional
        A delta (radians) close to the answer, from a neighbour on the curve: the root near it.
    disturbances : "symmetric" or "any", optional
        Default: any for wedges, symmetric for cones.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    NoRadialSolutionError
        If no hopper has a radial solution at this wall friction.
    NoNeutralPointError
        If no delta separates unstable from stable hoppers at this friction.

    Examples
    --------
    >>> from hopper import neutral_delta
    >>> round(neutral_delta("cone", half_angle=0.2, friction_angle=0.2), 4)
    0.4567
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    if guess is not None:
        hoppers = Hoppers(geometry, half_angle, disturbances)
        found = root_near(partial(hoppers.at_wall, friction_angle=friction_angle), guess)
        if found is not None:
            return found.at
    known = stable_deltas(geometry, half_angle, friction_angle, disturbances)
    if not known.neutral:
        least = (
            f" from delta = {degrees(known.intervals[0].lower):.6g} deg" if known.intervals else ""
        )
        where = f"hoppers are stable{least}" if known.intervals else "no hopper is stable"
        raise NoNeutralPointError(
            f"no neutral delta at phi = {degrees(friction_angle):.6g} deg, half_angle = "
            f"{degrees(half_angle):.6g} deg: {where}; change the wall friction"
        )
    return known.neutral[0]


def _runs(hoppers: Hoppers, phi: float, step: float) -> Iterator[list[_Sample]]:
    """Yield runs of samples in which delta has a solution throughout, edges included."""
    deltas = np.append(np.arange(phi + step / 10, _STEEPEST, step), _STEEPEST)
    found = [(float(delta), hoppers.at_wall(float(delta), phi)) for delta in deltas]
    run: list[_Sample] = []
    for (left, before), (right, after) in pairwise([(phi, "no_wall_angle"), *found]):
        if isinstance(after, LinearStability):
            if not run and not isinstance(before, LinearStability):
                run = [_edge(hoppers, phi, right, left, before)]
            run.append(_Sample(right, after.abscissa))
        elif run:
            yield _with_extrema(hoppers, phi, [*run, _edge(hoppers, phi, left, right, after)])
            run = []
    if run:
        yield _with_extrema(hoppers, phi, run)


def _edge(hoppers: Hoppers, phi: float, inside: float, outside: float, reason: Missing) -> _Sample:
    """Return the last delta with a resolved solution between two, and its abscissa."""
    edge, label = None, None
    if reason in ("no_wall_angle", "no_radial_solution"):
        edge, label = _limit_between(hoppers, phi, inside, outside)
    elif reason == "non_positive_stress":
        edge, label = _without_stress(hoppers, phi, inside, outside), "stress_not_positive"
    if edge is not None:
        within = edge + np.sign(inside - edge) * _INSIDE
        result = hoppers.at_wall(within, phi)
        if isinstance(result, LinearStability):
            return _Sample(edge, result.abscissa, label)
    # Where modes cease to be resolved before: bisection, as nothing there is a root.
    result = hoppers.at_wall(inside, phi)
    while abs(inside - outside) > COARSE:
        middle = (inside + outside) / 2
        attempt = hoppers.at_wall(middle, phi)
        if isinstance(attempt, LinearStability):
            inside, result = middle, attempt
        else:
            outside = middle
    if not isinstance(result, LinearStability):
        raise ConvergenceError(f"hopper lost at delta = {degrees(inside):.6g} deg: {result}")
    return _Sample(inside, result.abscissa, "not_converged")


def _limit_between(
    hoppers: Hoppers, phi: float, inside: float, outside: float
) -> tuple[float | None, IntervalEnd | None]:
    """Return the delta whose limit of wall friction is phi, and what kind of limit it is."""

    def excess(delta: float) -> float:
        try:
            return friction_limit(hoppers.hopper(delta)).friction_angle - phi
        except NoRadialSolutionError:
            return -phi - 1.0

    try:
        if friction_limit(hoppers.hopper(inside)).end == "wall" and outside <= phi:
            return phi, "wall"
        delta = root_between(excess, inside, outside, xtol=ROOT_TOLERANCE)
        return delta, friction_limit(hoppers.hopper(delta)).end
    except (ConvergenceError, NoRadialSolutionError, ValueError):
        return None, None


def _without_stress(hoppers: Hoppers, phi: float, inside: float, outside: float) -> float | None:
    """Return the delta at which the stress on the axis passes through infinity: tau = 0."""

    def tau(delta: float) -> float:
        hoppers.at_wall(delta, phi)
        return hoppers.last.tau if hoppers.last else np.nan

    try:
        return root_between(tau, inside, outside, xtol=ROOT_TOLERANCE)
    except ValueError:
        return None


def _with_extrema(hoppers: Hoppers, phi: float, run: list[_Sample]) -> list[_Sample]:
    """Add the vertex of the parabola through three samples where it has the other sign."""
    found = [run[0]]
    for before, here, after in zip(run, run[1:], run[2:], strict=False):
        found.append(here)
        deltas = [one.delta for one in (before, here, after)]
        values = [one.abscissa for one in (before, here, after)]
        if not np.isfinite(values).all() or np.ptp(np.sign(values)):
            continue
        curvature, slope, _ = np.polyfit(np.subtract(deltas, here.delta), values, 2)
        vertex = here.delta - slope / (2 * curvature) if curvature else here.delta
        bottom = here.abscissa - slope**2 / (4 * curvature) if curvature else here.abscissa
        if bottom * here.abscissa < 0 and before.delta < vertex < after.delta:
            result = hoppers.at_wall(vertex, phi)
            if isinstance(result, LinearStability):
                found.append(_Sample(vertex, result.abscissa))
    return sorted([*found, *run[max(1, len(run) - 1) :]], key=lambda one: one.delta)


def _between(hoppers: Hoppers, phi: float, before: _Sample, after: _Sample) -> float:
    """Return the neutral delta between two samples of different sign."""

    def growth(delta: float) -> float:
        for one in (before, after):
            if delta == one.delta:
                return one.abscissa
        result = hoppers.at_wall(delta, phi)
        if isinstance(result, LinearStability):
            return result.abscissa
        raise ConvergenceError(f"neutral point not resolved near delta = {degrees(delta):.6g} deg")

    return root_between(growth, before.delta, after.delta, xtol=ROOT_TOLERANCE)
