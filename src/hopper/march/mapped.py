"""Chebyshev collocation on [-1, 1] with points drawn towards even spacing.

The map x = arcsin(beta xi) / arcsin(beta) of the Chebyshev points xi [KT] lets explicit steps be
longer by a factor of about 3 and waves be resolved by fewer points than the bare points do.

References
----------
.. [KT] D. Kosloff, H. Tal-Ezer, A modified Chebyshev pseudospectral method with an O(N^-1) time
   step restriction, J. Comput. Phys. 104 (1993).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.spectral import chebyshev

# beta = sech(this / n): the map's own error is about exp(-this) of what it interpolates.
_DECAY = 16.0


@dataclass(frozen=True, eq=False)
class Mesh:
    """Points x (n,), differentiation matrix (n, n), and the modulus of its largest eigenvalue.

    The eigenvalue is that with the value at -1 held. ``x`` is odd about the middle; n is even, so
    no point is 0.
    """

    x: Array
    derivative: Array
    radius: float
    beta: float

    __repr__ = brief("x", "radius")

    def interpolation(self, x: Array) -> Array:
        """Return the matrix from nodal values to values at ``x`` in [-1, 1], shape (len(x), n)."""
        xi = np.sin(np.arcsin(self.beta) * x) / self.beta
        return chebyshev.interpolation_matrix(self.x.size, np.clip(xi, -1, 1))


@lru_cache(maxsize=16)
def mesh(n: int) -> Mesh:
    """Return the mesh of ``n`` points, n even; its arrays are read-only."""
    beta = 1 / np.cosh(_DECAY / n)
    xi = chebyshev.nodes(n)
    x = np.arcsin(beta * xi) / np.arcsin(beta)
    stretch = np.arcsin(beta) * np.sqrt(1 - (beta * xi) ** 2) / beta
    derivative = stretch[:, None] * chebyshev.differentiation_matrix(n)
    radius = float(np.abs(np.linalg.eigvals(derivative[1:, 1:])).max())
    x.flags.writeable = derivative.flags.writeable = False
    return Mesh(x, derivative, radius, float(beta))
