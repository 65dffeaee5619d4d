"""Largest eigenvalues of many positive semidefinite operators at once, by Lanczos iteration.

The operators act together, one a column, so that what they share is one matrix product for all.
Arguments are not checked: operators may overflow, and say so.

References
----------
.. [Pa] B. N. Parlett, The symmetric eigenvalue problem, SIAM (1998).
"""

from collections.abc import Callable, Sequence

import numpy as np

from hopper.arrays import Array, Numbers

# A Ritz pair (value, y) of residual r has some eigenvalue within r, and the largest, of vector u,
# within r / |u^H y| [Pa]. The start vector's component along u is below this share of n^(-1/2) in
# one case of a hundred, and iteration makes it larger.
_SHARE = 0.1


def _dot(x: Numbers, y: Numbers) -> Array:
    """Return the real parts of the columns' inner products, shape (points,)."""
    if not np.iscomplexobj(x):
        return np.einsum("ij,ij->j", x, y)
    return np.einsum("ij,ij->j", x.view(float), y.view(float)).reshape(-1, 2).sum(axis=1)


def _largest_ritz(alpha: Array, beta: Array) -> tuple[Array, Array]:
    """Return the largest eigenvalue and the |last component| of its vector, shape (points,) each.

    The tridiagonal matrices have diagonals ``alpha``, shape (k, points), and ``beta`` beside them.
    """
    k, points = alpha.shape
    i = np.arange(k)
    lower = np.zeros((points, k, k))
    lower[:, i, i] = alpha.T
    lower[:, i[1:], i[:-1]] = beta[: k - 1].T
    ritz, vectors = np.linalg.eigh(lower)
    return ritz[:, -1], np.abs(vectors[:, -1, -1])


def largest_eigenvalues(
    apply: Callable[..., Numbers],
    data: Sequence[Numbers],
    start: Numbers,
    tolerance: float,
    checks: Sequence[int],
    noise: Callable[[Array], Array] = np.zeros_like,
) -> Array:
    """Return the largest eigenvalue of each operator, shape (points,).

    Parameters
    ----------
    apply : callable
        Takes vectors, shape (n, points), and the ``data`` of their operators; returns the images,
        in an array of its own.
    data : sequence of arrays, shape (..., points)
        What differs from operator to operator; not finite where an operator is not.
    start : array, shape (n,)
        Real or complex as the operators are.
    tolerance : float
        Bound on the relative error where eigenvalues crowd around the largest; elsewhere it is far
        smaller.
    checks : sequence of int
        Increasing numbers of steps after which convergence is looked at: the last is the most.
    noise : callable, optional
        Relative residual that rounding may leave in place at an eigenvalue.

    Returns
    -------
    array, shape (points,)
        Between 1e-150 and 1e150; infinite where squares overflow, NaN where the steps do not
        suffice.
    """
    points = data[0].shape[-1]
    share = _SHARE / np.sqrt(start.size)
    found, active = np.full(points, np.nan), np.arange(points)
    q = np.repeat((start / np.linalg.norm(start))[:, None], points, axis=1)
    previous = np.zeros_like(q)
    # Without reorthogonalisation: its price, copies of converged values, spares the largest.
    alpha, beta = np.zeros((2, checks[-1], points))
    for k in range(checks[-1]):
        v = apply(q, *data)
        v -= beta[k - 1] * previous
        alpha[k] = _dot(q, v)
        v -= alpha[k] * q
        beta[k] = np.sqrt(_dot(v, v))
        overflown = ~np.isfinite(beta[k])
        alpha[k, overflown] = beta[k, overflown] = 0.0
        previous, q = q, v / beta[k]
        if k + 1 not in checks and not (overflown | (beta[k] == 0)).any():
            continue
        value, last = _largest_ritz(alpha[: k + 1], beta[: k + 1])
        # The change of a value can pause, the residual cannot.
        done = beta[k] * last <= (share * tolerance + noise(value)) * value
        found[active[done]] = np.where(overflown, np.inf, value)[done]
        if done.all():
            break
        if done.any():
            active = active[~done]
            alpha, beta, q, previous, *data = (
                np.compress(~done, array, axis=-1) for array in (alpha, beta, q, previous, *data)
            )
    return found
