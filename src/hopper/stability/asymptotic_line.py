"""The vertical line that eigenvalues of large modulus approach, by quadrature.

To leading WKB order a wave that runs along both characteristics c = (-sin 2psi -+ cos delta) / q
between the axis and the wall grows at the mean rate Lambda, the limit of Re(lambda) for
|Im(lambda)| -> infinity; modes of one parity are spaced evenly in Im(lambda).
"""

from dataclasses import dataclass
from math import cos, pi

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.stability.linearisation import coefficients_on_half_grid, require_no_tangency

_SIZES = (24, 36, 54, 80, 120, 180, 270, 400)
_TOLERANCE = 1e-13
_ACCEPTABLE = 1e-6
# Rounding of the quadrature and of q = s - cos(2 psi), which is small near the tangency.
_ROUNDING = 1e-13


@dataclass(frozen=True)
class AsymptoticLine:
    """Limit ``abscissa`` of Re(lambda) and ``spacing`` in Im(lambda) of modes of one parity.

    ``error_estimate`` is that of the abscissa: the decay of the integrand's Chebyshev
    coefficients, the error of the radial solution, and rounding.
    """

    abscissa: float
    spacing: float
    error_estimate: float

    __repr__ = brief("abscissa", "spacing", "error_estimate")


def asymptotic_line(solution: RadialSolution) -> AsymptoticLine:
    """Return the asymptotic line of a radial solution.

    Raises
    ------
    TangencyError
        If psi reaches pi/4 - delta/2.
    ConvergenceError
        If the quadrature does not reach 1e-6; psi is then too close to that value.
    """
    require_no_tangency(solution)
    half_angle = solution.hopper.half_angle
    for size in _SIZES:
        growth, time = _integrands(solution, size)
        # The integrands are even: Clenshaw-Curtis on the full grid, by its positive half.
        weights = chebyshev.clenshaw_curtis_weights(2 * size)[size:]
        travel_time = float(weights @ time)
        abscissa = float(weights @ growth) / travel_time
        last = chebyshev.half_coefficients(np.stack([growth, time], axis=1), "even")[-3:]
        tail = (
            max(
                float(np.abs(last[:, 0] - abscissa * last[:, 1]).max()),
                abs(abscissa) * float(np.abs(last[:, 1]).max()),
            )
            / travel_time
        )
        if tail < _TOLERANCE * max(1.0, abs(abscissa)):
            break
    error = tail + _sensitivity(growth, time) * solution.error_estimate
    error += _ROUNDING * max(1.0, abs(abscissa))
    if error > _ACCEPTABLE * max(1.0, abs(abscissa)):
        raise ConvergenceError(
            f"asymptotic line not resolved: error {error:.1e}; psi is too close to "
            "pi/4 - delta/2, lower the wall friction"
        )
    return AsymptoticLine(abscissa, pi / (half_angle * travel_time), error)


def _integrands(solution: RadialSolution, size: int) -> tuple[Array, Array]:
    """Return (P cos delta + Q sin 2psi) / (s + cos 2psi) and cos delta / (s + cos 2psi)."""
    hopper = solution.hopper
    at = coefficients_on_half_grid(solution, size)
    rho = 2 * hopper.s * at.sigma / cos(hopper.delta)
    p = (at.f11 + at.f22) / 2
    q = (at.f12 / rho + rho * at.f21) / 2
    speed = hopper.s + np.cos(2 * at.psi)
    growth = (p * cos(hopper.delta) + q * np.sin(2 * at.psi)) / speed
    return growth, cos(hopper.delta) / speed


def _sensitivity(growth: Array, time: Array) -> float:
    """Amplification of relative errors of the fields by the integrand, an order of magnitude."""
    return float(np.abs(growth).max() / np.abs(time).min())
