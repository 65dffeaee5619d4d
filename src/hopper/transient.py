"""Transient growth: the norm of exp(-t M) on the converged part of the spectrum, and its bounds.

Going down the hopper t = log r decreases; ``elapsed`` = -t >= 0 below. With the kept eigenvectors
V = Q R, exp(-t M) acts on their span as R exp(elapsed Lambda) R^-1, and

    exp(elapsed alpha) <= ||exp(-t M)|| <= kappa(V) exp(elapsed alpha),    (4.11)

where alpha is the largest real part and kappa(V) = ||V|| ||V^-1|| for columns of unit norm. Both
parities are orthogonal to each other in both norms, so each is treated by itself.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig, qr, solve_triangular
from scipy.optimize import linear_sum_assignment

from hopper import chebyshev
from hopper.chebyshev import Array
from hopper.collocation import Half, half_matrix
from hopper.errors import InvalidParameterError
from hopper.radial import RadialSolution

Complex = NDArray[np.complex128]
Norm = Literal["discrete", "L2"]
NORMS: tuple[Norm, ...] = ("discrete", "L2")

# Largest relative distance between a wanted eigenvalue and the one found on the mesh.
_SAME = 1e-6


@dataclass(frozen=True)
class ModalBasis:
    """Kept modes of one parity, orthonormalised.

    Attributes
    ----------
    eigenvalues : complex array, shape (k,)
        Closed under conjugation: real ones first, then each pair, Im > 0 before Im < 0.
    factor : array, shape (k, k)
        R of the real eigenvector basis: the eigenvector of each real eigenvalue, sqrt(2) times
        real and imaginary part of one of each pair, all eigenvectors of unit norm.
    """

    eigenvalues: Complex
    factor: Array

    @property
    def abscissa(self) -> float:
        """Largest real part."""
        return float(self.eigenvalues.real.max())


def half_weights(m: int, norm: Norm) -> Array:
    """Return the weights, shape (2 m - 1,), of the norm on a half grid of ``m`` nodes.

    ``discrete`` is the 2-norm of nodal values, presumably the paper's; ``L2`` has
    Clenshaw-Curtis weights, for theta / theta_w in [-1, 1].

    Raises
    ------
    InvalidParameterError
        If the norm is unknown.
    """
    if norm == "discrete":
        return np.full(2 * m - 1, 2.0)
    if norm == "L2":
        weights = 2 * chebyshev.clenshaw_curtis_weights(2 * m)[m:]
        return np.concatenate([weights, weights[:-1]])
    raise InvalidParameterError(f"norm = {norm!r} is unknown: use one of {', '.join(NORMS)}")


def modal_basis(
    solution: RadialSolution,
    n: int,
    half: Half,
    kept: ArrayLike,
    norm: Norm = "L2",
    psi_scale: float = 1.0,
) -> ModalBasis:
    """Return the basis of the kept modes of one parity on a mesh of ``n`` nodes.

    Parameters
    ----------
    solution : RadialSolution
        Radial solution of a Mohr-Coulomb material.
    n : int
        Nodes on the full interval, even.
    half : "physical" or "mirrored"
        Parity of the modes.
    kept : complex array, shape (k,)
        Eigenvalues to keep, closed under conjugation.
    norm : "discrete" or "L2"
        As in :func:`half_weights`.
    psi_scale : float
        Unknowns are (sigma1, psi1 / psi_scale): 1 as defined, 2 as printed.

    Raises
    ------
    InvalidParameterError
        If nothing is kept, an eigenvalue is not one of this mesh, or the norm is unknown.
    TangencyError
        If psi reaches pi/4 - delta/2.
    """
    wanted = np.asarray(kept, dtype=complex)
    if wanted.size == 0:
        raise InvalidParameterError(
            f"no {half} eigenvalue is kept: widen the filter's tolerance or use finer meshes"
        )
    root = np.sqrt(half_weights(n // 2, norm))
    values, vectors = eig(half_matrix(solution, n // 2, half, psi_scale), check_finite=False)
    found = match_kept(wanted, values)
    real = found[values[found].imag == 0]
    upper = found[values[found].imag > 0]
    if set(found) != set(match_kept(wanted.conj(), values)):
        raise InvalidParameterError("kept eigenvalues are not closed under conjugation")
    weighted = root[:, None] * vectors
    weighted = weighted / np.linalg.norm(weighted, axis=0)
    columns = np.sqrt(2) * weighted[:, upper]
    pairs = np.stack([columns.real, columns.imag], axis=2).reshape(root.size, -1)
    (factor,) = qr(np.hstack([weighted[:, real].real, pairs]), mode="r", check_finite=False)
    size = wanted.size
    ordered = np.stack([values[upper], values[upper].conj()], axis=1).reshape(-1)
    return ModalBasis(np.concatenate([values[real], ordered]), factor[:size, :size])


def match_kept(kept: Complex, values: Complex) -> NDArray[np.intp]:
    """Return the index among ``values`` of each kept eigenvalue, one to one, shape (k,).

    Raises
    ------
    InvalidParameterError
        If one of them is further away than rounding allows.
    """
    distance = np.abs(kept[:, None] - values) / np.abs(kept)[:, None]
    rows, columns = linear_sum_assignment(np.minimum(distance, 1.0))
    missing = int(np.sum(distance[rows, columns] > _SAME))
    if missing or kept.size > values.size:
        raise InvalidParameterError(
            f"{missing or kept.size - values.size} kept eigenvalues are not on this mesh: filter "
            "the spectrum of the same hopper and mesh again"
        )
    return columns


def modal_matrix(basis: ModalBasis) -> Array:
    """Return M restricted to the modes, in the orthonormal basis of their span, shape (k, k)."""
    values = basis.eigenvalues
    real = int(np.sum(values.imag == 0))
    diagonal = np.diag(values.real)
    index = np.arange(real, values.size, 2)
    diagonal[index, index + 1] = values[real::2].imag
    diagonal[index + 1, index] = -values[real::2].imag
    product = basis.factor @ diagonal
    return solve_triangular(basis.factor, product.T, trans="T", check_finite=False).T


def condition_number(bases: Sequence[ModalBasis]) -> float:
    """Return kappa(V) of the modes of one or both parities together.

    Raises
    ------
    InvalidParameterError
        If no basis is given.
    """
    _require_modes(bases)
    values = [np.linalg.svd(basis.factor, compute_uv=False) for basis in bases]
    return float(max(v[0] for v in values) / min(v[-1] for v in values))


def abscissa(bases: Sequence[ModalBasis]) -> float:
    """Return the largest real part among the modes of one or both parities, as above."""
    _require_modes(bases)
    return max(basis.abscissa for basis in bases)


def propagator_norm(bases: Sequence[ModalBasis], elapsed: ArrayLike) -> Array:
    """Return ||exp(-t M)|| on the span of the modes at ``elapsed`` = -t >= 0, same shape.

    Raises
    ------
    InvalidParameterError
        If a time is negative or not finite, or no basis is given.
    """
    times = np.asarray(elapsed, dtype=float)
    _require_modes(bases)
    if not (np.isfinite(times).all() and np.all(times >= 0)):
        raise InvalidParameterError("elapsed times must be finite and not negative: elapsed = -t")
    norms = [np.fromiter(_norms(basis, times.ravel()), float, times.size) for basis in bases]
    return np.max(norms, axis=0).reshape(times.shape)


def _require_modes(bases: Sequence[ModalBasis]) -> None:
    if not bases:
        raise InvalidParameterError("no modes: give the basis of at least one parity")


def _norms(basis: ModalBasis, times: Array) -> Iterator[float]:
    values, size = basis.eigenvalues, basis.eigenvalues.size
    real = int(np.sum(values.imag == 0))
    first = values[real::2]
    inverse = solve_triangular(basis.factor, np.eye(size), check_finite=False)
    for time in times:
        # exp(time Lambda) in the real basis: scaling, and a rotation for each pair.
        grown = np.empty_like(inverse)
        grown[:real] = np.exp(time * values[:real].real)[:, None] * inverse[:real]
        factor = np.exp(time * first)[:, None]
        rows, columns = inverse[real::2], inverse[real + 1 :: 2]
        grown[real::2] = factor.real * rows + factor.imag * columns
        grown[real + 1 :: 2] = factor.real * columns - factor.imag * rows
        yield float(np.linalg.norm(basis.factor @ grown, 2))


def oscillation(
    bases: Sequence[ModalBasis], start: float, length: float, points: int
) -> tuple[float, float]:
    """Return how much exp(t alpha) ||exp(-t M)|| varies over [start, start + length] of -t.

    Parameters
    ----------
    bases : sequence of ModalBasis
        Of one or both parities.
    start, length : float
        Not negative; ``length`` should cover a few periods.
    points : int
        Number of times, at least 3.

    Returns
    -------
    amplitude, error : float
        Largest minus least over the mean, and its change from half as many times.
    """
    elapsed = np.linspace(start, start + length, points)
    relative = propagator_norm(bases, elapsed) * np.exp(-abscissa(bases) * elapsed)
    fine, coarse = (float(np.ptp(x) / np.mean(x)) for x in (relative, relative[::2]))
    return fine, abs(fine - coarse)
