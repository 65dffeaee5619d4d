"""The neutral curve, which separates unstable from stable hoppers.

At a given wall friction a hopper is stable above a neutral delta.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees
from typing import Self

import numpy as np
from scipy.optimize import brentq

from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    TangencyError,
)
from hopper.problem import Geometry, Hopper, is_real, require_angle
from hopper.radial.solution import solve_radial
from hopper.stability.modes import linear_stability

# Root finding, in radians: well below 1e-6 degrees.
ROOT_TOLERANCE = 1e-10
_END_TOLERANCE = 3e-9
_SECANT_STEPS = 12
_PROBE = 1e-6
_SCAN = np.radians(np.arange(12.0, 76.0, 4.0))


class NoNeutralPointError(HopperError):
    """At this wall friction no delta separates stable from unstable hoppers."""


def neutral_delta(
    geometry: Geometry, half_angle: float, friction_angle: float, guess: float | None = None
) -> float:
    """Return the delta (radians) at which the spectral abscissa vanishes.

    Parameters
    ----------
    geometry : "wedge" or "cone"
        Shape of the hopper.
    half_angle, friction_angle : float
        theta_w and phi, radians.
    guess : float, optional
        A delta (radians) close to the answer, from a neighbour on the curve.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    NoNeutralPointError
        If no delta separates unstable from stable hoppers at this friction.
    """
    require_angle("half_angle", half_angle)
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    growth = _growth(geometry, half_angle, friction_angle)
    delta = _secant(growth, guess) if guess is not None else None
    if delta is not None:
        return delta
    bracket = _bracket(growth, friction_angle)
    if bracket is None:
        raise NoNeutralPointError(
            f"no neutral delta at phi = {degrees(friction_angle):.6g} deg, half_angle = "
            f"{degrees(half_angle):.6g} deg: stability ends at the tangency before it is lost; "
            "lower the wall friction"
        )
    return float(brentq(growth, *bracket, xtol=ROOT_TOLERANCE))


def _growth(
    geometry: Geometry, half_angle: float, friction_angle: float
) -> Callable[[float], float]:
    """Return the spectral abscissa as a function of delta."""

    def growth(delta: float) -> float:
        hopper = Hopper(geometry, delta, half_angle)
        return linear_stability(solve_radial(hopper, friction_angle)).abscissa

    return growth


def _secant(growth: Callable[[float], float], guess: float) -> float | None:
    """Converge from a guess to a zero, or give up.

    The second point lies on either side: close to the tangency only one of them has a verdict.
    """
    for side in (-_PROBE, _PROBE):
        try:
            before, at_before = guess + side, growth(guess + side)
            here, at_here = guess, growth(guess)
            for _ in range(_SECANT_STEPS):
                slope = (at_here - at_before) / (here - before)
                following = here - at_here / slope
                if abs(following - here) < ROOT_TOLERANCE:
                    return following
                before, at_before = here, at_here
                here, at_here = following, growth(following)
        except (HopperError, ZeroDivisionError):
            continue
    return None


def _bracket(growth: Callable[[float], float], friction_angle: float) -> tuple[float, float] | None:
    """Find an unstable and a stable delta next to each other; None if there are none."""

    def attempt(delta: float) -> float | None:
        try:
            return growth(delta)
        except (TangencyError, NonPositiveStressError, NoRadialSolutionError, ConvergenceError):
            return None

    lower, lower_value = friction_angle, None
    for delta in _SCAN[friction_angle < _SCAN]:
        value = attempt(delta)
        if value is not None and value < 0:
            break
        lower, lower_value = delta, value
    else:
        return None
    upper = float(delta)
    # Left of the domain where the linear problem is posed nothing is known: close in on its edge.
    while lower_value is None and upper - lower > 1e-9:
        middle = (lower + upper) / 2
        value = attempt(middle)
        if value is None:
            lower = middle
        elif value < 0:
            upper = middle
        else:
            lower, lower_value = middle, value
    return (float(lower), upper) if lower_value is not None else None


@dataclass(frozen=True)
class NeutralCurve:
    """Points of the neutral curve, from the smooth wall to the tangency; radians."""

    friction_angle: Array
    delta: Array

    __repr__ = brief("friction_angle deg", "delta deg")

    def thinned(self) -> Self:
        """Return every second point, and the last: for an error estimate."""
        index = np.append(np.arange(0, self.delta.size - 1, 2), self.delta.size - 1)
        return type(self)(self.friction_angle[index], self.delta[index])


def neutral_curve(geometry: Geometry, half_angle: float, step: float) -> NeutralCurve:
    """Trace the neutral curve from phi = 0 to where it meets the tangency, by continuation.

    Parameters
    ----------
    geometry : "wedge" or "cone"
        Shape of the hopper.
    half_angle : float
        theta_w, radians.
    step : float
        Largest step in phi, radians; steps shrink towards the end, which is found to 1e-6 degrees.

    Raises
    ------
    InvalidParameterError
        If the step is not a positive number.
    NoNeutralPointError
        If not even the smooth wall has a neutral delta.
    """
    if not (is_real(step) and 0 < step < np.inf):
        raise InvalidParameterError(f"step = {step!r} must be a positive number, in radians")
    phi, delta = [0.0], [neutral_delta(geometry, half_angle, 0.0)]
    current, slope = step, 0.0
    while current > _END_TOLERANCE:
        growth = _growth(geometry, half_angle, phi[-1] + current)
        found = _secant(growth, delta[-1] + slope * current)
        if found is None:
            current /= 2
            continue
        slope = (found - delta[-1]) / current
        phi.append(phi[-1] + current)
        delta.append(found)
        current = min(2 * current, step)
    return NeutralCurve(np.array(phi), np.array(delta))
