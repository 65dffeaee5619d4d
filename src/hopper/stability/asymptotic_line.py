"""The vertical line that eigenvalues of large modulus approach, by quadrature.

To leading WKB order a wave that runs along both characteristics, with speeds +-w / cos(delta) in
tilted time, grows between axis and wall at the mean rate

    Lambda = 1/2 integral (F11 + F22) cos(delta) / w  /  integral cos(delta) / w,

the limit of Re(lambda) for |Im(lambda)| -> infinity; modes of one parity are spaced evenly in
Im(lambda). Both parities have the same line.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, inf, pi

import numpy as np

from hopper.arguments import checked
from hopper.brief import brief
from hopper.errors import ConvergenceError, not_resolved_because
from hopper.radial.grid import Grid
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.stability.collocation import mode_grid
from hopper.stability.tilted import TiltedCoefficients, stacked_on_grids

# Half-grid points of the quadrature.
LINE_SIZES = (36, 54, 80, 120, 180, 270, 400)
_TOLERANCE = 1e-13
_ACCEPTABLE = 1e-6
_ROUNDING = 1e-13
# Coefficients of the integrands that tell what the quadrature leaves.
_LAST = 3


@dataclass(frozen=True)
class AsymptoticLine:
    """Limit ``abscissa`` of Re(lambda) and ``spacing`` in Im(lambda) of modes of one parity.

    ``error_estimate`` is that of the abscissa: the decay of the integrand's Chebyshev
    coefficients, the error of the radial solution, and rounding. ``tail`` is the first of them,
    relative.
    """

    abscissa: float
    spacing: float
    error_estimate: float
    tail: float

    __repr__ = brief("abscissa", "spacing", "error_estimate")


@checked
def asymptotic_line(
    solution: RadialSolution, first: AsymptoticLine | None = None, tolerance: float = _TOLERANCE
) -> AsymptoticLine:
    """Return the asymptotic line of a radial solution.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    first : AsymptoticLine, optional
        Of the first of ``LINE_SIZES``, from :func:`lines_on`.
    tolerance : float
        What the quadrature may leave of the error, relative.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb.
    ConvergenceError
        If the quadrature does not reach 1e-6, relative; psi is too close to its singular value.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.asymptotic_line import asymptotic_line
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> round(asymptotic_line(solution).abscissa, 6)
    -4.555047
    """
    line = first
    for size in LINE_SIZES[bool(first) :]:
        if line and line.tail < tolerance:
            break
        grid = mode_grid(solution, size, "symmetric")
        (line,) = lines_on([solution], grid, stacked_on_grids([solution], [grid])[0])
    if line is None or line.tail > _ACCEPTABLE:
        raise ConvergenceError(
            f"asymptotic line not resolved: error {line.error_estimate if line else inf:.1e}; "
            f"{not_resolved_because(solution.friction_angle)}"
        )
    return line


@checked
def lines_on(
    solutions: Sequence[RadialSolution], grid: Grid, at: TiltedCoefficients
) -> list[AsymptoticLine]:
    """Return the lines of solutions of one hopper by quadrature on one half grid off the axis.

    ``at`` are their coefficients there, of shape (solutions, points).
    """
    slowness = cos(solutions[0].hopper.delta) / at.w
    growth = (at.f11 + at.f22) / 2
    travel_time = slowness @ grid.weights
    abscissa = (growth * slowness) @ grid.weights / travel_time
    size = np.maximum(1.0, np.abs(abscissa))
    integrands = (growth - abscissa[:, None]) * slowness, slowness * size[:, None]
    last = chebyshev.last_half_coefficients(grid.size, "even", _LAST)
    left = [np.abs((part * grid.stretch) @ last.T).max(axis=1) for part in integrands]
    tail = np.maximum(*left) / travel_time
    of_fields = np.array([solution.member.error for solution in solutions])
    error = tail + (np.abs(growth).max(axis=1) + size) * of_fields + _ROUNDING * size
    found = zip(abscissa, pi / travel_time, error, tail / size, strict=True)
    return [AsymptoticLine(*map(float, values)) for values in found]
