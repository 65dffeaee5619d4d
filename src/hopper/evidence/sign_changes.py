"""Sign changes and jumps of a function that is known at points only, and not continuous.

The spectral abscissa by the paper's algorithm is such a function of the hopper: it jumps where an
eigenvalue enters or leaves what two meshes agree on.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import nan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hopper.arguments import RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError

# A step that this times as much as its neighbours' slopes explain is a jump.
_STEEP = 5
# A slope is no kink's, which lies between its neighbours, if it is this much off their mean.
_UNLIKE = 1
# Secant steps before a sign change is taken for a jump, and how far beyond the root they go, in
# widths of a bracket.
_SECANTS, _BESIDE = 2, 0.45
# How many steps a bracket of a sign change, and each of its neighbours, is divided into.
_PARTS = 3


@dataclass(frozen=True)
class Change:
    """Where a function changes sign or jumps: between ``place`` - ``error`` and + ``error``.

    ``before`` and ``after`` are its values there, ``jump`` whether it is discontinuous as far as
    steps of that width tell.
    """

    place: float
    error: float
    before: float
    after: float
    jump: bool

    __repr__ = brief("place", "before", "after", "jump")


@checked
def sign_changes(
    function: Callable[[float], float], places: ArrayLike, width: float
) -> list[Change]:
    """Return the sign changes of a function, and its jumps in their neighbourhood.

    Parameters
    ----------
    function : callable
        NaN where it has no value.
    places : array, shape (n,)
        Increasing, at least two; two changes between neighbours, or a jump without a change of sign
        further than a step from one with, may be missed.
    width : float
        Largest distance between the ends of a bracket.

    Raises
    ------
    InvalidParameterError
        If there are fewer than two places, they do not increase, or the width is not positive.

    Examples
    --------
    >>> from math import cos
    >>> from hopper.evidence.sign_changes import sign_changes
    >>> [change] = sign_changes(cos, [1.0, 2.0], width=1e-6)
    >>> round(change.place, 5)
    1.5708
    """
    grid = np.asarray(places, dtype=float)
    if grid.ndim != 1 or grid.size < 2 or not np.all(np.diff(grid) > 0):
        raise InvalidParameterError("places must be two or more increasing numbers")
    if not width > 0:
        raise InvalidParameterError(f"width = {width:g} must be positive")
    function = cache(function)  # an evaluation is dear, and neighbourhoods share places
    values = np.array([function(float(x)) for x in grid])
    found: dict[float, Change] = {}
    for i in map(int, np.flatnonzero(_crossed(values))):
        first, last = max(i - 1, 0), min(i + 2, grid.size - 1)
        x = np.linspace(grid[first], grid[last], _PARTS * (last - first) + 1)
        y = np.array([function(float(place)) for place in x])
        for j in np.flatnonzero(_crossed(y) | _irregular(np.diff(y))):
            change = _narrowed(function, x, y, int(j), width)
            if change.jump or (change.before > 0) != (change.after > 0):
                found[change.place] = change
    return sorted(found.values(), key=lambda change: change.place)


def _crossed(values: Array) -> NDArray[np.bool_]:
    known, positive = np.isfinite(values), values > 0
    return known[:-1] & known[1:] & (positive[:-1] != positive[1:])


def _irregular(steps: Array) -> NDArray[np.bool_]:
    """Return which steps of equal length are unlike both neighbours."""
    found = np.zeros(steps.size, dtype=bool)
    found[1:-1] = _unlike(steps[:-2], steps[1:-1], steps[2:])
    return found & (np.abs(steps) > 0)


def _unlike(before: RealLike, slope: RealLike, after: RealLike) -> NDArray[np.bool_]:
    """Return whether slopes are unlike those before and after; these may differ by a kink."""
    before, after = np.asarray(before), np.asarray(after)
    return np.abs(slope - (before + after) / 2) > _UNLIKE * np.abs(before - after)


def _narrowed(
    function: Callable[[float], float], x: Array, y: Array, at: int, width: float
) -> Change:
    """Divide the interval from ``at`` to the next point down to a width, or to a gap."""
    slopes = np.diff(y) / np.diff(x)
    before, after = (float(slopes[i]) if 0 <= i < slopes.size else nan for i in (at - 1, at + 1))
    left, right, low, high = (float(one) for one in (x[at], x[at + 1], y[at], y[at + 1]))
    signs = (low > 0) != (high > 0)
    secants = _SECANTS if signs else 0
    while right - left > width:
        if not signs and not _unlike(before, (high - low) / (right - left), after):
            break  # a kink or a bend: a jump would stand out the more
        middle = (left + right) / 2
        if secants:
            root = left + (right - left) * low / (low - high)
            # Just beyond the root as seen from the closer end, which is to be the other end.
            beyond = root + np.copysign(_BESIDE * width, middle - root)
            middle, secants = float(np.clip(beyond, left, right)), secants - 1
        value = function(middle)
        if not np.isfinite(value):
            break
        first, second = (value - low) / (middle - left), (high - value) / (right - middle)
        beside = (before + after) / 2
        if (low > 0) != (value > 0) if signs else abs(first - beside) > abs(second - beside):
            right, high, after = middle, value, second
        else:
            left, low, before = middle, value, first
    steep = _STEEP * float(np.nanmax(np.abs([before, after, 0.0]))) * (right - left)
    return Change((left + right) / 2, (right - left) / 2, low, high, abs(high - low) > steep)
