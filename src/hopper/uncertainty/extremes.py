"""The least and the largest value of a number over a box.

Corners are not assumed: samples start a descent along the slopes, and what it finds is held against
its neighbourhood. Where the number does not exist, or has a kink, only comparisons are left:
a search by steps that shrink, along the axes and along random directions, as borders are oblique
[AD]_.

References
----------
.. [AD] C. Audet, J. E. Dennis, Mesh adaptive direct search algorithms for constrained optimization,
   SIAM J. Optim. 17 (2006).
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

import numpy as np
import scipy

from hopper.arguments import RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError

# Spread, relative to the values, of what is constant.
_CONSTANT = 1e-10
# Step for slopes, and the largest slope at an extreme; relative to the spread of the samples.
_STEP, _FLAT = 1e-5, 1e-4
# Curvature at an extreme inside, relative to the spread, that its slopes are divided by.
_CURVATURE = 0.05
# Two starts are this far apart at least, and not further in value, relative to the spread.
_APART, _NEAR = 0.3, 0.25
# Steps of the search by comparisons, and of the look around what slopes have found.
_FIRST, _LAST, _SHRINK, _AROUND = 2.0**-3, 2.0**-9, 0.25, 2.0**-5
_DESCENTS, _SEED = 30, 1


@dataclass(frozen=True)
class Extreme:
    """A least or largest value, how far the true one may be off, and where it is, shape (d,)."""

    value: float
    error: float
    at: Array

    __repr__ = brief("value", "error")


class _MissingError(Exception):
    """A slope is asked for where the number does not exist."""


@checked
def extremes(number: Callable[[Array], float], samples: RealLike) -> tuple[Extreme, Extreme] | None:
    """Return the least and the largest value over the unit box, None where there is no value.

    ``number`` takes a point, shape (d,), and is NaN where it does not exist; ``samples``, shape
    (n, d), are where the search begins.

    Raises
    ------
    InvalidParameterError
        If the samples have another shape.

    Examples
    --------
    >>> from hopper.uncertainty.extremes import extremes
    >>> low, high = extremes(lambda p: float((p[0] - 0.3) ** 2), [[0.0], [0.5], [1.0]])
    >>> round(low.value, 6), round(high.value, 6)
    (0.0, 0.49)
    """
    low, high = least(number, samples), least(lambda point: -number(point), samples)
    if low is None or high is None:
        return None
    return low, Extreme(-high.value, high.error, high.at)


@checked
def least(number: Callable[[Array], float], samples: RealLike) -> Extreme | None:
    """Return the least value alone, as :func:`extremes`."""
    points = np.asarray(samples, dtype=float)
    if points.ndim != 2 or not len(points):
        raise InvalidParameterError(
            f"samples have the shape {points.shape}: give (n, d), one at least"
        )
    values = np.array([number(point) for point in points])
    return _least(number, points, values) if np.isfinite(values).any() else None


def _least(number: Callable[[Array], float], points: Array, values: Array) -> Extreme:
    values = np.where(np.isfinite(values), values, np.inf)
    first = int(values.argmin())
    known = values[np.isfinite(values)]
    spread = float(np.ptp(known))
    whole = known.size == values.size
    if not points.shape[1] or (whole and spread <= _CONSTANT * float(np.abs(known).max())):
        return Extreme(float(values[first]), spread, points[first])
    far = np.abs(points - points[first]).max(axis=1) >= _APART
    second = int(np.where(far, values, np.inf).argmin())
    near = values[second] - values[first] <= _NEAR * spread
    starts = [first, second] if near and second != first else [first]
    scale = max(spread, _CONSTANT * float(np.abs(known).max())) or 1.0
    found = [_descended(_Scaled(number, scale), points[start]) for start in starts]
    best = min(found, key=lambda one: one.value)
    return Extreme(best.value * scale, best.error * scale, best.at)


class _Scaled:
    """A number in units of its spread, inf where it does not exist; the least one is kept."""

    def __init__(self, number: Callable[[Array], float], scale: float) -> None:
        self.number, self.scale = number, scale
        self.at, self.value = np.empty(0), np.inf
        self.known: dict[bytes, float] = {}

    def __call__(self, point: Array) -> float:
        if (key := point.tobytes()) in self.known:
            return self.known[key]
        found = self.number(point) / self.scale
        self.known[key] = value = found if isfinite(found) else np.inf
        if value < self.value or not self.at.size:
            self.at, self.value = point.copy(), value
        return value

    def slope(self, point: Array) -> Array:
        """Return the gradient by steps that stay inside the box."""
        here, found = self(point), np.empty(point.size)
        for i, place in enumerate(point):
            step = -_STEP if place > 0.5 else _STEP
            beside = point.copy()
            beside[i] += step
            found[i] = (self(beside) - here) / step
        if not np.isfinite(found).all():
            raise _MissingError
        return found


def _descended(number: _Scaled, start: Array) -> Extreme:
    def held(point: Array) -> float:
        value = number(point)
        if not isfinite(value):
            raise _MissingError
        return value

    left = np.inf
    try:
        scipy.optimize.minimize(
            held,
            start,
            jac=number.slope,
            method="L-BFGS-B",
            bounds=[(0, 1)] * start.size,
            options={"gtol": _FLAT / 10, "ftol": 1e-12, "maxiter": _DESCENTS},
        )
        left = _remaining(number.at, number.slope(number.at))
    except _MissingError:
        number(start)
    if left > _FLAT:
        return _by_comparisons(number, _FIRST, _LAST)
    best = number.value
    found = _by_comparisons(number, _AROUND, _AROUND)
    if best - found.value > _FLAT:  # another basin, or a kink
        return _by_comparisons(number, _AROUND, _LAST)
    return Extreme(found.value, min(left, left**2 / (2 * _CURVATURE)), found.at)


def _remaining(at: Array, slope: Array) -> float:
    """Return the slopes along which the value would fall inside the box, added up."""
    falls = np.where(slope > 0, at > 0, at < 1)
    return float(np.abs(slope[falls] * np.where(slope > 0, at, 1 - at)[falls]).sum())


def _by_comparisons(number: _Scaled, first: float, last: float) -> Extreme:
    random, step, values = np.random.default_rng(_SEED), first, [number.value]
    around: list[float] = []
    while step >= last:
        here, before, around = number.at, number.value, []
        for direction in _directions(here.size, random, oblique=first > last):
            around.append(number(np.clip(here + step * direction, 0, 1)) - before)
            if number.value < before:
                step = min(2 * step, first)
                break
        else:
            values.append(number.value)
            step *= _SHRINK
    # Next to a border values go as the square root of the step, which halves what is left; across
    # a kink they rise with it.
    rise = max((value for value in around if isfinite(value)), default=0.0)
    error = max(values[max(-len(values), -3)] - number.value, rise)
    return Extreme(number.value, error, number.at)


def _directions(size: int, random: np.random.Generator, *, oblique: bool) -> Array:
    axes = np.eye(size)
    if size > 1 and oblique:
        turned, _ = np.linalg.qr(random.standard_normal((size, size)))
        axes = np.concatenate([axes, turned])
    return np.concatenate([axes, -axes])
