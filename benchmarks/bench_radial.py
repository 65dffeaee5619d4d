"""Time of scipy's solve_bvp over that of solve_radial, both at an error of at most 1e-10.

solve_bvp gets vectorised slopes, the apex as its singular term, a good guess, and the tolerance
that just reaches the error; then also the exact Jacobian; then also the best of several starting
meshes, which nobody knows beforehand. Errors are the largest in log sigma and psi against a much
finer mesh.
Times are processor times, medians of alternating runs: other load on the machine does not enter.
"""

from collections.abc import Callable
from functools import partial
from itertools import product
from math import atan, radians
from statistics import median
from time import process_time
from typing import Any

import numpy as np
from scipy.integrate import solve_bvp

from hopper import Hopper, RadialSolution, solve_radial
from hopper.arrays import Array
from hopper.problem import Geometry
from hopper.radial.collocation import newton
from hopper.radial.grid import half_grid

TARGET = 1e-10
REPEATS, CALLS = 15, 20
MESHES = (21, 11, 41, 81, 161)
VARIANTS = (
    ("as documented", False, MESHES[:1]),
    ("with the exact Jacobian", True, MESHES[:1]),
    ("and the best mesh", True, MESHES),
)
Answer = tuple[Array, Array]
CASES: tuple[tuple[Geometry, float, float, float], ...] = (
    ("cone", 30, 30, atan(0.2)),
    ("cone", 40, 15, radians(15)),
    ("wedge", 35, 10, radians(10)),
)


def slopes(k: int, s: float, theta: Array, y: Array) -> Array:
    """Slopes of (log sigma, psi) for Mohr-Coulomb, less the singular term -k psi / theta."""
    c2, s2 = np.cos(2 * y[1]), np.sin(2 * y[1])
    radial, angular, _, _ = _terms(k, s, theta, y, c2, s2)
    determinant = 2 * s * (c2 + s)
    result = np.empty_like(y)
    result[0] = 2 * s * (s2 * radial - c2 * angular) / determinant
    result[1] = ((1 + s * c2) * radial + s * s2 * angular) / determinant
    inside = theta > 0
    result[1, inside] += k * y[1, inside] / theta[inside]
    result[0, ~inside] = 0.0
    result[1, ~inside] = radial[~inside] / (2 * s)
    return result


def jacobian(k: int, s: float, theta: Array, y: Array) -> Array:
    """Derivatives of :func:`slopes` by (log sigma, psi), shape (2, 2, m)."""
    c2, s2 = np.cos(2 * y[1]), np.sin(2 * y[1])
    radial, angular, radial_psi, angular_psi = _terms(k, s, theta, y, c2, s2)
    lightness = np.exp(-y[0])
    determinant, determinant_psi = 2 * s * (c2 + s), -4 * s * s2
    dlog = 2 * s * (s2 * radial - c2 * angular) / determinant
    dpsi = ((1 + s * c2) * radial + s * s2 * angular) / determinant
    down, out = -np.cos(theta) * lightness, np.sin(theta) * lightness
    result = np.empty((2, 2, theta.size))
    result[0, 0] = 2 * s * (s2 * down - c2 * out)
    result[1, 0] = (1 + s * c2) * down + s * s2 * out
    result[0, 1] = 2 * s * (2 * c2 * radial + 2 * s2 * angular + s2 * radial_psi - c2 * angular_psi)
    result[1, 1] = (
        (1 + s * c2) * radial_psi + s * s2 * angular_psi + 2 * s * (c2 * angular - s2 * radial)
    )
    result[0, 1] -= dlog * determinant_psi
    result[1, 1] -= dpsi * determinant_psi
    result /= determinant
    inside = theta > 0
    result[1, 1, inside] += k / theta[inside]
    result[:, :, ~inside] = 0.0
    result[1, 0, ~inside] = down[~inside] / (2 * s)
    return result


def _terms(k: int, s: float, theta: Array, y: Array, c2: Array, s2: Array) -> list[Array]:
    """Radial and angular equation over sigma without slopes, and their derivatives by psi."""
    cot = np.divide(1.0, np.tan(theta), out=np.zeros_like(theta), where=theta > 0)
    lightness = np.exp(-y[0])
    return [
        1 - s * k - (3 + k) * s * c2 - k * s * s2 * cot + lightness * np.cos(theta),
        -(3 + k) * s * s2 - k * s * (1 - c2) * cot - lightness * np.sin(theta),
        2 * (3 + k) * s * s2 - 2 * k * s * c2 * cot,
        -2 * (3 + k) * s * c2 - 2 * k * s * s2 * cot,
    ]


