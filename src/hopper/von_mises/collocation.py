"""Chebyshev collocation of the linearised von Mises equations, in a tilted time.

With t' = t - f(theta), modes exp(-lambda t) u = exp(-lambda t') exp(-lambda f) u keep their lambda,
but exp(-lambda f) u can be the smoother function. The four characteristics have slopes dt/dtheta
whose mean is -a, a = sqrt(3) q / (2 c); with f' = -a, exp(f) = u0**(1/4), none of them turns as
fast near psi = pi/4 as one of them does in t: with 20 half nodes errors are a hundred times smaller
at high friction, and the same along smooth walls. Where a characteristic lies in t' = const the
matrix has a pole, which the equations have not; it matters only to a node next to it.

Unknowns S, Y, U, W on a half grid of n points. In the tilted time the equations of
:mod:`hopper.von_mises.linearisation` read, for a mode, with F the right-hand sides without d/dt,

    lambda (R + a Q) = F_R = 3 R + Q' + (l + cot) Q - 2 B
    lambda (Q + a P) = F_T = 4 Q + P' + l P + 2 s cot Z
    lambda (U + a W) = F_D = W' + (cot - h) W
    lambda (W - a U) = F_L = -3 W + U' + 4 sqrt(3) / c**2 Y

and Z = c / sqrt(12) (lambda U - 2 cot W). The last two give lambda U and lambda W, so Z, and
lambda Z from the same two applied to lambda u; the first two then give lambda S and lambda Y.
At the wall W = 0 and Y = k W' stand for the second and the fourth, so that neither is an unknown.
"""

from functools import lru_cache
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.radial.grid import Grid, half_grid
from hopper.radial.solution import RadialSolution
from hopper.von_mises.linearisation import Coefficients, coefficients

LEAST_NODES = 4


@checked
def mode_matrix(solution: RadialSolution, n: int) -> Array:
    """Return M of M u = lambda u on a half grid of ``n`` nodes, shape (4 n - 2, 4 n - 2).

    Unknowns: S at theta_1 < ... < theta_n = theta_w, Y at the first n - 1 of them, U at all, W at
    the first n - 1, each times exp(-lambda f). The flow rate, U = 1, is an exact mode with
    lambda = 0.

    Raises
    ------
    InvalidParameterError
        If n < 4, or the material is not von Mises.
    SingularVelocityError
        If psi reaches pi/4.
    """
    if n < LEAST_NODES:
        raise InvalidParameterError(f"n = {n!r} half-grid nodes: give at least {LEAST_NODES}")
    grid = half_grid(n, solution.hopper.half_angle)
    return assemble(grid, coefficients(solution, [grid])[0])


@checked
def assemble(grid: Grid, at: Coefficients) -> Array:
    """Return :func:`mode_matrix` on a half grid from the coefficients at its points."""
    n = grid.size
    S, Y, U, W = _unknowns(n)
    Y = Y.copy()
    Y[-1, 3 * n - 1 :] = at.wall * grid.d_odd[-1, :-1]
    lU, lW = flow_rates(grid, at, Y, U, W)
    lU[-1] = grid.d_odd[-1] @ W
    lW[-1] = 0.0
    lS, lY, of_wall = stress_rates(grid, at, (S, Y, U, W), (lU, lW))
    # At the wall the first equation alone gives lambda S, with lambda Y = k (lambda W)'.
    lS[-1] = (of_wall - at.stress_rate[1, -1] * at.wall * (grid.d_odd[-1] @ lW)) / at.stress_rate[
        0, -1
    ]
    return np.concatenate([lS, lY[:-1], lU, lW[:-1]])


