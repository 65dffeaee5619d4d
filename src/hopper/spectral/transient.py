"""Transient growth on the kept part of a spectrum: the norm of exp(t M), t >= 0, and its bounds.

With the kept eigenvectors V = Q R, exp(t M) acts on their span as R exp(t Lambda) R^-1, and

    exp(t alpha) <= ||exp(t M)|| <= kappa(V) exp(t alpha),

where alpha is the largest real part and kappa(V) = ||V|| ||V^-1|| for columns of unit norm. Several
bases are those of parts of M that are orthogonal to each other.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eig, qr, solve_triangular

from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.spectral.matching import match_kept


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

    __repr__ = brief("size", "abscissa")

    @property
    def size(self) -> int:
        """Number of modes k."""
        return self.eigenvalues.size

    @property
    def abscissa(self) -> float:
        """Largest real part."""
        return float(self.eigenvalues.real.max())


def basis_of(matrix: Array, weight: Array, kept: Complex) -> ModalBasis:
    """Return the basis of kept modes of a real matrix, in the norm ||u||^2 = sum_i w_i |u_i|^2.

    Parameters
    ----------
    matrix : array, shape (n, n)
        Real.
    weight : array, shape (n,)
        Positive.
    kept : complex array, shape (k,)
        Eigenvalues to keep, closed under conjugation.

    Raises
    ------
    InvalidParameterError
        If a kept value is not an eigenvalue of the matrix, or the conjugate of one is not kept.
    """
    values, vectors = eig(matrix, check_finite=False)
    found = match_kept(kept, values)
    real = found[values[found].imag == 0]
    upper = found[values[found].imag > 0]
    if set(found) != set(match_kept(kept.conj(), values)):
        raise InvalidParameterError("kept eigenvalues are not closed under conjugation")
    weighted = np.sqrt(weight)[:, None] * vectors
    weighted = weighted / np.linalg.norm(weighted, axis=0)
    columns = np.sqrt(2) * weighted[:, upper]
    pairs = np.stack([columns.real, columns.imag], axis=2).reshape(weight.size, -1)
    (factor,) = qr(np.hstack([weighted[:, real].real, pairs]), mode="r", check_finite=False)
    ordered = np.stack([values[upper], values[upper].conj()], axis=1).reshape(-1)
    size = kept.size
    return ModalBasis(np.concatenate([values[real], ordered]), factor[:size, :size])


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