def boundary_values(psi_wall: float, axis: Array, wall: Array) -> Array:
    return np.array([axis[1], wall[1] - psi_wall])


def boundary_jacobian(axis: Array, wall: Array) -> tuple[Array, Array]:
    return np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0, 0.0], [0.0, 1.0]])


def by_scipy(hopper: Hopper, friction_angle: float, exact: bool, mesh: int, tol: float) -> Any:
    """Solve the boundary value problem for (log sigma, psi) by solve_bvp."""
    k, s = hopper.curvature, hopper.s
    psi_wall = hopper.material.wall_angle(hopper.delta, friction_angle)
    theta = np.linspace(0, hopper.half_angle, mesh)
    slope = psi_wall / hopper.half_angle
    sigma_axis = 1 / ((2 + 2 * k) * s * slope - (1 - 3 * s - 2 * k * s))
    return solve_bvp(
        partial(slopes, k, s),
        partial(boundary_values, psi_wall),
        theta,
        np.array([np.full(mesh, np.log(sigma_axis)), slope * theta]),
        S=np.diag([0.0, -k]) if k else None,
        fun_jac=partial(jacobian, k, s) if exact else None,
        bc_jac=boundary_jacobian if exact else None,
        tol=tol,
        max_nodes=20000,
    )


def seconds(function: Callable[[], object], calls: int) -> float:
    """Return the processor time of one of ``calls`` calls in a row, as in a sweep."""
    start = process_time()
    for _ in range(calls):
        function()
    return (process_time() - start) / calls


def finer(solution: RadialSolution, theta: Array) -> Array:
    """Return (log sigma, psi) of the same hopper on a much finer grid."""
    member = solution.member
    grid = half_grid(160, solution.hopper.half_angle)
    reference = newton(solution.hopper, grid, member.closure, member.on(grid))
    assert reference is not None
    log_ratio = grid.interpolation(theta, "even") @ reference.log_ratio
    psi = grid.interpolation(theta, "odd") @ reference.psi
    return np.array([log_ratio - np.log(reference.tau), psi])


def tuned(
    hopper: Hopper, phi: float, exact: bool, meshes: tuple[int, ...], exact_answer: Answer
) -> tuple[Callable[[], Any], float]:
    """Return the fastest way to call solve_bvp within the error, and its error."""
    theta, reference = exact_answer
    best, least, achieved = None, np.inf, np.inf
    for mesh, tol in product(meshes, np.logspace(-5, -9, 17)):
        attempt = partial(by_scipy, hopper, phi, exact, mesh, float(tol))
        result = attempt()
        error = float(np.abs(result.sol(theta) - reference).max())
        if result.success and error <= TARGET:
            time = min(seconds(attempt, 1) for _ in range(3))
            if time < least:
                best, least, achieved = attempt, time, error
    assert best is not None, "solve_bvp does not reach the error"
    return best, achieved


def main() -> None:
    """Print the ratios and the errors of every case."""
    for geometry, delta, half_angle, phi in CASES:
        hopper = Hopper(geometry, radians(delta), radians(half_angle))
        solution = solve_radial(hopper, phi)
        theta = np.linspace(0, hopper.half_angle, 200)
        reference = finer(solution, theta)
        sigma, psi, _, _ = solution.fields(theta)
        error = float(np.abs(np.array([np.log(sigma), psi]) - reference).max())
        assert error <= TARGET
        ours = partial(solve_radial, hopper, phi)
        print(f"{geometry}, delta {delta}, half angle {half_angle}, mu {np.tan(phi):.3f}:")
        for label, exact, meshes in VARIANTS:
            scipy, scipy_error = tuned(hopper, phi, exact, meshes, (theta, reference))
            times = [(seconds(scipy, 3), seconds(ours, CALLS)) for _ in range(REPEATS)]
            theirs, mine = (1e3 * median(column) for column in zip(*times, strict=True))
            print(
                f"  {label:<28} ratio {theirs / mine:5.1f}   solve_bvp {theirs:6.2f} ms, error "
                f"{scipy_error:.0e}; solve_radial {mine:5.2f} ms, error {error:.0e}"
            )


if __name__ == "__main__":
    main()
