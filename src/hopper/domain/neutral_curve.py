"""The neutral curve, which separates unstable from stable hoppers.

It begins on the smooth wall. In cones that have a fold it ends on the fold in a *corner* of the
stable domain: there two modes vanish together, as the pair that was neutral becomes real and one
mode is zero at every fold. Elsewhere it runs on below the limit of wall friction as far as one
looks.
"""

from dataclasses import dataclass
from functools import partial
from math import exp, log
from typing import Literal, Self, get_args

import numpy as np
from scipy.optimize import brentq

from hopper.arrays import Array
from hopper.brief import brief
from hopper.domain.growth import ROOT_TOLERANCE, Hoppers, Missing, root, root_near
from hopper.domain.neutral_points import neutral_delta
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.problem import Geometry, is_real
from hopper.radial.collocation import Member
from hopper.stability.collocation import Parity
from hopper.stability.modes import Disturbances, Governor, LinearStability

CurveEnd = Literal["fold", "largest_delta", "not_converged"]
CURVE_ENDS: tuple[CurveEnd, ...] = get_args(CurveEnd)

# Smallest step, relative to the largest, and the largest in log(tau).
_LEAST_STEP = 1e-3
_TAU_STEP = 0.05
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
    delta: float
    member: Member
    result: LinearStability

    @property
    def friction_angle(self) -> float:
        return self.member.hopper.material.friction_angle(self.delta, self.member.psi_wall)

    @property
    def log_tau(self) -> float:
        return log(self.member.tau)


def neutral_curve(
    geometry: Geometry,
    half_angle: float,
    step: float,
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
    """
    if not (is_real(step) and 0 < step < np.inf):
        raise InvalidParameterError(f"step = {step!r} must be a positive number, in radians")
    hoppers = Hoppers(geometry, half_angle, disturbances)
    start = neutral_delta(geometry, half_angle, 0.0, disturbances=disturbances)
    points = [_at(hoppers, start, 0.0)]
    end = _follow_phi(hoppers, points, step, largest_delta)
    if end is None:
        end = _follow_tau(hoppers, points)
    return NeutralCurve(
        np.array([point.friction_angle for point in points]),
        np.array([point.delta for point in points]),
        tuple(point.result.governed_by for point in points),
        tuple(point.result.parity for point in points),
        end,
    )


def _at(hoppers: Hoppers, delta: float, friction_angle: float) -> _Point:
    return _point(hoppers, delta, hoppers.at_wall(delta, friction_angle))


def _point(hoppers: Hoppers, delta: float, result: LinearStability | Missing) -> _Point:
    if not isinstance(result, LinearStability) or hoppers.last is None:
        raise ConvergenceError(f"neutral point lost at delta = {np.degrees(delta):.6g} deg")
    return _Point(delta, hoppers.last, result)


def _follow_phi(
    hoppers: Hoppers, points: list[_Point], step: float, largest_delta: float
) -> CurveEnd | None:
    """Add points at growing phi; None if the fold is near."""
    current = step
    while current > _LEAST_STEP * step:
        last = points[-1]
        hoppers.last, phi = last.member, last.friction_angle + current
        delta = root_near(partial(hoppers.at_wall, friction_angle=phi), _extrapolated(points, phi))
        point = _at(hoppers, delta, phi) if delta is not None and delta > phi else None
        # What is neutral in a cone and real is the zero mode of a fold.
        if point is None or (hoppers.geometry, point.result.governed_by) == ("cone", "real mode"):
            current /= 2
            continue
        if point.delta > largest_delta:
            points.append(_at_delta(hoppers, largest_delta, last, phi))
            return "largest_delta"
        points.append(point)
        current = min(2 * current, step)
    return None if hoppers.geometry == "cone" else "not_converged"


def _extrapolated(points: list[_Point], phi: float) -> float:
    if len(points) == 1:
        return points[-1].delta
    before, last = points[-2:]
    slope = (last.delta - before.delta) / (last.friction_angle - before.friction_angle)
    return last.delta + slope * (phi - last.friction_angle)


def _at_delta(hoppers: Hoppers, delta: float, below: _Point, above: float) -> _Point:
    """Return the neutral point with a given delta, between two frictions."""

    def growth(phi: float) -> float:
        result = hoppers.at_wall(delta, phi)
        return result.abscissa if isinstance(result, LinearStability) else np.inf

    phi = brentq(growth, below.friction_angle, above, xtol=ROOT_TOLERANCE)
    return _at(hoppers, delta, phi)


def _follow_tau(hoppers: Hoppers, points: list[_Point]) -> CurveEnd:
    """Add points at growing tau up to the fold, and the corner there."""
    step = _TAU_STEP
    while step > _LEAST_STEP * _TAU_STEP:
        last = points[-1]
        hoppers.last, log_tau = last.member, last.log_tau + step
        slope = 0.0
        if len(points) > 1:
            slope = (last.delta - points[-2].delta) / (last.log_tau - points[-2].log_tau)
        at_tau = partial(hoppers.with_tau, tau=exp(log_tau))
        delta = root_near(at_tau, last.delta + slope * step)
        if delta is None:
            step /= 2
            continue
        point = _point(hoppers, delta, at_tau(delta))
        if point.member.psi_wall_by_tau <= 0:
            break
        points.append(point)
    try:
        points.append(_corner(hoppers, points[-1]))
    except ConvergenceError:
        return "not_converged"
    return "fold"


def _corner(hoppers: Hoppers, near: _Point) -> _Point:
    """Return the corner: a fold with no other growing mode, where the neutral curve arrives."""
    hoppers.last = near.member
    delta = root(hoppers.at_fold, near.delta, _CORNER_TOLERANCE)
    if delta is None:
        raise ConvergenceError(f"corner not resolved near delta = {np.degrees(near.delta):.6g} deg")
    hoppers.at_fold(delta)
    return _point(hoppers, delta, near.result)


def corner(curve: NeutralCurve) -> tuple[float, float] | None:
    """Return delta and phi (radians) of the corner that ends a neutral curve; None without one."""
    if curve.end != "fold":
        return None
    return float(curve.delta[-1]), float(curve.friction_angle[-1])
