"""Spectral abscissa of the linearised equations: low modes in physical mode, and the line.

The supremum of Re(lambda) is the larger of the low modes' and the asymptotic line's, so no large
mesh is needed. A hopper is stable where it is negative, because t = log r decreases downwards.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.radial.solution import RadialSolution
from hopper.stability.asymptotic_line import AsymptoticLine, asymptotic_line
from hopper.stability.collocation import half_matrix

_SIZES = (16, 24, 36, 54, 80, 120)
_TOLERANCE = 1e-10
_LEAST_MODES = 3
# The estimate of a mode's error is an order of magnitude.
_SAFETY = 10


@dataclass(frozen=True)
class LinearStability:
    """What decides the stability of a radial solution.

    Attributes
    ----------
    eigenvalues : complex array, shape (n,)
        Converged low modes of physical parity with Im >= 0, by increasing modulus.
    mode_errors : array, shape (n,)
        Absolute errors that the mesh leaves in them.
    line : AsymptoticLine
    abscissa : float
        Supremum of Re(lambda); not attained by a mode where the line governs.
    governed_by : "mode" or "line"
    error_estimate : float
        Absolute, of the abscissa.
    """

    eigenvalues: Complex
    mode_errors: Array
    line: AsymptoticLine
    abscissa: float
    governed_by: Literal["mode", "line"]
    error_estimate: float

    __repr__ = brief("abscissa", "governed_by", "line.abscissa", "eigenvalues", "error_estimate")

    @property
    def stable(self) -> bool:
        """Whether all perturbations decay down the hopper."""
        return self.abscissa < 0


def linear_stability(solution: RadialSolution) -> LinearStability:
    """Return the low modes, the asymptotic line and the spectral abscissa of a radial solution.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb.
    TangencyError
        If psi reaches pi/4 - delta/2.
    ConvergenceError
        If too few low modes or the line converge.
    """
    line = asymptotic_line(solution)
    modes, mode_error = low_modes(solution)
    errors = _SAFETY * mode_error * np.abs(modes)
    highest = np.argmax(modes.real)
    abscissa = float(modes[highest].real)
    if abscissa > line.abscissa:
        return LinearStability(modes, errors, line, abscissa, "mode", float(errors[highest]))
    return LinearStability(modes, errors, line, line.abscissa, "line", line.error_estimate)


def low_modes(solution: RadialSolution) -> tuple[Complex, float]:
    """Return the converged low modes (Im >= 0, by modulus) and their largest relative error.

    Errors decay geometrically with the mesh, so that of the finer of two meshes is about their
    difference to the power of their ratio. A mode counts while it and all of smaller modulus have
    a relative error below 1e-10 by that estimate.

    Raises
    ------
    TangencyError
        As :func:`stability`.
    ConvergenceError
        If fewer than three modes converge on the finest mesh.
    """
    previous = _SIZES[0]
    coarse = upper_eigenvalues(solution, previous)
    for size in _SIZES[1:]:
        fine = upper_eigenvalues(solution, size)
        count = min(coarse.size, fine.size)
        change = np.abs(coarse[:count] - fine[:count]) / np.abs(fine[:count])
        error = change ** (size / previous)
        unresolved = np.flatnonzero(error > _TOLERANCE)
        converged = int(unresolved[0]) if unresolved.size else count
        if converged >= _LEAST_MODES:
            # Rounding of the collocation matrix: a few units of its condition, about size ** 2.
            rounding = np.finfo(float).eps * size**2
            return fine[:converged], max(float(error[:converged].max()), rounding)
        coarse, previous = fine, size
    raise ConvergenceError(
        f"only {converged} low modes converged at {size} half-grid points; psi is too close to "
        "pi/4 - delta/2, lower the wall friction"
    )


def upper_eigenvalues(solution: RadialSolution, size: int) -> Complex:
    """Return the eigenvalues with Im >= 0 of the physical half, by increasing modulus."""
    matrix = half_matrix(solution, size)
    values = np.linalg.eigvals(matrix).astype(np.complex128)
    upper = values[values.imag >= 0]
    return upper[np.argsort(np.abs(upper))]
