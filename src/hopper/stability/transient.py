"""Transient growth: the norm of exp(-t M) on the converged part of the spectrum, and its bounds.

Going down the hopper t = log r decreases; ``elapsed`` = -t >= 0 below. With the kept eigenvectors
V = Q R, exp(-t M) acts on their span as R exp(elapsed Lambda) R^-1, and

    exp(elapsed alpha) <= ||exp(-t M)|| <= kappa(V) exp(elapsed alpha),    (4.11)

where alpha is the largest real part and kappa(V) = ||V|| ||V^-1|| for columns of unit norm. Both
parities are orthogonal to each other in both norms, so each is treated by itself.
"""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.spectral.transient import ModalBasis, basis_of
from hopper.stability.collocation import Half, half_matrix

Norm = Literal["discrete", "L2"]
NORMS: tuple[Norm, ...] = ("discrete", "L2")


def half_weights(m: int, norm: Norm) -> Array:
    """Return the weights, shape (2 m - 1,), of the norm on a half grid of ``m`` nodes.

    ``discrete`` is the 2-norm of nodal values, presumably the paper's; ``L2`` has
    Clenshaw-Curtis weights, for theta / theta_w in [-1, 1].

    Raises
    ------
    InvalidParameterError
        If the norm is unknown.
    """
    if norm == "discrete":
        return np.full(2 * m - 1, 2.0)
    if norm == "L2":
        weights = 2 * chebyshev.clenshaw_curtis_weights(2 * m)[m:]
        return np.concatenate([weights, weights[:-1]])
    raise InvalidParameterError(f"norm = {norm!r} is unknown: use one of {', '.join(NORMS)}")


def modal_basis(
    solution: RadialSolution,
    n: int,
    half: Half,
    kept: ArrayLike,
    norm: Norm = "L2",
    psi_scale: float = 1.0,
) -> ModalBasis:
    """Return the basis of the kept modes of one parity on a mesh of ``n`` nodes.

    Parameters
    ----------
    solution : RadialSolution
        Radial solution of a Mohr-Coulomb material.
    n : int
        Nodes on the full interval, even.
    half : "physical" or "mirrored"
        Parity of the modes.
    kept : complex array, shape (k,)
        Eigenvalues to keep, closed under conjugation.
    norm : "discrete" or "L2"
        As in :func:`half_weights`.
    psi_scale : float
        Unknowns are (sigma1, psi1 / psi_scale): 1 as defined, 2 as printed.

    Raises
    ------
    InvalidParameterError
        If nothing is kept, an eigenvalue is not one of this mesh, or the norm is unknown.
    TangencyError
        If psi reaches pi/4 - delta/2.
    """
    wanted = np.asarray(kept, dtype=complex)
    if wanted.size == 0:
        raise InvalidParameterError(
            f"no {half} eigenvalue is kept: widen the filter's tolerance or use finer meshes"
        )
    matrix = half_matrix(solution, n // 2, half, psi_scale)
    return basis_of(matrix, half_weights(n // 2, norm), wanted)
