"""Norms of exp(t M) on the span of some modes, at many times t.

With the eigenvectors V = Q R of the modes, exp(t M) acts on their span as A = R exp(t Lambda) R^-1.
The norm of A is the root of the largest eigenvalue of A^T A: by Lanczos iteration for all times at
once, or of one dense matrix after the other where many singular values are near the largest.
Arguments are not checked: they are parts of a basis that is.
"""

from functools import partial

import numpy as np
import scipy

from hopper.arrays import Array, Complex
from hopper.spectral.lanczos import largest_eigenvalues

# Bound on the error of squares of norms, steps of the iteration, and times that go together.
_TOLERANCE, _CHECKS, _BATCH = 1e-8, (6, 8, 10, 12, 16), 512


def relative_norms(factor: Array, eigenvalues: Complex, times: Array) -> Array:
    """Return exp(-t alpha) ||exp(t M)|| at each t, alpha the largest real part of an eigenvalue.

    It neither over- nor underflows.

    Parameters
    ----------
    factor, eigenvalues : array, shape (k, k) and (k,)
        As of a :class:`hopper.spectral.transient.ModalBasis`.
    times : array, shape (n,)
        Not negative.

    Returns
    -------
    array, shape (n,)
        Relative errors of rounding size; at most 1e-8 where a few singular values are close.
    """
    size, real = eigenvalues.size, int(np.sum(eigenvalues.imag == 0))
    rates = eigenvalues[[*range(real), *range(real, size, 2)]] - eigenvalues.real.max()
    inverse = scipy.linalg.solve_triangular(factor, np.eye(size), check_finite=False)
    gram = partial(_gram_product, factor, inverse, real)
    start = np.random.default_rng(0).standard_normal(size)
    squares = np.full(times.size, np.nan)
    with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
        for first in range(0, times.size, _BATCH):
            batch = slice(first, first + _BATCH)
            diagonal = np.exp(rates[:, None] * times[batch])
            squares[batch] = largest_eigenvalues(gram, [diagonal], start, _TOLERANCE, _CHECKS)
            # Whether singular values crowd around the largest is a matter of the norm, not of time.
            if np.isnan(squares[batch]).mean() > 0.5:
                break
    for index in np.flatnonzero(~np.isfinite(squares)):
        image = factor @ _times(np.exp(rates[:, None] * times[index]), real, inverse)
        squares[index] = _largest_eigenvalue(image.T @ image)
    return np.sqrt(squares)


def _gram_product(
    factor: Array, inverse: Array, real: int, vectors: Array, diagonal: Complex
) -> Array:
    """Return A^T A v for A = R diag(d) R^-1, column by column, each with a diagonal of its own."""
    image = factor @ _times(diagonal, real, inverse @ vectors)
    return inverse.T @ _times(diagonal.conj(), real, factor.T @ image)


def _times(diagonal: Complex, real: int, vectors: Array) -> Array:
    """Return diag(d) v in the real basis: scaling, and a rotation for each pair.

    ``diagonal``, shape (``real`` + pairs, n) or (..., 1), has one of each pair.
    """
    result = np.empty_like(vectors)
    result[:real] = diagonal[:real].real * vectors[:real]
    turn, rows, columns = diagonal[real:], vectors[real::2], vectors[real + 1 :: 2]
    result[real::2] = turn.real * rows + turn.imag * columns
    result[real + 1 :: 2] = turn.real * columns - turn.imag * rows
    return result


def _largest_eigenvalue(symmetric: Array) -> float:
    last = len(symmetric) - 1
    try:
        (found,) = scipy.linalg.eigvalsh(
            symmetric, subset_by_index=[last, last], driver="evx", check_finite=False
        )
    except np.linalg.LinAlgError:  # bisection fails where all eigenvalues coincide, as at t = 0
        found = np.linalg.eigvalsh(symmetric)[-1]
    return float(found)
