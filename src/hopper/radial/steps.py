"""Steps of Newton's iteration: their solution and their size, for the innermost loops.

Arguments are not checked: at this size that would cost as much as the step.
"""

import numpy as np
from scipy.linalg.lapack import dgesv

from hopper.arrays import Array


def solved_by(jacobian: Array, right: Array) -> Array:
    """Return the solutions for the columns of ``right``; nan where there are none."""
    _, _, solved, info = dgesv(jacobian, right, overwrite_b=True)
    return np.full_like(right, np.nan) if info else solved


def size_of(step: Array, u: Array) -> float:
    """Size of a step: absolute in log(sigma) and psi, relative in tau where tau > 1."""
    return max(float(np.abs(step[:-1]).max()), float(abs(step[-1])) / max(abs(u[-1]), 1.0))
