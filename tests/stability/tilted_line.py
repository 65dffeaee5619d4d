"""The line of modes of large modulus: by quadrature over the package's fields, and from modes.

Along both characteristics of tilted time, of speeds +-c = +-w / cos(delta), waves grow at
(F'11 + F'22) / 2, F' = J K, on their way between axis and wall, which takes the time of
integrating 1 / c.
"""

from math import pi

import numpy as np
from scipy.integrate import quad

from hopper.radial.solution import RadialSolution
from tests.stability.tilted_chebyshev import coefficients
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC, shoot


def rate_and_slowness(solution: RadialSolution, theta: float) -> tuple[float, float]:
    """Return (F'11 + F'22) / 2 and 1 / c."""
    n, k = (matrix[:, :, 0] for matrix in coefficients(solution, np.array([theta])))
    tilted = n - np.diag(np.diag(n))
    f = np.linalg.solve(tilted, k)
    return np.trace(f) / 2, np.sqrt(tilted[0, 1] * tilted[1, 0])


def line_by_quadrature(solution: RadialSolution) -> tuple[float, float]:
    """Return Lambda and the spacing in Im(lambda) of modes of one parity."""

    def growth(theta):
        rate, slowness = rate_and_slowness(solution, theta)
        return rate * slowness

    def slowness(theta):
        return rate_and_slowness(solution, theta)[1]

    total, time = (
        quad(f, 0, solution.hopper.half_angle, epsabs=1e-14, epsrel=1e-13, limit=200)[0]
        for f in (growth, slowness)
    )
    return total / time, pi / time


def high_modes(solution: RadialSolution, numbers, parity=SYMMETRIC):
    """Return the modes of the given numbers, counted upwards in Im(lambda), by shooting.

    Waves that return after twice the travel time, with a quarter period lost at the focus of a
    cone, put mode n near Lambda + i spacing (n + offset).
    """
    line, spacing = line_by_quadrature(solution)
    offset = 0.25 * solution.hopper.curvature + (0.5 if parity == ASYMMETRIC else 0)
    return np.array([shoot(solution, complex(line, spacing * (n + offset)), parity) for n in numbers])


def line_from_modes(solution: RadialSolution, numbers, parity=SYMMETRIC) -> tuple[float, float]:
    """Return the limit of Re(lambda), extrapolated in 1 / Im**2, and an estimate of its error.

    The error is the difference to the extrapolation that leaves out the lowest mode.
    """
    modes = high_modes(solution, numbers, parity)
    x, y = modes.imag**-2.0, modes.real
    best, other = (np.polyfit(x[i:], y[i:], len(x) - 1 - i)[-1] for i in (0, 1))
    return best, abs(best - other)
