"""Low modes of the coupled equations that two meshes agree on, with their errors.

Unresolved eigenvalues of a mesh lie anywhere, also far to the right: nothing may be read off a
single mesh. Modes of two meshes are matched one to one by increasing modulus, up to the first that
finds no partner.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import log10, sqrt

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.radial.grid import half_grid
from hopper.radial.solution import RadialSolution
from hopper.spectral.matching import by_modulus
from hopper.stability.low_modes import partner_changes
from hopper.von_mises.collocation import assemble, without_flow_rate
from hopper.von_mises.linearisation import Coefficients, coefficients

# Half nodes: a mesh is compared with the one before.
SIZES = (12, 15, 19, 24, 30, 38, 48, 60, 76, 96)
# At these sizes overhead is most of the cost of the fields: they are evaluated together.
_FIRST = SIZES[:4]
LEAST_MODES = 6
# Relative error up to which a mode counts as resolved.
_RESOLVED = 1e-6
# Relative error that rounding allows on all but the finest meshes.
_LEAST_TOLERANCE = 1e-10
# Rounding of eigenvalues over n**2, the unit of rounding and the root of the cancellation in the
# matrix; the largest of 25,000 modes of 200 random cones was 30.
_ROUNDING = 50


@dataclass(frozen=True)
class ResolvedModes:
    """Resolved modes but that of the flow rate, lambda = 0.

    Attributes
    ----------
    eigenvalues : complex array, shape (k,)
        Im >= 0, by increasing modulus.
    errors : array, shape (k,)
        Absolute: the change from the mesh before, which an unlucky mode takes from those of smaller
        modulus, and rounding. The change is the error of that mesh; the finer one's is less, for
        low modes by a thousand.
    size : int
        Half nodes of the finer mesh.
    """

    eigenvalues: Complex
    errors: Array
    size: int

    __repr__ = brief("eigenvalues", "errors", "size")

    @checked
    def resolved_to(self, tolerance: float) -> int:
        """Return how many modes, from the lowest on, have relative errors within a tolerance."""
        relative = self.errors / np.maximum(1, np.abs(self.eigenvalues))
        return int(np.searchsorted(relative, tolerance, side="right"))


@checked
def low_modes(
    solution: RadialSolution, tolerance: float = 1e-9, first: int | None = None
) -> ResolvedModes:
    """Return the modes of the first mesh that resolves six of them to a relative tolerance.

    Parameters
    ----------
    solution : RadialSolution
        Of a von Mises cone.
    tolerance : float
        Relative error of the six lowest modes with Im >= 0, between 1e-10 and 1e-6.
    first : int, optional
        Size in ``SIZES`` of the first fine mesh, from a neighbour in a sweep.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises, the tolerance out of range, or ``first`` no size.
    SingularVelocityError
        If psi reaches pi/4.
    ConvergenceError
        If the finest mesh does not resolve them.
    """
    if not _LEAST_TOLERANCE <= tolerance <= _RESOLVED:
        raise InvalidParameterError(
            f"tolerance = {tolerance!r} must lie between {_LEAST_TOLERANCE:g} and {_RESOLVED:g}"
        )
    for size in SIZES[_index(first or _first_size(solution, tolerance)) :]:
        modes = modes_on(solution, size)
        if modes.resolved_to(tolerance) >= LEAST_MODES:
            return modes
    raise ConvergenceError(
        f"only {modes.resolved_to(tolerance)} modes resolved to {tolerance:g} by {size} half-grid "
        "points: psi comes too close to 45 deg; lower the wall friction"
    )


@checked
def modes_on(solution: RadialSolution, size: int) -> ResolvedModes:
    """Return the modes that a mesh of ``SIZES``, not the first, and the one before agree on.

    Errors as :func:`low_modes`.
    """
    before = SIZES[_index(size) - 1]
    coarse, fine = upper_eigenvalues(solution, before), upper_eigenvalues(solution, size)
    change = np.maximum.accumulate(partner_changes(fine, coarse))
    error = change + rounding_on(solution, size)
    count = int(np.searchsorted(error, _RESOLVED, side="right"))
    kept = fine[:count]
    return ResolvedModes(kept, error[:count] * np.maximum(1, np.abs(kept)), size)


@checked
def rounding_on(solution: RadialSolution, size: int) -> float:
    """Return the relative error of eigenvalues of a mesh by rounding."""
    cancellation = coefficients_on(solution, size).cancellation
    return _ROUNDING * float(np.finfo(float).eps) * size**2 * sqrt(cancellation)


def _index(size: int) -> int:
    if size not in SIZES[1:]:
        raise InvalidParameterError(f"size = {size!r} half nodes: give one of {SIZES[1:]}")
    return SIZES.index(size)


def _first_size(solution: RadialSolution, tolerance: float) -> int:
    """Guess the mesh that is fine enough; fitted to 200 random cones, off by one at most."""
    hopper = solution.hopper
    index = (
        2.3 * hopper.delta + 0.9 * hopper.half_angle + 3.3 * float(solution.psi.max())
        + solution.theta.size / 12 - 1.6
    )  # fmt: skip
    # Each mesh gains three digits on the one before.
    index -= log10(tolerance / 1e-9) / 3
    return SIZES[min(max(round(index), 1), len(SIZES) - 1)]


@checked
@lru_cache(maxsize=16)
def upper_eigenvalues(solution: RadialSolution, size: int) -> Complex:
    """Return the eigenvalues with Im >= 0 of a mesh, by increasing modulus; many unresolved.

    Without that of the flow rate. Errors as :func:`hopper.von_mises.collocation.mode_matrix`.
    """
    values = np.linalg.eigvals(matrix_on(solution, size)).astype(np.complex128)
    upper = by_modulus(values[values.imag >= 0])
    upper.flags.writeable = False
    return upper


@checked
def matrix_on(solution: RadialSolution, size: int) -> Array:
    """Return the matrix of the modes but that of the flow rate, shape (4 n - 3, 4 n - 3)."""
    grid = half_grid(size, solution.hopper.half_angle)
    return without_flow_rate(assemble(grid, coefficients_on(solution, size)))


@checked
def coefficients_on(solution: RadialSolution, size: int) -> Coefficients:
    """Return the coefficients on a half grid."""
    sizes = _FIRST if size in _FIRST else (size,)
    return _coefficients(solution, sizes)[sizes.index(size)]


@lru_cache(maxsize=8)
def _coefficients(solution: RadialSolution, sizes: tuple[int, ...]) -> list[Coefficients]:
    return coefficients(solution, [half_grid(n, solution.hopper.half_angle) for n in sizes])
