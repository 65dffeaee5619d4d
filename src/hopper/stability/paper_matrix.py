"""The paper's frame: Chebyshev collocation of the stability operator M = A D + F, (4.2).

A is singular where psi = pi/4 - delta/2 (tangency). Beyond it the matrix is that of a problem for
which t is no time: it has the same converged eigenvalues among spurious ones with real parts up to
1e5, which only the filter removes; :mod:`hopper.stability.collocation` has none of them.

*The paper's formulation*: the full interval [-theta_w, theta_w], N nodes (N even, so none lies on
the axis), sigma1 at all of them, psi1 at the N - 2 inner ones: size 2 N - 2.

*The physical formulation*: sigma1 even and psi1 odd, on the half grid of m nodes: size 2 m - 1. The
radial solution's parity splits the paper's matrix of N = 2 m nodes exactly into this half and the
*mirrored* half, sigma1 odd and psi1 even, whose modes are not smooth at the apex of a cone.
"""

from typing import Literal

import numpy as np

from hopper.arguments import Positive, checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.stability.paper_frame import Coefficients, coefficients, coefficients_on_half_grid

Half = Literal["physical", "mirrored"]


@checked
def paper_matrix(solution: RadialSolution, n: int, psi_scale: Positive = 1.0) -> Array:
    """Return M of ``n`` nodes in the paper's formulation, shape (2 n - 2, 2 n - 2).

    Unknowns: sigma1 at theta_1 < ... < theta_n, then psi1 / psi_scale at theta_2 ... theta_(n-1).

    Raises
    ------
    InvalidParameterError
        If n is odd (a node on the axis, where the equations are singular) or less than 4.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.paper_matrix import paper_matrix
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> paper_matrix(solution, 20).shape
    (38, 38)
    """
    require_even(n)
    x = chebyshev.nodes(n)
    at = coefficients(solution, solution.hopper.half_angle * x, psi_scale)
    d = chebyshev.differentiation_matrix(n) / solution.hopper.half_angle
    matrix = _assemble(at, d, d)
    inner = np.delete(np.arange(2 * n), [n, 2 * n - 1])
    return matrix[np.ix_(inner, inner)]


@checked
def half_matrix(
    solution: RadialSolution, m: int, half: Half = "physical", psi_scale: Positive = 1.0
) -> Array:
    """Return M on a half grid of ``m`` nodes, shape (2 m - 1, 2 m - 1).

    Unknowns: sigma1 at theta_1 < ... < theta_m = theta_w, then psi1 / psi_scale at the first
    m - 1 of them; sigma1 even and psi1 odd (physical), or the reverse (mirrored).

    Raises
    ------
    InvalidParameterError
        If m < 2.
    """
    if m < 2:
        raise InvalidParameterError(f"m = {m!r} half-grid nodes: give at least 2")
    half_angle = solution.hopper.half_angle
    at = coefficients_on_half_grid(solution, m, psi_scale)
    even = chebyshev.half_differentiation_matrix(m, "even") / half_angle
    odd = chebyshev.half_differentiation_matrix(m, "odd") / half_angle
    d_sigma, d_psi = (even, odd) if half == "physical" else (odd, even)
    return _assemble(at, d_sigma, d_psi)[:-1, :-1]


@checked
def require_even(n: int) -> None:
    """Check a number of nodes on the full interval.

    Raises
    ------
    InvalidParameterError
        If it is not an even integer of at least 4.
    """
    if not isinstance(n, int | np.integer) or n < 4 or n % 2:
        raise InvalidParameterError(
            f"n = {n!r} nodes: give an even integer of at least 4, so that no node falls on the "
            "axis, where the equations are singular"
        )


def _assemble(at: Coefficients, d_sigma: Array, d_psi: Array) -> Array:
    """Return [[a11 D, a12 D], [a21 D, a11 D]] + [[f11, f12], [f21, f22]]."""
    m = at.q.size
    matrix = np.empty((2 * m, 2 * m))
    matrix[:m, :m] = at.a11[:, None] * d_sigma
    matrix[:m, m:] = at.a12[:, None] * d_psi
    matrix[m:, :m] = at.a21[:, None] * d_sigma
    matrix[m:, m:] = at.a11[:, None] * d_psi
    node = np.arange(m)
    matrix[node, node] += at.f11
    matrix[node, m + node] += at.f12
    matrix[m + node, node] += at.f21
    matrix[m + node, m + node] += at.f22
    return matrix
