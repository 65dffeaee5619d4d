"""Numbers over a box, interpolated between nodes that crowd at its faces and hold its corners."""

import numpy as np

from hopper.arguments import RealLike, checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError


@checked
def interpolation_nodes(count: int) -> Array:
    """Return Chebyshev's extreme points on [0, 1], shape (count,); the middle if it is one.

    Raises
    ------
    InvalidParameterError
        If there are not 1 to 33 of them: Lagrange's form is for few.
    """
    if not 1 <= count <= 33:
        raise InvalidParameterError(f"count = {count} is out of range: give 1 to 33")
    if count == 1:
        return np.array([0.5])
    return (1 - np.cos(np.pi * np.arange(count) / (count - 1))) / 2


@checked
def interpolated(table: RealLike, points: RealLike) -> Array:
    """Return the interpolant at points, shape (n, d), from a table of d axes of equal length.

    Raises
    ------
    InvalidParameterError
        If the shapes do not go together.

    Examples
    --------
    >>> from hopper.uncertainty.interpolation import interpolated, interpolation_nodes
    >>> interpolated(interpolation_nodes(5) ** 3, [[0.5]])
    array([0.125])
    """
    values, places = np.asarray(table, dtype=float), np.asarray(points, dtype=float)
    if places.ndim != 2 or values.ndim != places.shape[1] or len(set(values.shape)) > 1:
        raise InvalidParameterError(
            f"table of shape {values.shape} has not as many equal axes as points of shape "
            f"{places.shape} have coordinates"
        )
    if not values.ndim:
        return np.full(len(places), values.item())
    found = np.broadcast_to(values, (len(places), *values.shape))
    for axis in range(values.ndim):
        weights = _weights(interpolation_nodes(values.shape[0]), places[:, axis])
        found = np.einsum("pi,pi...->p...", weights, found)
    return found


def _weights(nodes: Array, places: Array) -> Array:
    """Return Lagrange's polynomials of the nodes at places, shape (places, nodes)."""
    own = np.eye(nodes.size, dtype=bool)
    away = np.where(own, 1.0, places[:, None, None] - nodes[None, None, :])
    apart = nodes[:, None] - nodes[None, :] + own
    return (away / apart).prod(axis=2)
