"""Breakdown of short waves in wedges, by geometric optics.

A short wave runs along the radial field's characteristics, loop after loop. Its K = a0 w_y is
continuous at walls and obeys the Riccati equation

    dK/dtau = m K + b K**2,    m = dG/dW - (da/dW) W0_y,    b = -(da/dW) / a > 0

so it breaks where K(0) times the integral of b exp(integral of m) reaches 1. In cones waves are
focused on the axis, which shifts their phase: steepening of successive loops does not add up.
"""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.march.base import Base, base_state
from hopper.march.equations import psi_factor
from hopper.march.tops import Top, riemann_deviation
from hopper.stability.asymptotic_line import asymptotic_line

# Cells of a leg, for integrals by the trapezoidal rule to 1e-6.
_CELLS = 4000
# Part of the slope that short waves need to break, below which they count as calm.
_CALM = 0.5
# Growth over a leg that counts as none.
_NEUTRAL = 1e-12


@dataclass(frozen=True)
class ShortWaves:
    """Means over a loop: growth rate m = Lambda, loop time (both in tau), and steepening b."""

    growth: float
    loop_time: float
    steepening: float

    __repr__ = brief("growth", "loop_time", "steepening")


@dataclass(frozen=True, eq=False)
class _Rates:
    """d tau/dy, m and b at points of a leg."""

    time: Array
    growth: Array
    steepening: Array


@dataclass(frozen=True, eq=False)
class _Course:
    """Integrals along a leg, shape (n,), and K of the top on its legs, (legs, n).

    ``exponent`` is the integral of m over tau, ``through`` that of b exp(exponent).
    """

    tau: Array
    exponent: Array
    through: Array
    initial: Array


@checked
def short_waves(base: Base) -> ShortWaves:
    """Return the mean growth and steepening of short waves.

    Raises
    ------
    InvalidParameterError
        If the hopper is a cone.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.march.base import base_of
    >>> from hopper.march.optics import short_waves
    >>> solution = solve_radial(Hopper("wedge", delta=0.7, half_angle=0.2), friction_angle=0.2)
    >>> round(short_waves(base_of(solution)).loop_time, 4)
    0.1916
    """
    y = _leg(base)
    rates = _rates(base, y)
    loop_time = float(np.trapezoid(rates.time, y))
    return ShortWaves(
        growth=float(np.trapezoid(rates.growth * rates.time, y)) / loop_time,
        loop_time=loop_time,
        steepening=float(np.trapezoid(rates.steepening * rates.time, y)) / loop_time,
    )


@checked
def calm_slope(base: Base) -> float:
    """Return a K = a w_y below which waves are far from steepening more than they decay.

    Half of -Lambda / b, loop means; 0 where short waves grow. In cones, whose waves break at larger
    slopes than those of wedges, it is a bound too.
    """
    growth = asymptotic_line(base.solution).abscissa
    # An even number of points: none on the axis.
    y = np.linspace(-1, 1, _CELLS) * base.hopper.half_angle
    rates = _rates(base, y)
    steepening = float(np.sum(rates.steepening * rates.time) / np.sum(rates.time))
    return max(0.0, -_CALM * growth / steepening)


@checked
def threshold_factor(base: Base, top: Top) -> float:
    """Return by what the slopes of a top in a wedge are to be multiplied to be about to break.

    0 where short waves do not decay, so that all break in the end; inf if none rises.

    Raises
    ------
    InvalidParameterError
        If the hopper is a cone.
    """
    course = _course(base, top)
    if course.exponent[-1] >= 0:
        return 0.0
    # All that is left to pass from the start of the leg on.
    ahead = -course.through[-1] / np.expm1(course.exponent[-1]) - course.through
    largest = float((course.initial * ahead / np.exp(course.exponent)).max())
    return 1 / largest if largest > 0 else np.inf


@checked
def estimated_breakdown(base: Base, top: Top) -> float | None:
    """Return the estimate of the tau at which a top breaks in a wedge; None if it never does.

    Raises
    ------
    InvalidParameterError
        If the hopper is a cone.
    """
    course = _course(base, top)
    rising = course.initial > 0
    start = np.broadcast_to(np.arange(course.tau.size), rising.shape)[rising]
    exponent = float(course.exponent[-1])
    # What the integral from the start of the leg on must reach, leg by leg.
    needed = course.through[start] + np.exp(course.exponent[start]) / course.initial[rising]
    whole = needed / course.through[-1]
    reached = 1 + whole * np.expm1(exponent) > 0
    if not reached.any():
        return None
    start, needed, whole = start[reached], needed[reached], whole[reached]
    if abs(exponent) < _NEUTRAL:
        legs = passed = np.floor(whole)
    else:
        legs = np.floor(np.log1p(whole * np.expm1(exponent)) / exponent)
        passed = np.expm1(legs * exponent) / np.expm1(exponent)
    rest = (needed - passed * course.through[-1]) / np.exp(legs * exponent)
    tau = legs * course.tau[-1] + np.interp(rest, course.through, course.tau) - course.tau[start]
    return float(tau.min())


def _leg(base: Base) -> Array:
    if base.hopper.curvature:
        raise InvalidParameterError(
            "geometric optics of a cone has no limit of this kind: waves are focused on its axis; "
            "use geometry = wedge"
        )
    return np.linspace(-1, 1, _CELLS + 1) * base.hopper.half_angle


def _rates(base: Base, y: Array) -> _Rates:
    state = base_state(base, y)
    at, light, t = state.at, state.light, np.tan(state.psi)
    speed, source = state.a / state.d, state.numerator / state.d
    t_by_w = psi_factor(base.hopper) * (1 + t**2)
    speed_by_w = -(at.sin_eta + speed * at.d1) / state.d * t_by_w
    source_by_w = (
        (at.n1 + light * at.l1 - source * at.d1) * t_by_w - 0.5 * light * (at.l0 + at.l1 * t)
    ) / state.d
    return _Rates(
        time=1 / speed,
        growth=source_by_w - speed_by_w * source / speed,
        steepening=-speed_by_w / speed,
    )


def _course(base: Base, top: Top) -> _Course:
    y = _leg(base)
    rates = _rates(base, y)
    exponent = _integral(rates.growth * rates.time, y)
    w = riemann_deviation(base, top, y / base.hopper.half_angle)
    legs = np.stack([w[0], w[1, ::-1]])[: 1 if top.symmetric else 2]
    return _Course(
        tau=_integral(rates.time, y),
        exponent=exponent,
        through=_integral(rates.steepening * np.exp(exponent) * rates.time, y),
        # A constant subtracted first leaves no rounding where there is no slope.
        initial=np.gradient(legs - legs[:, :1], y, axis=1, edge_order=2) / rates.time,
    )


def _integral(values: Array, y: Array) -> Array:
    """Return the integral from the first of the points y on, shape (n,)."""
    cells = 0.5 * (values[1:] + values[:-1]) * np.diff(y)
    return np.concatenate([[0.0], np.cumsum(cells)])
