"""The neutral curve of von Mises cones: sup Re(lambda) = 0 between unstable and stable delta.

At a given wall friction a hyperbolic flow is stable above a neutral delta, which lies between the
borders 35.26 and 60 deg of hyperbolic flow on the axis, or nowhere.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isnan, radians

import numpy as np
from scipy.optimize import brentq

from hopper.arguments import Positive, Radians, checked
from hopper.arrays import Array, Mask
from hopper.brief import brief
from hopper.errors import ConvergenceError, HopperError
from hopper.problem import Hopper
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.values import require_angle
from hopper.von_mises.characteristics import AXIS_HYPERBOLIC, TENSION
from hopper.von_mises.growth import Governor, Growth, growth, growth_of, resolved_growth
from hopper.von_mises.high_frequency import high_frequency
from hopper.von_mises.modes import SIZES, low_modes, modes_on
from hopper.yield_conditions import VON_MISES

# Radians. Points of a scan; distance from the borders, where the laws become singular; first and
# largest distance from a guess at which the other sign is looked for.
SCAN: tuple[float, ...] = tuple(
    AXIS_HYPERBOLIC + radians(step)
    for step in (0.02, 0.1, 0.4, 1.2, 2.5, 4.5, 7, 10, 14, 18, 21.5, 24.7)
)
_MARGIN = 1e-5
_FIRST_REACH, _LAST_REACH = 2e-4, 0.1
_ROOT_TOLERANCE = 1e-13
_DIFFERENCE = 1e-5
_SMALLEST_STEP = 1e-4
# Relative distance within which eigenvalues of two meshes are one mode, well resolved.
_SAME = 1e-8


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
    size : int
        Half nodes.
    """

    delta: float
    friction_angle: float
    error_estimate: float
    frequency: float
    settled: bool
    size: int

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
    """
    require_angle("half_angle", half_angle)
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    if guess is not None:
        require_angle("guess", guess)
    found = None if guess is None else _near(half_angle, friction_angle, guess, None)
    if found is not None:
        return found
    bracket = _scan(_quick(half_angle, friction_angle, None))
    return _located(half_angle, friction_angle, bracket) if bracket else None


def _near(
    half_angle: float, friction_angle: float, guess: float, size: int | None
) -> NeutralDelta | None:
    """Return the neutral point next to a guess, None if there is none or it is not resolved."""
    bracket = _around(_quick(half_angle, friction_angle, size), guess)
    return _located(half_angle, friction_angle, bracket) if bracket else None


def _quick(half_angle: float, friction_angle: float, size: int | None) -> Callable[[float], Growth]:
    def at(delta: float) -> Growth:
        return growth(_flow(half_angle, friction_angle, delta), first=size)

    return at


def _flow(half_angle: float, friction_angle: float, delta: float) -> RadialSolution:
    return solve_radial(Hopper("cone", delta, half_angle, VON_MISES), friction_angle)


def _around(at: Callable[[float], Growth], guess: float) -> tuple[float, float] | None:
    """Return a bracket next to a guess; the abscissa falls with delta."""
    low, high = AXIS_HYPERBOLIC + _MARGIN, TENSION - _MARGIN
    reach, there = _FIRST_REACH, guess
    try:
        here = at(guess).abscissa if low < guess < high else 0.0
        while here and reach < _LAST_REACH:
            there = guess + reach if here > 0 else guess - reach
            if not low < there < high:
                break
            if at(there).abscissa * here <= 0:
                return min(guess, there), max(guess, there)
            reach *= 4
    except HopperError:
        pass
    return None


def _scan(at: Callable[[float], Growth]) -> tuple[float, float] | None:
    """Return an unstable and a stable delta next to each other; None if there are none."""
    unstable = None
    for delta in SCAN:
        try:
            value = at(delta).abscissa
        except HopperError:
            continue
        if value > 0:
            unstable = delta
        elif unstable is not None:
            return unstable, delta
    return None


def _located(
    half_angle: float, friction_angle: float, bracket: tuple[float, float]
) -> NeutralDelta:
    """Find the root on one mesh, and again on finer ones where those show higher modes."""
    middle = _flow(half_angle, friction_angle, sum(bracket) / 2)
    size = low_modes(middle).size
    # One mesh further the errors of the low modes are rounding.
    size = SIZES[min(SIZES.index(size) + 1, len(SIZES) - 1)]
    at = _on_mesh(half_angle, friction_angle, size)
    while True:
        delta = _root(at, bracket)
        found = at(delta)
        flow = _flow(half_angle, friction_angle, delta)
        full = resolved_growth(flow, first=size)
        higher = full.abscissa - found.abscissa > full.error_estimate + found.error_estimate
        if not higher or full.modes.size == size:
            break
        size = _size_for(flow, full, size)
        at = _on_mesh(half_angle, friction_angle, size)
        wider = _around(at, delta)
        if wider is None:
            break
        bracket = wider
    slope = (at(delta + _DIFFERENCE).abscissa - at(delta - _DIFFERENCE).abscissa) / 2 / _DIFFERENCE
    error = found.error_estimate / abs(slope) + _ROOT_TOLERANCE
    settled = full.settled and not higher
    return NeutralDelta(delta, friction_angle, error, found.frequency, settled, size)


def _root(at: Callable[[float], Growth], bracket: tuple[float, float]) -> float:
    """Return the root in a bracket of another mesh; next to it where this one has none there."""
    if at(bracket[0]).abscissa * at(bracket[1]).abscissa > 0:
        near = _around(at, sum(bracket) / 2)
        if near is None:
            raise ConvergenceError(
                f"neutral point not resolved near delta = {np.degrees(bracket[0]):.6g} deg: two "
                "meshes differ on the modes there; change the wall friction"
            )
        bracket = near
    return float(brentq(lambda delta: at(delta).abscissa, *bracket, xtol=_ROOT_TOLERANCE))


def _size_for(flow: RadialSolution, full: Growth, size: int) -> int:
    """Return the first mesh beyond ``size`` that resolves the mode that governs ``full``."""
    governing = full.abscissa + 1j * full.frequency
    for finer in SIZES[SIZES.index(size) + 1 : SIZES.index(full.modes.size)]:
        modes = modes_on(flow, finer)
        good = modes.errors < _SAME * abs(governing)
        if np.any(good & (np.abs(modes.eigenvalues - governing) < _SAME * abs(governing))):
            return finer
    return full.modes.size


def _on_mesh(half_angle: float, friction_angle: float, size: int) -> Callable[[float], Growth]:
    """Return the growth over delta by one mesh, whose errors vary smoothly."""

    def at(delta: float) -> Growth:
        flow = _flow(half_angle, friction_angle, delta)
        return growth_of(modes_on(flow, size), high_frequency(flow))

    return at


@dataclass(frozen=True)
class NeutralBorder:
    """Points of the neutral curve from the smooth wall on, arrays of shape (n,).

    Attributes
    ----------
    friction_angle, delta, error_estimate : array
        phi, delta and its error, radians.
    frequency : array
        Im(lambda) of the neutral modes; NaN for the strip.
    settled : bool array
        Whether the test of resolution expects no mode above 0.
    """

    friction_angle: Array
    delta: Array
    error_estimate: Array
    frequency: Array
    settled: Mask

    __repr__ = brief("friction_angle deg", "delta deg", "settled")


@checked
def neutral_curve(
    half_angle: Radians, step: Positive, highest: Radians | None = None
) -> NeutralBorder:
    """Trace the neutral curve from phi = 0 to its end, by continuation in phi.

    It ends where no flow is stable, or none exists, or none is resolved; the last is found to
    1e-4 rad in phi.

    Parameters
    ----------
    half_angle : float
        theta_w, radians.
    step : float
        Largest step in phi, radians.
    highest : float, optional
        Friction angle (radians) at which to stop.

    Raises
    ------
    InvalidParameterError
        If an angle or the step is out of range.
    ConvergenceError
        If not even the smooth wall has a neutral delta.
    """
    if highest is not None:
        require_angle("highest", highest, zero_allowed=True)
    first = neutral_point(half_angle, 0.0)
    if first is None:
        raise ConvergenceError(
            f"no neutral delta at half_angle = {np.degrees(half_angle):.6g} deg even for a smooth "
            "wall: lower half_angle"
        )
    points, current, slope = [first], step, 0.0
    while current > _SMALLEST_STEP:
        last = points[-1]
        phi = last.friction_angle + current
        if highest is not None and phi > highest * (1 + 1e-12):
            break
        found = _following(half_angle, phi, last.delta + slope * current, last.size)
        if found is None:
            current /= 2
            continue
        slope = (found.delta - last.delta) / current
        points.append(found)
        current = min(2 * current, step)
    return NeutralBorder(
        *(np.array([getattr(p, name) for p in points]) for name in NeutralBorder.__annotations__)
    )


def _following(half_angle: float, phi: float, guess: float, size: int) -> NeutralDelta | None:
    try:
        return _near(half_angle, phi, guess, size)
    except HopperError:
        return None
