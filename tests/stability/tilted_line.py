"""The line of modes of large modulus: by two quadratures, and from the modes themselves.

Along both characteristics of tilted time, of speeds +-c = +-w / cos(delta), waves grow at
(F'11 + F'22) / 2, F' = J K, on their way between axis and wall, which takes the time of
integrating 1 / c.
"""

from math import pi

import numpy as np
from scipy.integrate import quad, solve_ivp

from hopper.radial.solution import RadialSolution
from tests.stability.tilted_chebyshev import coefficients
from tests.stability.tilted_equations import compiled
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC, base, on_axis, shoot_all


def _rate_and_slowness(n, k):
    """Return (F'11 + F'22) / 2 and 1 / c of one point."""
    tilted = n - np.diag(np.diag(n))
    return np.trace(np.linalg.solve(tilted, k)) / 2, np.sqrt(tilted[0, 1] * tilted[1, 0])


def line_by_quadrature(solution: RadialSolution) -> tuple[float, float]:
    """Return Lambda and the spacing in Im(lambda) of modes of one parity, from the fields."""

    def integrand(theta):
        n, k = coefficients(solution, np.array([theta]))
        return _rate_and_slowness(n[:, :, 0], k[:, :, 0])

    def integral(function):
        end = solution.hopper.half_angle
        return quad(function, 0, end, epsabs=1e-14, epsrel=1e-13, limit=200)[0]

    growth = integral(lambda theta: float(np.prod(integrand(theta))))
    time = integral(lambda theta: float(integrand(theta)[1]))
    return growth / time, pi / time


def line_along(solution) -> tuple[float, float]:
    """Return the same without the package: integrals along the radial solution as it is shot."""
    member = base(solution)
    hopper = member.hopper
    f = compiled(hopper.curvature)

    def slopes(theta, y):
        d_sigma, d_psi, *entries = f(hopper.s, theta, y[0], y[1])
        rate, slow = _rate_and_slowness(*np.reshape(entries, (2, 2, 2)))
        return [d_sigma, d_psi, rate * slow, slow]

    start, y = on_axis(member)
    # Both integrands are even, so the first bit of the way is worth its length.
    y = [*y, *(start * np.array(slopes(start, y)[2:]))] if start else [*y, 0, 0]
    done = solve_ivp(slopes, (start, hopper.half_angle), y, "DOP853", rtol=1e-13, atol=1e-15)
    growth, time = done.y[2:, -1]
    return growth / time, pi / time


def high_modes(solution: RadialSolution, numbers, parity=SYMMETRIC):
    """Return the modes of the given numbers, counted upwards in Im(lambda), by shooting.

    Waves that return after twice the travel time, with a quarter period lost at the focus of a
    cone, put mode n near Lambda + i spacing (n + offset).
    """
    line, spacing = line_by_quadrature(solution)
    offset = 0.25 * solution.hopper.curvature + (0.5 if parity == ASYMMETRIC else 0)
    guesses = line + 1j * spacing * (np.array(numbers) + offset)
    return shoot_all(solution, guesses, parity, rtol=1e-11)


def extrapolated(modes) -> tuple[float, float]:
    """Return the limit of Re(lambda) from modes, by powers of 1 / Im**2, and an error estimate.

    The error is the difference to the extrapolation without the lowest mode, of one order less.
    """
    x, y = modes.imag**-2.0, modes.real
    best, other = (np.polyfit(x[i:], y[i:], len(x) - 1 - i)[-1] for i in (0, 1))
    return best, abs(best - other)
