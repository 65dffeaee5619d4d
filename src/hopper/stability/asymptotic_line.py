"""The vertical line that eigenvalues of large modulus approach, by quadrature.

To leading WKB order a wave that runs along both characteristics, with speeds +-w / cos(delta) in
tilted time, grows between axis and wall at the mean rate

    Lambda = 1/2 integral (F11 + F22) cos(delta) / w  /  integral cos(delta) / w,

the limit of Re(lambda) for |Im(lambda)| -> infinity; modes of one parity are spaced evenly in
Im(lambda). Both parities have the same line.
"""

from dataclasses import dataclass
from math import cos, pi

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError, not_resolved_because
from hopper.radial.grid import Grid
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.stability.collocation import mode_grid
from hopper.stability.tilted import TiltedCoefficients, on_grids

_SIZES = (36, 54, 80, 120, 180, 270, 400)
_TOLERANCE = 1e-13
_ACCEPTABLE = 1e-6
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


@checked
def asymptotic_line(
    solution: RadialSolution, first: tuple[Grid, TiltedCoefficients] | None = None
) -> AsymptoticLine:
    """Return the asymptotic line of a radial solution.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    first : pair, optional
        A half grid off the axis with its coefficients, to try before finer ones.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb.
    ConvergenceError
        If the quadrature does not reach 1e-6, relative; psi is too close to its singular value.
    """
    line, tail = _by_quadrature(solution, *(first or _on_grid(solution, _SIZES[0])))
    for size in _SIZES:
        if tail < _TOLERANCE:
            break
        line, tail = _by_quadrature(solution, *_on_grid(solution, size))
    if tail > _ACCEPTABLE:
        raise ConvergenceError(
            f"asymptotic line not resolved: error {line.error_estimate:.1e}; "
            f"{not_resolved_because(solution.friction_angle)}"
        )
    return line


def _on_grid(solution: RadialSolution, size: int) -> tuple[Grid, TiltedCoefficients]:
    grid = mode_grid(solution, size, "symmetric")
    return grid, on_grids(solution, [grid])[0]


def _by_quadrature(
    solution: RadialSolution, grid: Grid, at: TiltedCoefficients
) -> tuple[AsymptoticLine, float]:
    """Return the line on one grid, and what the grid leaves of its error, relative."""
    slowness = cos(solution.hopper.delta) / at.w
    growth = (at.f11 + at.f22) / 2
    travel_time = float(grid.weights @ slowness)
    abscissa = float(grid.weights @ (growth * slowness)) / travel_time
    size = max(1.0, abs(abscissa))
    tail = _tail(grid, (growth - abscissa) * slowness, slowness * size) / travel_time
    sensitivity = float(np.abs(growth).max() + size)
    error = tail + sensitivity * solution.error_estimate + _ROUNDING * size
    return AsymptoticLine(abscissa, pi / travel_time, error), tail / size


def _tail(grid: Grid, *integrands: Array) -> float:
    """Return the largest of the last Chebyshev coefficients of what the quadrature adds up."""
    values = np.stack([integrand * grid.stretch for integrand in integrands], axis=1)
    return float(np.abs(chebyshev.half_coefficients(values, "even")[-3:]).max())
