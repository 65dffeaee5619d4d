"""The domain of stability in the plane of internal and wall friction, and its borders.

At a given wall friction a hopper is stable above a neutral delta. Towards rougher walls the domain
ends where psi reaches pi/4 - delta/2 and a characteristic becomes tangent to the arcs r = const
(tangency); beyond that t = log r is not like time, and no verdict is given.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import atan, cos, degrees, pi, sin
from typing import Self

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hopper.chebyshev import Array
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    TangencyError,
)
from hopper.family import family, friction_limit, neighbour
from hopper.linearisation import tangency_angle
from hopper.problem import Geometry, Hopper, is_real, require_angle
from hopper.radial import solution_of, solve_radial
from hopper.radial_collocation import Closure, Member
from hopper.stability import stability

# Root finding, in radians: well below 1e-6 degrees.
ROOT_TOLERANCE = 1e-10
_END_TOLERANCE = 3e-9
_SECANT_STEPS = 12
_PROBE = 1e-6
_SCAN = np.radians(np.arange(12.0, 76.0, 4.0))


class NoNeutralPointError(HopperError):
    """At this wall friction no delta separates stable from unstable hoppers."""


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
        for member in family(hopper):
            # The nodes miss the largest psi by far less than this margin.
            if member.psi.max() >= 0.9 * psi and _largest_psi(member) >= psi:
                return _friction_between(below, member, psi) if below else None
            below = member
    except NoRadialSolutionError:
        pass
    return None


def _largest_psi(member: Member) -> float:
    return solution_of(member).psi_maximum()[1]


def _friction_between(below: Member, above: Member, psi: float) -> float | None:
    """Locate the level between two members; None beyond the fold or without positive stress."""
    law, delta = below.hopper.material, below.hopper.delta
    if below.psi_wall < psi <= above.psi_wall:
        at_wall = neighbour(below, Closure("psi_wall", psi))
        if _largest_psi(at_wall) <= psi + ROOT_TOLERANCE:
            return law.friction_angle(delta, psi) if at_wall.tau > 0 else None
    unknown = above.closure.unknown
    low, high = (float(getattr(member, unknown)) for member in (below, above))

    def excess(value: float) -> float:
        return _largest_psi(neighbour(below, Closure(unknown, value))) - psi

    # psi at the wall is at most the largest psi: no need to look beyond the level.
    high = min(high, psi) if unknown == "psi_wall" else high
    reached = neighbour(below, Closure(unknown, brentq(excess, low, high, xtol=1e-13, rtol=1e-13)))
    if reached.tau <= 0 or (unknown == "tau" and reached.psi_wall_by_tau <= 0):
        return None
    return law.friction_angle(delta, reached.psi_wall)


def tangency_friction(hopper: Hopper) -> float | None:
    """Return the wall friction angle (radians) at which psi first reaches pi/4 - delta/2.

    At the wall this is mu = sin(delta) cos(delta) / (1 + sin(delta)**2). None as
    :func:`friction_reaching`.
    """
    return friction_reaching(hopper, tangency_angle(hopper.delta))


def singular_velocity_friction(hopper: Hopper) -> float | None:
    """Return the wall friction angle (radians) at which psi reaches pi/4, None as above."""
    return friction_reaching(hopper, pi / 4)


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
        return stability(solve_radial(hopper, friction_angle)).abscissa

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


def tangency_curve(geometry: Geometry, half_angle: float, deltas: ArrayLike) -> Array:
    """Return the tangency friction angle (radians) over ``deltas``, NaN where there is none."""
    found = [
        tangency_friction(Hopper(geometry, float(delta), half_angle))
        for delta in np.asarray(deltas, dtype=float)
    ]
    return np.array([np.nan if phi is None else phi for phi in found])


def stable_area(curve: NeutralCurve, deltas: ArrayLike, tangency: ArrayLike) -> float:
    """Return the area (radians squared) between the neutral curve and the tangency.

    ``deltas`` and ``tangency`` trace the tangency from the end of the neutral curve to the largest
    delta considered, which closes the domain together with phi = 0. Where the tangency is NaN not
    even the smooth wall belongs to the domain.

    Raises
    ------
    InvalidParameterError
        If the tangency is NaN everywhere.
    """
    known = np.isfinite(np.asarray(tangency, dtype=float))
    if not known.any():
        raise InvalidParameterError("tangency is NaN at every delta: there is no stable domain")
    delta = np.asarray(deltas, dtype=float)[known]
    phi = np.asarray(tangency, dtype=float)[known]
    x = np.concatenate([curve.delta, delta, delta[-1:], curve.delta[:1]])
    y = np.concatenate([curve.friction_angle, phi, [0.0], [0.0]])
    return float(abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2)


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
    """

    delta: Array
    limit: Array
    limit_error: Array
    end: tuple[str, ...]
    tangency: Array
    singular_velocity: Array


def borders(geometry: Geometry, half_angle: float, deltas: ArrayLike) -> Borders:
    """Return the borders of what is known about a hopper's stability over ``deltas`` (radians).

    Raises
    ------
    ConvergenceError
        If a radial solution on a border is not resolved.
    """
    delta = np.asarray(deltas, dtype=float)
    table = np.full((4, delta.size), np.nan)
    ends = []
    for i, value in enumerate(delta):
        hopper = Hopper(geometry, float(value), half_angle)
        try:
            limit = friction_limit(hopper)
        except NoRadialSolutionError:
            ends.append("none")
            continue
        ends.append(limit.end)
        levels = tangency_friction(hopper), singular_velocity_friction(hopper)
        table[:, i] = (
            limit.friction_angle,
            limit.error_estimate,
            *(np.nan if phi is None else phi for phi in levels),
        )
    return Borders(delta, table[0], table[1], tuple(ends), table[2], table[3])


def wall_tangency_friction(delta: float) -> float:
    """Return the friction angle (radians) of the wall on which psi_w = pi/4 - delta/2."""
    return atan(sin(delta) * cos(delta) / (1 + sin(delta) ** 2))