@checked
def flow_rates(grid: Grid, at: Coefficients, Y: Array, U: Array, W: Array) -> tuple[Array, Array]:
    """Return lambda U and lambda W by nodal values, all of shape (n, k)."""
    a, one = at.tilt, 1 + at.tilt**2
    FD = grid.d_odd @ W + _rows(at.cot - at.h, W)
    FL = grid.d_even @ U - 3 * W + _rows(4 * sqrt(3) / at.c**2, Y)
    return _rows(1 / one, FD) - _rows(a / one, FL), _rows(1 / one, FL) + _rows(a / one, FD)


@checked
def stress_rates(
    grid: Grid,
    at: Coefficients,
    unknowns: tuple[Array, Array, Array, Array],
    flow: tuple[Array, Array],
) -> tuple[Array, Array, Array]:
    """Return lambda S and lambda Y, shape (n, k), and F_R in the last node, shape (k,).

    ``unknowns`` are S, Y, U and W, ``flow`` lambda U and lambda W, by nodal values.
    """
    (S, Y, _, W), (lU, lW) = unknowns, flow
    s, m, c, q, a, cot = at.s, at.m, at.c, at.q, at.tilt, at.cot
    Z = _rows(c / sqrt(12), lU) - _rows(c * cot / sqrt(3), W)
    Q = -_rows(s * q, S) - _rows(2 * s * c, Y)
    P = _rows(1 + m * c, S) - _rows(2 * m * q, Y) + s * Z
    # 3 R - 2 B.
    FR = _rows(1 - 8 * m * c, S) + _rows(16 * m * q, Y) + grid.d_odd @ Q + _rows(at.l + cot, Q)
    FT = 4 * Q + grid.d_even @ P + _rows(at.l, P) + _rows(2 * s * cot, Z)
    # lambda Z times sqrt(12) / c, without its part in lambda Y.
    one = 1 + a**2
    lZ = _rows(1 / one, grid.d_odd @ lW) - _rows(a / one, grid.d_even @ lU)
    lZ += _rows((cot - at.h + 3 * a) / one - 2 * cot, lW)
    FT -= _rows(a * s * c / sqrt(12), lZ)
    rs, ry, ts, ty = at.stress_rate
    determinant = rs * ty - ry * ts
    lS = _rows(ty / determinant, FR) - _rows(ry / determinant, FT)
    lY = _rows(rs / determinant, FT) - _rows(ts / determinant, FR)
    return lS, lY, FR[-1]


@checked
def without_flow_rate(matrix: Array) -> Array:
    """Return the matrix of all modes but that of the flow rate, one row and column smaller.

    The mode is known by its eigenvector, U = 1 and the rest 0: U enters the equations by its
    differences only, so those from the wall are unknowns enough.

    Raises
    ------
    InvalidParameterError
        If it is not the matrix of a mesh by its shape.
    """
    n = (len(np.atleast_1d(matrix)) + 2) // 4
    if n < LEAST_NODES or matrix.shape != (4 * n - 2, 4 * n - 2):
        raise InvalidParameterError(
            f"matrix has shape {matrix.shape}: give one of mode_matrix(solution, n)"
        )
    wall = 3 * n - 2
    rest = matrix[:, _but(len(matrix), wall)].copy()
    rest[2 * n - 1 : wall] -= rest[wall]
    return rest[_but(len(matrix), wall)]


@lru_cache(maxsize=32)
def _but(size: int, index: int) -> NDArray[np.intp]:
    return np.delete(np.arange(size), index)


@lru_cache(maxsize=32)
def _unknowns(n: int) -> tuple[Array, Array, Array, Array]:
    """Return the matrices from the unknowns to nodal values of S, Y, U and W, each (n, 4 n - 2)."""
    S, Y, U, W = np.zeros((4, n, 4 * n - 2))
    node = np.arange(n)
    S[node, node] = 1.0
    Y[node[:-1], n + node[:-1]] = 1.0
    U[node, 2 * n - 1 + node] = 1.0
    W[node[:-1], 3 * n - 1 + node[:-1]] = 1.0
    return S, Y, U, W


def _rows(factors: Array, matrix: Array) -> Array:
    return factors[:, None] * matrix
