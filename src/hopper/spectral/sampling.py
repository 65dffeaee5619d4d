"""Where to sample a curve so that straight lines between the samples are the curve."""

from collections.abc import Callable

import numpy as np

from hopper.arrays import Array

# Halvings of an interval of the first samples.
_DEEPEST = 16
# Distances from a place at which an axis closes in on it.
_CLOSEST = 6


def closing_in(points: Array, places: Array) -> Array:
    """Return an increasing axis with points added that close in on places within it.

    They halve their distance from the spacing of ``points`` on, and leave the place itself out.
    """
    spacing = float(np.diff(points).max())
    inside = places[(places > points[0]) & (places < points[-1])]
    offsets = spacing * 0.5 ** np.arange(_CLOSEST)
    near = (inside[:, None] + np.concatenate([-offsets, offsets])).ravel()
    near = near[(near > points[0]) & (near < points[-1])]
    # Places that are equal but for rounding give one point.
    return np.unique(np.append(points, np.round(near / spacing, 6) * spacing))


def refined(
    function: Callable[[Array], Array], points: Array, tolerance: float
) -> tuple[Array, Array]:
    """Return samples of positive curves over the same axis, between which lines will do.

    An interval is halved while a value at its middle is off the chord by more than ``tolerance`` of
    it, and with it its neighbours: a kink may lie just beyond. What is narrower than half the first
    spacing may be missed.

    Parameters
    ----------
    function : callable
        Takes points, shape (n,), returns values of one or more curves, shape (..., n).
    points : array, shape (n,)
        First samples, increasing.
    tolerance : float
        Relative.

    Returns
    -------
    points, values : array, shape (n,) and (..., n)
    """
    x, y = points, np.asarray(function(points))
    open_ = np.ones(x.size - 1, dtype=bool)
    for _ in range(_DEEPEST):
        if not open_.any():
            break
        (left,) = np.nonzero(open_)
        middle = (x[left] + x[left + 1]) / 2
        value = np.asarray(function(middle))
        chord = (y[..., left] + y[..., left + 1]) / 2
        off = np.abs(value - chord) > tolerance * np.abs(value)
        failing = np.zeros_like(open_)
        failing[left] = off.reshape(-1, left.size).any(axis=0)
        spread = failing.copy()
        spread[1:] |= failing[:-1]
        spread[:-1] |= failing[1:]
        # Both halves of what is bisected now inherit whether to go on.
        counts = 1 + open_
        open_ = np.repeat(spread, counts)
        x = np.insert(x, left + 1, middle)
        y = np.insert(y, left + 1, value, axis=-1)
    return x, y
