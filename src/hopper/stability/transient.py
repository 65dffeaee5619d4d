"""Transient growth: the norm of exp(-t M) on the converged part of the spectrum, and its bounds.

Going down the hopper t = log r decreases; ``elapsed`` = -t >= 0 below. With the kept eigenvectors
V = Q R, exp(-t M) acts on their span as R exp(elapsed Lambda) R^-1, and

    exp(elapsed alpha) <= ||exp(-t M)|| <= kappa(V) exp(elapsed alpha),    (4.11)

where alpha is the largest real part and kappa(V) = ||V|| ||V^-1|| for columns of unit norm. Both
parities are orthogonal to each other in both norms, so each is treated by itself.

Norms depend on the frame, t = log r or tilted time, and on the unknowns. What the paper drew is in
its own, with unknowns (sigma1, psi1 / psi_scale); numbers for one hopper are in tilted time.
"""

from typing import Literal

import numpy as np

from hopper.arguments import Positive, checked
from hopper.arrays import Array, Complex
from hopper.errors import InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.grid import Grid, disc_weights, half_grid
from hopper.radial.solution import RadialSolution
from hopper.spectral.transient import ModalBasis, basis_of
from hopper.stability.collocation import Parity, mode_grid, tilted_matrix
from hopper.stability.paper_matrix import Half, half_matrix

Norm = Literal["discrete", "L2"]
NORMS: tuple[Norm, ...] = ("discrete", "L2")


@checked
def half_weights(hopper: Hopper, m: int, norm: Norm) -> Array:
    """Return the weights, shape (2 m - 1,), of a norm of (sigma1, psi1) on a half grid of m nodes.

    ``discrete`` is the 2-norm of nodal values, presumably the paper's. ``L2`` is that over the
    hopper's cross-section, theta / theta_w in [-1, 1]: in cones with the weight sin(theta), without
    which growth is not bounded, because waves focus on the axis.

    Raises
    ------
    InvalidParameterError
        If the norm is unknown.
    """
    grid = half_grid(m, hopper.half_angle)
    return np.full(2 * m - 1, 2.0) if norm == "discrete" else _l2_weights(hopper, grid)


def _l2_weights(hopper: Hopper, grid: Grid) -> Array:
    weights = 2 * grid.weights / hopper.half_angle
    if hopper.curvature:
        weights = 2 * disc_weights(grid) / (hopper.half_angle * np.sin(hopper.half_angle))
    first = int(grid.centred)
    return np.concatenate([weights[first:], weights[:-1]])


@checked
def tilted_basis(solution: RadialSolution, m: int, parity: Parity, kept: Complex) -> ModalBasis:
    """Return the basis of kept modes of one parity in tilted time, in the norm L2.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    m : int
        Points of the half grid.
    parity : "symmetric" or "asymmetric"
        Of the disturbances.
    kept : complex array, shape (k,)
        Eigenvalues to keep, closed under conjugation.

    Raises
    ------
    InvalidParameterError
        If nothing is kept, or an eigenvalue is not one of this mesh.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.spectral.transient import condition_number
    >>> from hopper.stability.low_modes import upper_eigenvalues
    >>> from hopper.stability.transient import tilted_basis
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> mode = upper_eigenvalues(solution, 32)[1]
    >>> basis = tilted_basis(solution, 32, "symmetric", [mode, mode.conj()])
    >>> basis.size
    2
    """
    grid = mode_grid(solution, m, parity)
    weights = _l2_weights(solution.hopper, grid)
    return basis_of(tilted_matrix(solution, m, parity), weights, _some(kept, parity))


@checked
def modal_basis(
    solution: RadialSolution,
    n: int,
    half: Half,
    kept: Complex,
    norm: Norm = "L2",
    psi_scale: Positive = 1.0,
) -> ModalBasis:
    """Return the basis of the kept modes of one parity in the paper's frame, on ``n`` nodes.

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
    """
    matrix = half_matrix(solution, n // 2, half, psi_scale)
    return basis_of(matrix, half_weights(solution.hopper, n // 2, norm), _some(kept, half))


def _some(kept: Complex, parity: str) -> Complex:
    if kept.size == 0:
        raise InvalidParameterError(
            f"no {parity} eigenvalue is kept: widen the filter's tolerance or use finer meshes"
        )
    return kept
