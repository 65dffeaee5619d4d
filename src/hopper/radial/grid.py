"""Half grids for functions of known parity over the polar angle.

References
----------
.. [TT] T. W. Tee, L. N. Trefethen, A rational spectral collocation method with adaptively
   transformed Chebyshev grid points, SIAM J. Sci. Comput. 28 (2006).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.spectral import chebyshev


@dataclass(frozen=True)
class Grid:
    """Half grid on (0, theta_w]; ``clustering`` > 0 draws points to the apex by a sinh map [TT]."""

    half_angle: float
    clustering: float
    theta: Array
    cot: Array
    cos: Array
    sin: Array
    d_even: Array
    d_odd: Array
    axis_row: Array

    __repr__ = brief("size", "half_angle deg", "clustering")

    @property
    def size(self) -> int:
        """Number of points m."""
        return self.theta.size

    def interpolation(self, theta: Array, parity: chebyshev.Parity) -> Array:
        """Return the matrix from half-grid values to values at ``theta``, shape (n, m)."""
        x = theta / self.half_angle
        if self.clustering:
            x = np.arcsinh(x * np.sinh(self.clustering)) / self.clustering
        return chebyshev.half_interpolation_matrix(self.size, np.clip(x, -1, 1), parity)


@lru_cache(maxsize=128)
def half_grid(size: int, half_angle: float, clustering: float = 0.0) -> Grid:
    """Return the grid of ``size`` points on (0, half_angle], radians."""
    x = chebyshev.half_nodes(size)
    if clustering:
        scale = half_angle / np.sinh(clustering)
        theta = scale * np.sinh(clustering * x)
        stretch = scale * clustering * np.cosh(clustering * x)
    else:
        theta, stretch = half_angle * x, np.full(size, half_angle)
    grid = Grid(
        half_angle=half_angle,
        clustering=clustering,
        theta=theta,
        cot=1 / np.tan(theta),
        cos=np.cos(theta),
        sin=np.sin(theta),
        d_even=chebyshev.half_differentiation_matrix(size, "even") / stretch[:, None],
        d_odd=chebyshev.half_differentiation_matrix(size, "odd") / stretch[:, None],
        axis_row=chebyshev.half_interpolation_matrix(size, 0.0, "even")[0],
    )
    for array in (grid.theta, grid.cot, grid.cos, grid.sin, grid.d_even, grid.d_odd, grid.axis_row):
        array.flags.writeable = False
    return grid
