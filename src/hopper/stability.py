"""Spectral abscissa of the linearised equations: low modes in physical mode, and the line.

The supremum of Re(lambda) is the larger of the low modes' and the asymptotic line's, so no large
mesh is needed. A hopper is stable where it is negative, because t = log r decreases downwards.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigvals

from hopper.asymptotic_line import AsymptoticLine, asymptotic_line
from hopper.collocation import half_matrix
from hopper.errors import ConvergenceError
from hopper.radial import RadialSolution

Complex = NDArray[np.complex128]

_SIZES = (24, 32, 48, 72, 108)
_TOLERANCE = 1e-10
_LEAST_MODES = 3


@dataclass(frozen=True)
class Stability:
    """What decides the stability of a radial solution.

    Attributes
    ----------
    eigenvalues : complex array, shape (n,)
        Converged low modes of physical parity with Im >= 0, by increasing modulus.
    line : AsymptoticLine
    abscissa : float
        Supremum of Re(lambda); not attained by a mode where the line governs.
    governed_by : "mode" or "line"
    error_estimate : float
        Of the abscissa.
    """

    eigenvalues: Complex
    line: AsymptoticLine
    abscissa: float
    governed_by: Literal["mode", "line"]
    error_estimate: float

    @property
    def stable(self) -> bool:
        """Whether all perturbations decay down the hopper."""
        return self.abscissa < 0


def stability(solution: RadialSolution) -> Stability:
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
    highest = float(modes.real.max())
    error = max(mode_error, line.error_estimate)
    if highest > line.abscissa:
        return Stability(modes, line, highest, "mode", error)
    return Stability(modes, line, line.abscissa, "line", error)


def low_modes(solution: RadialSolution) -> tuple[Complex, float]:
    """Return the converged low modes (Im >= 0, by modulus) and their largest relative change.

    A mode counts while it and all of smaller modulus change by less than 1e-10 between two meshes.

    Raises
    ------
    TangencyError
        As :func:`stability`.
    ConvergenceError
        If fewer than three modes converge on the finest mesh.
    """
    coarse = upper_eigenvalues(solution, _SIZES[0])
    for size in _SIZES[1:]:
        fine = upper_eigenvalues(solution, size)
        count = min(coarse.size, fine.size)
        change = np.abs(coarse[:count] - fine[:count]) / np.abs(fine[:count])
        unresolved = np.flatnonzero(change > _TOLERANCE)
        converged = int(unresolved[0]) if unresolved.size else count
        if converged >= _LEAST_MODES:
            # Rounding of the collocation matrix: a few units of its condition, about size ** 2.
            rounding = np.finfo(float).eps * size**2
            return fine[:converged], max(float(change[:converged].max()), rounding)
        coarse = fine
    raise ConvergenceError(
        f"only {converged} low modes converged at {size} half-grid points; psi is too close to "
        "pi/4 - delta/2, lower the wall friction"
    )


def upper_eigenvalues(solution: RadialSolution, size: int) -> Complex:
    """Return the eigenvalues with Im >= 0 of the physical half, by increasing modulus."""
    matrix = half_matrix(solution, size)
    values = np.asarray(eigvals(matrix, check_finite=False, overwrite_a=True), dtype=np.complex128)
    upper = values[values.imag >= 0]
    return upper[np.argsort(np.abs(upper))]
