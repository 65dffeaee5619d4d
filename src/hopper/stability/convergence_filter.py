"""Discrete spectrum of M on a mesh, and the filter that keeps what two meshes agree on.

The matrix of the full interval is split by parity into its two halves before its eigenvalues are
computed: the same spectrum at a quarter of the work, each eigenvalue with its parity.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import checked
from hopper.arrays import Array, Mask
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.spectral.matching import relative_changes
from hopper.stability.mesh_spectrum import HALVES, MeshSpectrum

REASONS = ("kept", "no_partner", "changed", "eigenvector_unresolved", "beyond_first_unresolved")
# Eigenvectors whose last tenth of Chebyshev coefficients exceeds this, relative to the largest.
_TAIL_LIMIT = 1e-2


@dataclass(frozen=True)
class FilteredSpectrum:
    """The finer mesh's eigenvalues with the verdicts of the filter, in the same order.

    Attributes
    ----------
    fine : MeshSpectrum
    change : array
        Relative distance to the partner on the coarse mesh, one to one within a half; inf without.
    change_nearest : array
        Relative distance to the nearest eigenvalue of the coarse mesh, as the paper words it.
    kept : bool array
        Sound filter: eigenvector resolved, and partner within tolerance for this and every
        eigenvalue of smaller modulus in its half.
    kept_as_worded : bool array
        Nearest eigenvalue within tolerance.
    reason : integer array
        Index into ``REASONS``.
    """

    fine: MeshSpectrum
    change: Array
    change_nearest: Array
    kept: Mask
    kept_as_worded: Mask
    reason: NDArray[np.int8]

    __repr__ = brief("fine.n", "kept", "kept_as_worded")


@checked
def convergence_filter(
    fine: MeshSpectrum, coarse: MeshSpectrum, tolerance: float
) -> FilteredSpectrum:
    """Judge every eigenvalue of the fine mesh by the coarse one.

    Raises
    ------
    InvalidParameterError
        If the meshes are in the wrong order or the tolerance is not in (0, 1).
    ConvergenceError
        If nothing is kept.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.convergence_filter import convergence_filter
    >>> from hopper.stability.mesh_spectrum import mesh_spectrum
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> fine, coarse = (mesh_spectrum(solution, n) for n in (64, 48))
    >>> int(convergence_filter(fine, coarse, tolerance=1e-3).kept.sum())
    15
    """
    require_finer(fine.n, coarse.n)
    if not 0 < tolerance < 1:
        raise InvalidParameterError(f"tolerance = {tolerance!r} must lie between 0 and 1")
    nearest = relative_changes(fine.eigenvalues, coarse.eigenvalues, "nearest")
    change = np.empty(nearest.size)
    reason = np.zeros(nearest.size, dtype=np.int8)
    for half in range(len(HALVES)):
        mine = np.flatnonzero(fine.half == half)
        theirs = coarse.eigenvalues[coarse.half == half]
        change[mine] = relative_changes(fine.eigenvalues[mine], theirs, "one-to-one")
        reason[mine] = _reasons(change[mine], fine.tail[mine], tolerance)
    kept = reason == REASONS.index("kept")
    if not kept.any():
        raise ConvergenceError(
            f"no eigenvalue converged to {tolerance:g} between {coarse.n} and {fine.n} nodes: "
            "use finer meshes or lower the wall friction"
        )
    return FilteredSpectrum(fine, change, nearest, kept, nearest < tolerance, reason)


def _reasons(change: Array, tail: Array, tolerance: float) -> NDArray[np.int8]:
    reason = np.select([np.isinf(change), change >= tolerance, tail > _TAIL_LIMIT], [1, 2, 3], 0)
    unresolved = np.flatnonzero((reason == 1) | (reason == 2))
    if unresolved.size:
        beyond = np.arange(reason.size) > unresolved[0]
        reason[beyond & (reason == 0)] = REASONS.index("beyond_first_unresolved")
    return reason.astype(np.int8)


@checked
def require_finer(n: int, coarse_n: int) -> None:
    """Check the order of two meshes.

    Raises
    ------
    InvalidParameterError
        If the coarse one does not have fewer nodes.
    """
    if coarse_n >= n:
        raise InvalidParameterError(
            f"meshes in the wrong order: the coarse one has {coarse_n} nodes, the fine one {n}; "
            "give the finer mesh first"
        )
