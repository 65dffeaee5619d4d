"""Discrete spectrum of M on a mesh, and the filter that keeps what two meshes agree on.

The matrix of the full interval is split by parity into its two halves before its eigenvalues are
computed: the same spectrum at a quarter of the work, each eigenvalue with its parity.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eig
from scipy.optimize import linear_sum_assignment

from hopper import chebyshev
from hopper.chebyshev import Array
from hopper.collocation import Half, half_matrix, require_even
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.radial import RadialSolution

Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]
Matching = Literal["nearest", "ordinal", "one-to-one"]

HALVES: tuple[Half, Half] = ("physical", "mirrored")
REASONS = ("kept", "no_partner", "changed", "eigenvector_unresolved", "beyond_first_unresolved")

# Eigenvectors whose last tenth of Chebyshev coefficients exceeds this, relative to the largest.
_TAIL_LIMIT = 1e-2
_LEAST_NODES = 16


@dataclass(frozen=True)
class MeshSpectrum:
    """All eigenvalues of M on a mesh, by increasing modulus.

    Attributes
    ----------
    n : int
        Nodes on the full interval.
    eigenvalues : complex array, shape (2 n - 2,)
    half : integer array, shape (2 n - 2,)
        Index into ``HALVES``: 0 physical (sigma1 even, psi1 odd), 1 mirrored.
    tail : array, shape (2 n - 2,)
        Largest of the last tenth of the eigenvector's Chebyshev coefficients over the largest of
        all: small where the mesh resolves the eigenvector.
    """

    n: int
    eigenvalues: Complex
    half: NDArray[np.int8]
    tail: Array


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


def mesh_spectrum(solution: RadialSolution, n: int) -> MeshSpectrum:
    """Return the spectrum of M on ``n`` nodes of the full interval.

    Raises
    ------
    InvalidParameterError
        If n is odd or less than 16.
    TangencyError
        If psi reaches pi/4 - delta/2.
    """
    require_even(n)
    if n < _LEAST_NODES:
        raise InvalidParameterError(f"n = {n} nodes are too few to filter: use {_LEAST_NODES}")
    values, tails = [], []
    for half in HALVES:
        value, vectors = eig(half_matrix(solution, n // 2, half), check_finite=False)
        values.append(value)
        tails.append(_tails(vectors, half))
    halves = np.repeat(np.arange(2, dtype=np.int8), n - 1)
    eigenvalues = np.concatenate(values)
    order = np.argsort(np.abs(eigenvalues), kind="stable")
    return MeshSpectrum(n, eigenvalues[order], halves[order], np.concatenate(tails)[order])


def _tails(vectors: Complex, half: Half) -> Array:
    """Return the tail of each eigenvector, the larger of its two components', shape (2 m - 1,)."""
    m = (len(vectors) + 1) // 2
    sigma = vectors[:m]
    psi = np.vstack([vectors[m:], np.zeros((1, vectors.shape[1]))])
    even, odd = (sigma, psi) if half == "physical" else (psi, sigma)
    last = m - max(1, m // 10)
    tails = []
    for part, parity in ((even, "even"), (odd, "odd")):
        size = np.abs(chebyshev.half_coefficients(part, parity))  # type: ignore[arg-type]
        tails.append(size[last:].max(axis=0) / size.max(axis=0))
    return np.maximum(*tails)


def relative_changes(fine: Complex, coarse: Complex, matching: Matching) -> Array:
    """Return each fine eigenvalue's relative distance to its partner on the coarse mesh.

    Parameters
    ----------
    fine, coarse : complex arrays, shapes (n,), (k,), k <= n
        By increasing modulus, conjugates in the same order in both (a stable sort).
    matching : "nearest", "ordinal" or "one-to-one"
        The nearest coarse eigenvalue, which several may share; the one of equal rank; or the
        one-to-one assignment of least total distance.

    Returns
    -------
    array, shape (n,)
        inf where there is no partner.
    """
    distance = np.abs(fine[:, None] - coarse) / np.abs(fine)[:, None]
    if matching == "nearest":
        return distance.min(axis=1)
    change = np.full(fine.size, np.inf)
    if matching == "ordinal":
        rows = columns = np.arange(coarse.size)
    else:
        # Distances beyond 1 count alike: eigenvalues without partner must not pull at others.
        rows, columns = linear_sum_assignment(np.minimum(distance, 1.0))
    change[rows] = distance[rows, columns]
    return change


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
    """
    _require_finer(fine.n, coarse.n)
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


@dataclass(frozen=True)
class PaperAbscissa:
    """Largest real part that two meshes agree on.

    Attributes
    ----------
    as_worded : float
        Both parities, nearest neighbour within the tolerance, among the 2 n / pi eigenvalues of
        least modulus, which is what pi points per wavelength resolve: the paper's "about the first
        250" at n = 400.
    physical : float
        The flow's parity, one-to-one partner within the tolerance for this and every eigenvalue of
        smaller modulus.
    """

    as_worded: float
    physical: float


def paper_abscissa(
    solution: RadialSolution, n: int, coarse_n: int, tolerance: float
) -> PaperAbscissa:
    """Return the spectral abscissa by the paper's algorithm, from meshes of n and coarse_n nodes.

    Raises
    ------
    InvalidParameterError
        If a mesh is odd or too small, or the meshes are in the wrong order.
    TangencyError
        If psi reaches pi/4 - delta/2.
    ConvergenceError
        If nothing is kept.
    """
    _require_finer(n, coarse_n)
    fine = {half: _eigenvalues(solution, n, half) for half in HALVES}
    coarse = {half: _eigenvalues(solution, coarse_n, half) for half in HALVES}
    both = _by_modulus(np.concatenate(list(fine.values())))[: int(2 * n / np.pi)]
    nearest = relative_changes(both, np.concatenate(list(coarse.values())), "nearest")
    change = relative_changes(fine["physical"], coarse["physical"], "one-to-one")
    run = np.logical_and.accumulate(change < tolerance)
    if not (run.any() and (nearest < tolerance).any()):
        raise ConvergenceError(
            f"no eigenvalue converged to {tolerance:g} between {coarse_n} and {n} nodes: use finer "
            "meshes or lower the wall friction"
        )
    return PaperAbscissa(
        as_worded=float(both[nearest < tolerance].real.max()),
        physical=float(fine["physical"][run].real.max()),
    )


def _require_finer(n: int, coarse_n: int) -> None:
    if coarse_n >= n:
        raise InvalidParameterError(
            f"meshes in the wrong order: the coarse one has {coarse_n} nodes, the fine one {n}; "
            "give the finer mesh first"
        )


def _eigenvalues(solution: RadialSolution, n: int, half: Half) -> Complex:
    require_even(n)
    return _by_modulus(np.linalg.eigvals(half_matrix(solution, n // 2, half)).astype(complex))


def _by_modulus(values: Complex) -> Complex:
    return values[np.argsort(np.abs(values), kind="stable")]


def unbroken_run(kept: Mask) -> tuple[int, int]:
    """Return (start, stop) of the first unbroken run of kept eigenvalues by modulus.

    Raises
    ------
    InvalidParameterError
        If nothing is kept.
    """
    if not kept.any():
        raise InvalidParameterError("no eigenvalue is kept: there is no run")
    start = int(np.argmax(kept))
    rejected = np.flatnonzero(~kept[start:])
    return start, start + int(rejected[0]) if rejected.size else kept.size
