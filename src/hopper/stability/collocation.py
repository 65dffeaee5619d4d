"""Chebyshev collocation of the stability operator in tilted time, M' = J (D + K).

Its eigenvalues are those of M = A D + F, (4.2), for every radial solution. Disturbances are
*symmetric* (sigma1 even and psi1 odd, as the flow is) or *asymmetric* (the reverse), which is
smooth at the apex of a wedge and singular at that of a cone. psi1 vanishes at the wall; sigma1 is
free.
"""

from typing import Literal

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.problem import Geometry
from hopper.radial.grid import Grid, half_grid, layer_clustering
from hopper.radial.solution import RadialSolution
from hopper.stability.tilted import TiltedCoefficients, on_grids

Parity = Literal["symmetric", "asymmetric"]
PARITIES: tuple[Parity, Parity] = ("symmetric", "asymmetric")


@checked
def parities_of(geometry: Geometry) -> tuple[Parity, ...]:
    """Return the parities that are disturbances: both of a wedge, the flow's of a cone."""
    return PARITIES if geometry == "wedge" else PARITIES[:1]


@checked
def mode_grid(solution: RadialSolution, m: int, parity: Parity) -> Grid:
    """Return the half grid of ``m`` points on which modes of a solution are collocated.

    Points are drawn to the apex where the radial solution has a layer there. With a point on the
    axis, asymmetric disturbances have no grid mode: on an even number of points sigma1 = T_(N-1) is
    one that the second equation does not see.
    """
    hopper = solution.hopper
    clustering = layer_clustering(hopper, solution.member.tau)
    return half_grid(m, hopper.half_angle, clustering, centred=parity == "asymmetric")


@checked
def tilted_matrix(solution: RadialSolution, m: int, parity: Parity = "symmetric") -> Array:
    """Return M' on ``m`` half-grid points, shape (2 m - 1, 2 m - 1), or (2 m - 2, 2 m - 2).

    Unknowns of symmetric disturbances: sigma1 at theta_1 < ... < theta_m = theta_w, then psi1 at
    the first m - 1. Of asymmetric ones: sigma1 at theta_2 ... theta_m, as it vanishes on the axis
    theta_1 = 0, then psi1 at the first m - 1.

    Raises
    ------
    InvalidParameterError
        If m < 3, the parity is unknown or singular at the apex of a cone, or the material is not
        Mohr-Coulomb.
    """
    require_disturbance(solution.hopper.geometry, parity)
    if m < 3:
        raise InvalidParameterError(f"m = {m!r} half-grid points: give at least 3")
    grid = mode_grid(solution, m, parity)
    (at,) = on_grids(solution, [grid])
    return assemble(grid, at)


@checked
def require_disturbance(geometry: Geometry, parity: str) -> None:
    """Check that disturbances of a parity are smooth at the apex.

    Raises
    ------
    InvalidParameterError
        If they are not, or the parity is unknown.
    """
    if parity not in PARITIES:
        raise InvalidParameterError(f"parity = {parity!r} is unknown: use {' or '.join(PARITIES)}")
    if parity not in parities_of(geometry):
        raise InvalidParameterError(
            "asymmetric disturbances are singular at the apex of a cone: use symmetric"
        )


@checked
def assemble(grid: Grid, at: TiltedCoefficients) -> Array:
    """Return the matrix from the coefficients on its grid: asymmetric if the grid is centred.

    Coefficients of shape (..., m) give matrices of shape (..., n, n).
    """
    m, node = grid.size, np.arange(grid.size)
    d_sigma, d_psi = (grid.d_odd, grid.d_even) if grid.centred else (grid.d_even, grid.d_odd)
    matrix = np.zeros((*at.f11.shape[:-1], 2 * m, 2 * m))
    np.multiply(at.j12[..., None], d_psi, out=matrix[..., :m, m:])
    np.multiply(at.j21[..., None], d_sigma, out=matrix[..., m:, :m])
    matrix[..., node, node] = at.f11
    matrix[..., node, m + node] += at.f12
    matrix[..., m + node, node] += at.f21
    matrix[..., m + node, m + node] = at.f22
    inner = slice(int(grid.centred), -1)
    return matrix[..., inner, inner]
