"""Half grids for functions of known parity over the polar angle.

References
----------
.. [TT] T. W. Tee, L. N. Trefethen, A rational spectral collocation method with adaptively
   transformed Chebyshev grid points, SIAM J. Sci. Comput. 28 (2006).
"""

from dataclasses import dataclass
from functools import lru_cache, partial
from math import asinh

import numpy as np

from hopper.arguments import Radians, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.problem import Hopper
from hopper.spectral import chebyshev
from hopper.values import require_angle

# tau theta_w from which wedges have a layer that needs clustering.
_THIN = 30.0


@dataclass(frozen=True, eq=False)
class Grid:
    """Half grid on [0, theta_w]; ``clustering`` > 0 draws points to the apex by a sinh map [TT].

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
    clustering: float
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

    __repr__ = brief("size", "half_angle deg", "clustering")

    @property
    def size(self) -> int:
        """Number of points m."""
        return self.theta.size

    @checked
    def interpolation(self, theta: Array, parity: chebyshev.Parity) -> Array:
        """Return the matrix from half-grid values to values at ``theta``, shape (n, m)."""
        x = theta / self.half_angle
        if self.clustering:
            x = np.arcsinh(x * np.sinh(self.clustering)) / self.clustering
        return chebyshev.half_interpolation_matrix(
            self.size, np.clip(x, -1, 1), parity, centred=self.centred
        )


@checked
@lru_cache(maxsize=256)
def half_grid(
    size: int, half_angle: Radians, clustering: float = 0.0, *, centred: bool = False
) -> Grid:
    """Return the grid of ``size`` points on (0, half_angle], radians, or with the axis if centred.

    Its arrays are read-only.
    """
    require_angle("half_angle", half_angle)
    x = chebyshev.half_nodes(size, centred=centred)
    theta, stretch = _mapped(x, half_angle, clustering)
    weights = chebyshev.clenshaw_curtis_weights(2 * size - centred)[-size:] * stretch
    weights[0] /= 1 + centred  # half of the point on the axis belongs to the other side
    derivative = partial(chebyshev.half_differentiation_matrix, size)
    grid = Grid(
        half_angle=half_angle,
        clustering=clustering,
        centred=centred,
        theta=theta,
        cot=np.divide(1.0, np.tan(theta), out=np.zeros(size), where=theta != 0),
        cos=np.cos(theta),
        sin=np.sin(theta),
        d_even=derivative("even", centred=centred) / stretch[:, None],
        d_odd=derivative("odd", centred=centred) / stretch[:, None],
        stretch=stretch,
        weights=weights,
        axis_row=chebyshev.half_interpolation_matrix(size, 0.0, "even", centred=centred)[0],
    )
    for value in vars(grid).values():
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return grid


def _mapped(x: Array, half_angle: float, clustering: float) -> tuple[Array, Array]:
    """Return theta and d theta / d x at Chebyshev coordinates."""
    if not clustering:
        return half_angle * x, np.full(x.size, half_angle)
    scale = half_angle / np.sinh(clustering)
    return scale * np.sinh(clustering * x), scale * clustering * np.cosh(clustering * x)


@lru_cache(maxsize=64)
def disc_weights(grid: Grid) -> Array:
    """Return weights of the integral of an even function times sin(theta) from 0 to theta_w.

    They are positive and as accurate as the interpolant; those of the plain integral times
    sin(theta) are not, as |sin(theta)| has a kink on the axis.
    """
    x, weight = np.polynomial.legendre.leggauss(grid.size + 32)
    theta, stretch = _mapped((1 + x) / 2, grid.half_angle, grid.clustering)
    weights = (weight / 2 * np.sin(theta) * stretch) @ grid.interpolation(theta, "even")
    weights.flags.writeable = False
    return weights


@checked
@lru_cache(maxsize=512)
def transfer(old: Grid, new: Grid, parity: chebyshev.Parity) -> Array:
    """Return the matrix, shape (m_new, m_old), from one grid to another.

    Functions are stretched where the half angles differ.
    """
    matrix = old.interpolation(new.theta * (old.half_angle / new.half_angle), parity)
    matrix.flags.writeable = False
    return matrix


@checked
def layer_clustering(hopper: Hopper, tau: float) -> float:
    """Return the clustering that resolves the layer at the apex, of width 1 / tau.

    In steps of a half, so that grids can be kept. The factors are those with which modes need the
    fewest points, measured for tau theta_w from 0.3 to 30; in wedges up to there none is best.
    """
    width = tau * hopper.half_angle
    if not hopper.curvature and width < _THIN:
        return 0.0
    return 0.5 * round(2 * max(0.0, 1.3 * asinh(width / 3)))
