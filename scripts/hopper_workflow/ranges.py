"""Ranges of numbers as the configuration gives them."""

import numpy as np


def steps(start: float, stop: float, step: float) -> np.ndarray:
    """Return values from start by steps, up to stop."""
    return np.arange(start, stop + 1e-6 * step, step)


def closing_in(stop: float, points: int) -> np.ndarray:
    """Return values from 0 that close in on stop as a parabola does on its vertex.

    So a curve with a vertical tangent at stop is drawn in even steps. The last value stays below
    stop by 1e-10 of it: closer, what belongs to it may not be resolved.
    """
    left = np.linspace(1, 0, points)
    left[-1] = 1e-5
    return stop * (1 - left**2)


def spaced(start: float, stop: float, points: int) -> np.ndarray:
    """Return equally spaced values."""
    return np.linspace(start, stop, points)
