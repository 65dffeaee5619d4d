"""Ranges of numbers as the configuration gives them."""

import numpy as np


def steps(start: float, stop: float, step: float) -> np.ndarray:
    """Return values from start by steps, up to stop."""
    return np.arange(start, stop + 1e-6 * step, step)


def spaced(start: float, stop: float, points: int) -> np.ndarray:
    """Return equally spaced values."""
    return np.linspace(start, stop, points)
