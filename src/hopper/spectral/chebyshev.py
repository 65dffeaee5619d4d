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
from typing import Annotated, Any, Literal

import numpy as np

from hopper.arguments import RealLike, RealRow, checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.values import number_array, require_row

Parity = Literal["even", "odd"]
_Values = Annotated[Array, number_array]  # or complex ones, as eigenvectors are
# Points of a grid: a full matrix of more has 2 GB.
_MOST_POINTS = 2**14
# Distance from a node that is none.
_AT_NODE = 1e-150


def _require_points(name: str, count: int, least: int, most: int) -> None:
    if not least <= count <= most:
        raise InvalidParameterError(
            f"{name} = {count} points is out of range: give {least} to {most}"
        )


def _full_size(m: int, centred: bool) -> int:
    """Return the number of points of the grid that a half grid of ``m`` points is half of."""
    _require_points("m", m, 1 + centred, _MOST_POINTS // 2)
    return 2 * m - centred


def _require_rows(values: Array, least: int) -> None:
    if values.ndim < 1 or len(values) < least:
        raise InvalidParameterError(
            f"values has shape {values.shape}: give values at {least} points at least"
        )


def _frozen(array: Array) -> Array:
    array.flags.writeable = False
    return array


@checked
@lru_cache(maxsize=64)
def nodes(n: int) -> Array:
    """Return the ``n`` second-kind points sin(pi (2j - n + 1) / (2n - 2)), shape (n,).

    The sine form is exactly odd about the middle [WR].

    Raises
    ------
    InvalidParameterError
        If there are fewer than 2 points or more than 16384.

    Examples
    --------
    >>> from hopper.spectral.chebyshev import nodes
    >>> nodes(3)
    array([-1.,  0.,  1.])
    """
    _require_points("n", n, 2, _MOST_POINTS)
    return _frozen(np.sin(np.pi * np.arange(1 - n, n, 2) / (2 * (n - 1))))


@checked
@lru_cache(maxsize=32)
def differentiation_matrix(n: int) -> Array:
    """Return the matrix, shape (n, n), that maps nodal values to the derivative's nodal values.

    Raises
    ------
    InvalidParameterError
        If there are fewer than 2 points or more than 16384.

    Examples
    --------
    >>> from hopper.spectral.chebyshev import differentiation_matrix, nodes
    >>> (differentiation_matrix(4) @ nodes(4) ** 2 / 2).round(12)
    array([-1. , -0.5,  0.5,  1. ])
    """
    _require_points("n", n, 2, _MOST_POINTS)
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


@checked
@lru_cache(maxsize=64)
def clenshaw_curtis_weights(n: int) -> Array:
    """Return the quadrature weights, shape (n,), exact for polynomials of degree n - 1 [Wa].

    Raises
    ------
    InvalidParameterError
        If there are fewer than 2 points or more than 16384.

    Examples
    --------
    >>> from hopper.spectral.chebyshev import clenshaw_curtis_weights, nodes
    >>> round(float(clenshaw_curtis_weights(5) @ nodes(5) ** 4), 12)
    0.4
    """
    _require_points("n", n, 2, _MOST_POINTS)
    even = np.arange(0, n, 2)
    moments = np.zeros(n)
    moments[::2] = 2.0 / (1.0 - even**2)
    weights = _cosine_transform(moments) / (n - 1)
    weights[[0, -1]] /= 2
    return _frozen(weights)


def _cosine_transform(values: Array) -> Array:
    """Return the discrete cosine transform of the first kind along the first axis."""
    mirrored = np.concatenate([values, values[-2:0:-1]])
    found: Any = np.fft.fft(mirrored, axis=0)[: len(values)]
    return found if np.iscomplexobj(values) else found.real.copy()


def _barycentric_weights(n: int) -> Array:
    weights = np.where(np.arange(n) % 2, -1.0, 1.0)
    weights[[0, -1]] /= 2
    return weights


@checked
def interpolation_matrix(n: int, x: RealRow) -> Array:
    """Return the matrix, shape (len(x), n), from nodal values to values at ``x`` [BTb].

    Raises
    ------
    InvalidParameterError
        If there are fewer than 2 points or more than 16384,
        or x is not a row of numbers near [-1, 1].

    Examples
    --------
    >>> from hopper.spectral.chebyshev import interpolation_matrix, nodes
    >>> (interpolation_matrix(4, [0.5]) @ nodes(4) ** 3).round(12)
    array([0.125])
    """
    gap = np.asarray(x)[:, None] - nodes(n)
    row, column = np.nonzero(np.abs(gap) < _AT_NODE)
    gap[row, column] = 1.0
    matrix = _barycentric_weights(n) / gap
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        matrix /= matrix.sum(axis=1, keepdims=True)
    if not np.isfinite(matrix).all():
        raise InvalidParameterError("x lies too far outside: keep it near [-1, 1]")
    matrix[row] = 0.0
    matrix[row, column] = 1.0
    return matrix


@checked
def coefficients(values: _Values) -> Array:
    """Return the Chebyshev coefficients of nodal ``values`` along the first axis, same shape.

    Raises
    ------
    InvalidParameterError
        If there are fewer than 2 values.

    Examples
    --------
    >>> from hopper.spectral.chebyshev import coefficients, nodes
    >>> coefficients(2 * nodes(4) ** 2 - 1).round(12) + 0.0
    array([0., 0., 1., 0.])
    """
    _require_rows(values, 2)
    n = len(values)
    result = _cosine_transform(values[::-1]) / (n - 1)
    result[[0, -1]] /= 2
    return result


@checked
@lru_cache(maxsize=64)
def half_nodes(m: int, *, centred: bool = False) -> Array:
    """Return the ``m`` points of a half grid, shape (m,): up to 1, from 0 if centred.

    Raises
    ------
    InvalidParameterError
        If there is no point, one only if centred, or there are more than 8192.
    """
    return _frozen(nodes(_full_size(m, centred))[-m:].copy())


def _fold(matrix: Array, m: int, parity: Parity, centred: bool) -> Array:
    """Restrict columns of a matrix on all values to the half grid of the given parity."""
    mirrored = matrix[:, m - 1 :: -1]
    folded = matrix[:, -m:] + mirrored if parity == "even" else matrix[:, -m:] - mirrored
    if centred:  # the point 0 mirrors itself
        folded[:, 0] /= 2
    return folded


@checked
@lru_cache(maxsize=128)
def half_differentiation_matrix(m: int, parity: Parity, *, centred: bool = False) -> Array:
    """Return the (m, m) derivative on the half grid of functions of the given parity.

    The derivative has the other parity.

    Raises
    ------
    InvalidParameterError
        As :func:`half_nodes`, and if the parity is unknown.
    """
    matrix = differentiation_matrix(_full_size(m, centred))[-m:]
    return _frozen(_fold(matrix, m, parity, centred))


@checked
def half_interpolation_matrix(
    m: int, x: RealLike, parity: Parity, *, centred: bool = False
) -> Array:
    """Return the matrix, shape (len(x), m), from half-grid values to values at ``x``.

    Raises
    ------
    InvalidParameterError
        As :func:`half_nodes`, and if x is not a row of numbers near [-1, 1] or the parity is
        unknown.
    """
    return _fold(interpolation_matrix(_full_size(m, centred), x), m, parity, centred)


@checked
def half_coefficients(values: _Values, parity: Parity) -> Array:
    """Return the ``m`` Chebyshev coefficients that parity leaves (T0, T2, ... or T1, T3, ...).

    Raises
    ------
    InvalidParameterError
        If there is no value, or the parity is unknown.
    """
    _require_rows(values, 1)
    mirrored = values[::-1] if parity == "even" else -values[::-1]
    return coefficients(np.concatenate([mirrored, values]))[0 if parity == "even" else 1 :: 2]


@checked
@lru_cache(maxsize=128)
def last_half_coefficients(m: int, parity: Parity, count: int) -> Array:
    """Return the matrix, shape (count, m), from half-grid values to the last coefficients.

    Raises
    ------
    InvalidParameterError
        As :func:`half_nodes`, and if the parity is unknown or count is not from 1 to m.
    """
    _full_size(m, centred=False)
    if not 1 <= count <= m:
        raise InvalidParameterError(f"count = {count} is out of range: give 1 to m = {m}")
    return _frozen(half_coefficients(np.eye(m), parity)[-count:].copy())


@checked
def integrate_odd(values: Array) -> Array:
    """Return the integral from 0 of an odd function on the half grid; even, shape (m,).

    Raises
    ------
    InvalidParameterError
        If the values are not a row of numbers.
    """
    m = len(require_row("values", values))
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
