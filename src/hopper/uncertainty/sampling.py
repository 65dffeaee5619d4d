"""Shares of a box and probabilities by quasi Monte Carlo, with errors of their own.

Points are Sobol's, scrambled at random: every scrambling gives an unbiased share, and how far those
of independent scramblings scatter is its error [OW]_.

References
----------
.. [OW] A. B. Owen, Monte Carlo theory, methods and examples (2013), ch. 17.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np
import scipy

from hopper.arguments import RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError

# Independent scramblings (shifts), and bits of the points.
SHIFTS, _BITS, _SEED = 8, 30, 20001114
# Chance that the truth lies within an error.
_CONFIDENCE = 0.95


@dataclass(frozen=True)
class Share:
    """A share from 0 to 1, and its error: in 95 of 100 cases the true share is within it."""

    value: float
    error: float

    __repr__ = brief("value", "error")


@checked
def points_in_box(dimensions: int, power: int) -> Array:
    """Return points of the unit box, shape (SHIFTS, 2 ** power, dimensions), the same each time.

    Raises
    ------
    InvalidParameterError
        If there is no dimension, or ``power`` is not from 0 to 16.

    Examples
    --------
    >>> from hopper.uncertainty.sampling import points_in_box
    >>> points_in_box(dimensions=2, power=5).shape
    (8, 32, 2)
    """
    if not (1 <= dimensions <= 16 and 0 <= power <= 16):
        raise InvalidParameterError(
            f"dimensions = {dimensions} or power = {power} is out of range: give 1 to 16, 0 to 16"
        )
    each = (
        scipy.stats.qmc.Sobol(dimensions, bits=_BITS, seed=np.random.default_rng([_SEED, number]))
        for number in range(SHIFTS)
    )
    # In the middle of what the last bit is worth: never 0, of which no normal value is finite.
    return np.array([one.random_base2(power) for one in each]) + 2.0 ** -(_BITS + 1)


@checked
def normal_points(points: RealLike, possible: RealLike) -> Array:
    """Return points of the unit box as independent normal values, of the same shape.

    Their means are 0.5 and their standard deviations 0.5: the box is one deviation around the
    mean. ``possible``, shape (d, 2), is between which values they are cut off.

    Raises
    ------
    InvalidParameterError
        If the shapes do not go together.
    """
    low, high = _chances(possible)
    if np.shape(points)[-1:] != low.shape:
        raise InvalidParameterError(
            f"points have the shape {np.shape(points)}: give {low.size} coordinates to each"
        )
    return (1 + scipy.special.ndtri(low + np.asarray(points) * (high - low))) / 2


@checked
def cut_off(possible: RealLike) -> float:
    """Return the probability of what :func:`normal_points` cuts off, as that."""
    low, high = _chances(possible)
    return float(1 - np.prod(high - low))


def _chances(possible: RealLike) -> tuple[Array, Array]:
    """Return the probabilities of lying below the ends of what is possible."""
    ends = np.asarray(possible, dtype=float)
    if ends.ndim != 2 or ends.shape[1] != 2:
        raise InvalidParameterError(f"possible has the shape {ends.shape}: give (d, 2)")
    low, high = scipy.special.ndtr(2 * ends.T - 1)
    return low, high


@checked
def shares(labels: Callable[[Array], Iterable[str]], points: RealLike) -> dict[str, Share]:
    """Return the share of the points, shape (shifts, n, d), at which each label holds.

    The error is that of the mean of the shifts, and at least as if a point of each were wrong.

    Raises
    ------
    InvalidParameterError
        If the points have another shape.

    Examples
    --------
    >>> from hopper.uncertainty.sampling import points_in_box, shares
    >>> points = points_in_box(dimensions=2, power=8)
    >>> round(shares(lambda p: ["left"] if p[0] < 0.3 else [], points)["left"].value, 2)
    0.3
    """
    shifts = np.asarray(points, dtype=float)
    if shifts.ndim != 3 or len(shifts) < 2 or not shifts.shape[1]:
        raise InvalidParameterError(
            f"points have the shape {shifts.shape}: give two shifts at least, (shifts, n, d)"
        )
    counts = [Counter(label for point in shifted for label in labels(point)) for shifted in shifts]
    names = dict.fromkeys(name for count in counts for name in count)
    each = shifts.shape[1]
    return {name: _share([count[name] / each for count in counts], each) for name in names}


def _share(values: Sequence[float], each: int) -> Share:
    shifts = len(values)
    factor = float(scipy.special.stdtrit(shifts - 1, (1 + _CONFIDENCE) / 2))
    scatter = factor * float(np.std(values, ddof=1)) / sqrt(shifts)
    # A few shifts may agree by chance: each may have counted a point too many.
    return Share(float(np.mean(values)), max(scatter, 1 / (each * sqrt(shifts))))
