"""Half grids for functions of known parity over the polar angle.

References
----------
.. [TT] T. W. Tee, L. N. Trefethen, A rational spectral collocation method with adaptively
   transformed Chebyshev grid points, SIAM J. Sci. Comput. 28 (2006).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import asin, asinh, hypot, sinh, tanh

import numpy as np

from hopper.arguments import Positive, Radians, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.problem import Hopper
from hopper.spectral import chebyshev

# tau theta_w from which on the layer at the apex of a wedge has points of its own.
_WEDGE_LAYER = 10.0
_BISECTIONS = 60
_PARITIES: tuple[chebyshev.Parity, ...] = ("even", "odd")


@dataclass(frozen=True)
class Map:
    """Odd map of a half grid's Chebyshev points x on [0, 1] to theta / theta_w.

    ``clustering`` > 0 draws points to the apex by a sinh map [TT]. ``bend`` in (0, pi/2) draws them
    to the wall by a sine map whose slope vanishes at a point beyond it: a square root there is
    smooth on the grid. ``kink`` = (place, width) in (0, 1] gives half of the points, spaced
    logarithmically, to a kink.
    """

    clustering: float = 0.0
    bend: float = 0.0
    kink: tuple[float, float] | None = None

    @property
    def plain(self) -> bool:
        """Whether other solutions can use it too."""
        return not self.bend and self.kink is None

    @checked
    def forward(self, x: Array) -> tuple[Array, Array]:
        """Return theta / theta_w and its slope at ``x``, shape (n,)."""
        y, stretch = x, np.ones_like(x)
        if self.bend:
            y = np.sin(self.bend * x) / np.sin(self.bend)
            stretch = self.bend * np.cos(self.bend * x) / np.sin(self.bend)
        if self.kink:
            y = self._bisected(x)
            stretch = 1 / self._kinked(y)[1]
        if self.clustering:
            scale = np.sinh(self.clustering)
            stretch = stretch * self.clustering * np.cosh(self.clustering * y) / scale
            y = np.sinh(self.clustering * y) / scale
        return y, stretch

    @checked
    def inverse(self, y: Array) -> Array:
        """Return x at theta / theta_w = ``y``, shape (n,)."""
        if self.clustering:
            y = np.arcsinh(y * np.sinh(self.clustering)) / self.clustering
        if self.kink:
            y = self._kinked(y)[0]
        if self.bend:
            y = np.arcsin(np.clip(y, -1, 1) * np.sin(self.bend)) / self.bend
        return np.clip(y, -1, 1)

    @checked
    def on_clustered(self, y: float) -> tuple[float, float]:
        """Return where theta / theta_w = ``y`` > 0 is before clustering, and the slope there."""
        if not self.clustering:
            return y, 1.0
        scale = sinh(self.clustering)
        return asinh(y * scale) / self.clustering, scale / self.clustering / hypot(1, y * scale)

    def _kinked(self, y: Array) -> tuple[Array, Array]:
        """Return half y, half the sum of its distances to the kinks on a logarithmic scale."""
        place, width = self.kink or (0.0, 1.0)
        ends = asinh((1 - place) / width) + asinh((1 + place) / width)
        below, above = (y - place) / width, (y + place) / width
        x = (y + (np.arcsinh(below) + np.arcsinh(above)) / ends) / 2
        slope = (1 + (1 / np.hypot(1, below) + 1 / np.hypot(1, above)) / (ends * width)) / 2
        return x, slope

    def _bisected(self, x: Array) -> Array:
        low, high = np.zeros_like(x), np.ones_like(x)
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            left = self._kinked(middle)[0] < x
            low, high = np.where(left, middle, low), np.where(left, high, middle)
        return np.where(x == 1, 1.0, (low + high) / 2)


@dataclass(frozen=True, eq=False)
class Grid:
    """Half grid on [0, theta_w].

    Attributes
    ----------
    theta : array, shape (m,)
        Radians. The first point is the axis on a ``centred`` grid, and off it on others.
    cot, cos, sin : arrays, shape (m,)
        Of theta; cot is 0 on the axis, where only what has no cot may be evaluated.
    d_even, d_odd : arrays, shape (m, m)
        Derivatives of functions of known parity.
    stretch : array, shape (m,)
        d theta / d x, x the Chebyshev points.
    weights : array, shape (m,)
        Of the integral of an even function from 0 to theta_w.
    axis_row : array, shape (m,)
        Value of an even function on the axis.
    """

    half_angle: float
    map: Map
    centred: bool
    theta: Array
    cot: Array
    cos: Array
    sin: Array
    d_even: Array
    d_odd: Array
    stretch: Array
    weights: Array
    axis_row: Array

    __repr__ = brief("size", "half_angle deg", "map")

    @property
    def size(self) -> int:
        """Number of points m."""
        return self.theta.size

    @checked
    def interpolation(self, theta: Array, parity: chebyshev.Parity) -> Array:
        """Return the matrix from half-grid values to values at ``theta``, shape (n, m)."""
        x = self.map.inverse(theta / self.half_angle)
        return chebyshev.half_interpolation_matrix(self.size, x, parity, centred=self.centred)


@checked
@lru_cache(maxsize=256)
def half_grid(
    size: int, half_angle: Radians, clustering: float = 0.0, *, centred: bool = False
) -> Grid:
    """Return the grid of ``size`` points on (0, half_angle], radians, or with the axis if centred.

    Its arrays are read-only.

    Examples
    --------
    >>> from hopper.radial.grid import half_grid
    >>> grid = half_grid(8, half_angle=0.2)
    >>> round(float(grid.weights @ grid.theta**2) * 3 / 0.2**3, 12)
    1.0
    """
    return mapped_grid(size, half_angle, Map(clustering), centred=centred)


@checked
def mapped_grid(size: int, half_angle: float, by: Map, *, centred: bool = False) -> Grid:
    """Return the grid of ``size`` points under a map, as :func:`half_grid`."""
    unit = _unit_grid if by.plain else _unit_grid.__wrapped__
    y, stretch, weights, axis_row, d_even, d_odd = unit(size, by, centred)
    theta = half_angle * y
    grid = Grid(
        half_angle=half_angle,
        map=by,
        centred=centred,
        theta=theta,
        cot=np.divide(1.0, np.tan(theta), out=np.zeros(size), where=theta != 0),
        cos=np.cos(theta),
        sin=np.sin(theta),
        d_even=d_even / half_angle,
        d_odd=d_odd / half_angle,
        stretch=half_angle * stretch,
        weights=half_angle * weights,
        axis_row=axis_row,
    )
    for value in vars(grid).values():
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return grid


@lru_cache(maxsize=256)
def _unit_grid(size: int, by: Map, centred: bool) -> tuple[Array, ...]:
    """Return what a grid of half angle 1 has, most of the work: sweeps change the half angle."""
    y, stretch = by.forward(chebyshev.half_nodes(size, centred=centred))
    weights = chebyshev.clenshaw_curtis_weights(2 * size - centred)[-size:] * stretch
    weights[0] /= 1 + centred  # half of the point on the axis belongs to the other side
    even, odd = (
        chebyshev.half_differentiation_matrix(size, parity, centred=centred) / stretch[:, None]
        for parity in _PARITIES
    )
    axis_row = chebyshev.half_interpolation_matrix(size, 0.0, "even", centred=centred)[0]
    return y, stretch, weights, axis_row, even, odd


@checked
@lru_cache(maxsize=64)
def disc_weights(grid: Grid) -> Array:
    """Return weights of the integral of an even function times sin(theta) from 0 to theta_w.

    They are positive and as accurate as the interpolant; those of the plain integral times
    sin(theta) are not, as |sin(theta)| has a kink on the axis.
    """
    x, weight = np.polynomial.legendre.leggauss(grid.size + 32)
    y, stretch = grid.map.forward((1 + x) / 2)
    theta = grid.half_angle * y
    measure = weight / 2 * grid.half_angle * stretch
    weights = (measure * np.sin(theta)) @ grid.interpolation(theta, "even")
    weights.flags.writeable = False
    return weights


@checked
def transfer(old: Grid, new: Grid, parity: chebyshev.Parity) -> Array:
    """Return the matrix, shape (m_new, m_old), from one grid to another.

    Functions are stretched where the half angles differ.
    """
    if old.map.plain and new.map.plain:
        key = (old.size, old.map, old.centred, new.size, new.map, new.centred)
        return _kept_transfer(*key, parity)
    return old.interpolation(new.theta * (old.half_angle / new.half_angle), parity)


@lru_cache(maxsize=512)
def _kept_transfer(
    size: int, by: Map, centred: bool, other: int, to: Map, midpoint: bool, parity: chebyshev.Parity
) -> Array:
    """Return the matrix between grids of any half angle."""
    y, _ = to.forward(chebyshev.half_nodes(other, centred=midpoint))
    matrix = chebyshev.half_interpolation_matrix(size, by.inverse(y), parity, centred=centred)
    matrix.flags.writeable = False
    return matrix


@checked
def wall_bend(clustering: float, excess: Positive) -> float:
    """Return the bend for a square root at theta_w (1 + excess) under that clustering."""
    if clustering:
        excess *= tanh(clustering) / clustering
    return asin(1 / (1 + excess))


@checked
def layer_clustering(hopper: Hopper, tau: float) -> float:
    """Return the clustering that resolves the layer at the apex, of width 1 / tau.

    A whole number, so that grids can be kept. The factors are those with which modes of cones
    need the fewest points, measured for tau theta_w from 0.3 to 30; wedges do without up to 10.
    """
    width = tau * hopper.half_angle
    if not hopper.curvature and width < _WEDGE_LAYER:
        return 0.0
    return float(round(max(0.0, 1.3 * asinh(width / 3))))
