"""Chebyshev collocation on [-1, 1]: nodes, differentiation, quadrature, interpolation, parity.

All grids are second-kind (Gauss-Lobatto) points in increasing order. A *half grid* of ``m``
points is the positive half of ``2 m`` points: it carries a function of known parity and has no node
at 0. A *centred* one is the half of ``2 m - 1`` points with the node at 0. Arrays returned by
cached functions are read-only.

References
----------
.. [BT] R. Baltensperger, M. R. Trummer, Spectral differencing with a twist,
   SIAM J. Sci. Comput. 24 (2003).
.. [WR] J. A. C. Weideman, S. C. Reddy, A MATLAB differentiation matrix suite,
   ACM Trans. Math. Softw. 26 (2000).
.. [BTb] J.-P. Berrut, L. N. Trefethen, Barycentric Lagrange interpolation, SIAM Rev. 46 (2004).
.. [Wa] J. Waldvogel, Fast construction of the Fejer and Clenshaw-Curtis quadrature rules,
   BIT 46 (2006).
"""

from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.fft import dct

from hopper.arrays import Array

Parity = Literal["even", "odd"]


def _frozen(array: Array) -> Array:
    array.flags.writeable = False
    return array


@lru_cache(maxsize=64)
def nodes(n: int) -> Array:
    """Return the ``n`` second-kind points sin(pi (2j - n + 1) / (2n - 2)), shape (n,).

    The sine form is exactly odd about the middle [WR].
    """
    return _frozen(np.sin(np.pi * np.arange(1 - n, n, 2) / (2 * (n - 1))))


@lru_cache(maxsize=32)
def differentiation_matrix(n: int) -> Array:
    """Return the matrix, shape (n, n), that maps nodal values to the derivative's nodal values."""
    angle = np.pi * np.arange(n) / (2 * (n - 1))
    # Differences of nodes as products of sines, free of cancellation [WR].
    difference = 2 * np.sin(angle[:, None] + angle) * np.sin(angle[:, None] - angle)
    # Lower half from the upper by symmetry: sines of small angles are the accurate ones [WR].
    upper = np.arange(n) < n / 2
    difference = np.where(upper[:, None], difference, -difference[::-1, ::-1])
    np.fill_diagonal(difference, 1.0)
    weight = _barycentric_weights(n)
    matrix = weight / weight[:, None] / difference
    np.fill_diagonal(matrix, 0.0)
    # Negative-sum trick: rows annihilate constants exactly [BT].
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return _frozen(matrix)


@lru_cache(maxsize=64)
def clenshaw_curtis_weights(n: int) -> Array:
    """Return the quadrature weights, shape (n,), exact for polynomials of degree n - 1 [Wa]."""
    even = np.arange(0, n, 2)
    moments = np.zeros(n)
    moments[::2] = 2.0 / (1.0 - even**2)
    weights = dct(moments, type=1) / (n - 1)
    weights[[0, -1]] /= 2
    return _frozen(weights)


def _barycentric_weights(n: int) -> Array:
    weights = np.where(np.arange(n) % 2, -1.0, 1.0)
    weights[[0, -1]] /= 2
    return weights


def interpolation_matrix(n: int, x: ArrayLike) -> Array:
    """Return the matrix, shape (len(x), n), from nodal values to values at ``x`` [BTb]."""
    gap = np.atleast_1d(np.asarray(x, dtype=float))[:, None] - nodes(n)
    row, column = np.nonzero(gap == 0)
    gap[row, column] = 1.0
    matrix = _barycentric_weights(n) / gap
    matrix /= matrix.sum(axis=1, keepdims=True)
    matrix[row] = 0.0
    matrix[row, column] = 1.0
    return matrix


def coefficients(values: Array) -> Array:
    """Return the Chebyshev coefficients of nodal ``values`` along the first axis, same shape."""
    n = len(values)
    result: Array = dct(values[::-1], type=1, axis=0) / (n - 1)
    result[[0, -1]] /= 2
    return result


@lru_cache(maxsize=64)
def half_nodes(m: int, *, centred: bool = False) -> Array:
    """Return the ``m`` points of a half grid, shape (m,): up to 1, from 0 if centred."""
    return _frozen(nodes(2 * m - centred)[-m:].copy())


def _fold(matrix: Array, m: int, parity: Parity, centred: bool) -> Array:
    """Restrict columns of a matrix on all values to the half grid of the given parity."""
    mirrored = matrix[:, m - 1 :: -1]
    folded = matrix[:, -m:] + mirrored if parity == "even" else matrix[:, -m:] - mirrored
    if centred:  # the point 0 mirrors itself
        folded[:, 0] /= 2
    return folded


@lru_cache(maxsize=128)
def half_differentiation_matrix(m: int, parity: Parity, *, centred: bool = False) -> Array:
    """Return the (m, m) derivative on the half grid of functions of the given parity.

    The derivative has the other parity.
    """
    matrix = differentiation_matrix(2 * m - centred)[-m:]
    return _frozen(_fold(matrix, m, parity, centred))


def half_interpolation_matrix(
    m: int, x: ArrayLike, parity: Parity, *, centred: bool = False
) -> Array:
    """Return the matrix, shape (len(x), m), from half-grid values to values at ``x``."""
    return _fold(interpolation_matrix(2 * m - centred, x), m, parity, centred)


def half_coefficients(values: Array, parity: Parity) -> Array:
    """Return the ``m`` Chebyshev coefficients that parity leaves (T0, T2, ... or T1, T3, ...)."""
    mirrored = values[::-1] if parity == "even" else -values[::-1]
    return coefficients(np.concatenate([mirrored, values]))[0 if parity == "even" else 1 :: 2]


def integrate_odd(values: Array) -> Array:
    """Return the integral from 0 of an odd function on the half grid; even, shape (m,)."""
    m = len(values)
    odd = half_coefficients(values, "odd")
    degree = 2 * np.arange(m) + 1
    even = np.zeros(m + 1)
    # The integral of T_n is T_(n+1) / (2 (n+1)) - T_(n-1) / (2 (n-1)), and T_2 / 4 for n = 1.
    even[1:] += odd / (2 * (degree + 1))
    even[1:-1] -= odd[1:] / (2 * (degree[1:] - 1))
    even[0] = -np.sum(even[1:] * np.where(np.arange(1, m + 1) % 2, -1.0, 1.0))
    angle = np.arccos(half_nodes(m))
    integral: Array = np.cos(2 * np.outer(angle, np.arange(m + 1))) @ even
    return integral
