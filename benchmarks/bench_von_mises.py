"""Von Mises cones: a point against the quadratic eigenproblem in stress and velocity, and nodes.

Eliminating Y and Z from the linear equations leaves the average stress and two velocities, with
lambda**2: `python -m benchmarks.bench_von_mises`. Times are processor times.
"""

from collections.abc import Callable
from functools import partial
from math import radians, sqrt
from statistics import median
from time import process_time

import numpy as np
from scipy.linalg import eig, eigvals

from hopper.arrays import Array, Complex
from hopper.errors import HopperError
from hopper.problem import Hopper
from hopper.radial.grid import half_grid
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.stability.low_modes import partner_changes
from hopper.von_mises.linearisation import coefficients
from hopper.von_mises.modes import LEAST_MODES, upper_eigenvalues
from hopper.von_mises.verdict import judge
from hopper.yield_conditions import VON_MISES

# delta, half angle and phi, degrees: an elliptic and two hyperbolic cones.
POINTS = ((25, 10, 5.7), (45, 20, 5.7), (50, 10, 11.3))
NODES, REFERENCE, REPEATS = 56, 60, 9
LEAST, LARGEST_PSI, CONES = 60, 40, 100
SHARE = 0.95


def quadratic_eigenvalues(solution: RadialSolution, n: int, vectors: bool = False) -> Complex:
    """Return the finite eigenvalues with Im >= 0 in S, U and W on n half nodes, by modulus.

    With ``vectors`` those are computed as well, as scipy.linalg.eig does by default.
    """
    grid = half_grid(n, solution.hopper.half_angle)
    at = coefficients(solution, [grid])[0]
    s, m, c, q, cot = at.s, at.m, at.c, at.q, at.cot
    even, odd, one, zero = grid.d_even, grid.d_odd, np.eye(n), np.zeros((n, n))

    def rows(factors: Array, matrix: Array) -> Array:
        return factors[:, None] * matrix

    # Each as coefficients of lambda**0 and lambda**1 that act on (S, U, W).
    S, U, W = np.array([[one, zero, zero], [zero, one, zero], [zero, zero, one]])
    S, U, W = (np.concatenate(list(part), axis=1) for part in (S, U, W))
    Z = rows(c / sqrt(12), odd @ W - rows(at.h + cot, W))
    Y = np.array([
        rows(-(c**2) / (4 * sqrt(3)), even @ U - 3 * W),
        rows(-(c**2) / (4 * sqrt(3)), rows(sqrt(3) * q / c, U) - W),
    ])  # fmt: skip
    Y[:, -1] = 0
    Y[0, -1] = at.wall * odd[-1] @ W
    constant = np.array([1.0, 0.0])[:, None, None]
    R = constant * rows(1 - 2 * m * c, S) + 4 * rows(m * q, Y)
    Q = -constant * rows(s * q, S) - 2 * rows(s * c, Y)
    B = constant * rows(1 + m * c, S) - 2 * rows(m * q, Y)
    P = B + s * constant * Z
    radial = 3 * R + odd @ Q + rows(at.l + cot, Q) - 2 * B
    angular = 4 * Q + even @ P + rows(at.l, P) + 2 * s * constant * rows(cot, Z)
    mass = odd @ W + rows(cot - at.h, W)
    powers = []
    for order in range(3):
        by_order = [part[order] if order < 2 else 0 for part in (radial, angular)]
        by_order += [mass if order == 0 else -U if order == 1 else 0 * U]
        if order:
            by_order[0] = by_order[0] - R[order - 1]
            by_order[1] = by_order[1] - Q[order - 1]
        # W = 0 at the wall and the wall's law take the angular equation's place there.
        powers.append(np.delete(np.concatenate(by_order), 2 * n - 1, axis=0)[:, :-1])
    return _of_companion(powers, vectors)


def _of_companion(powers: list[Array], vectors: bool) -> Complex:
    k0, k1, k2 = powers
    size = len(k0)
    unit, zero = np.eye(size), np.zeros((size, size))
    left = np.block([[zero, unit], [-k0, -k1]])
    right = np.block([[unit, zero], [zero, k2]])
    found = eig(left, right)[0] if vectors else eigvals(left, right)
    values = np.asarray(found, dtype=complex)
    values = values[np.isfinite(values)]
    values = values[(values.imag >= 0) & (np.abs(values) > 1e-3)]
    return values[np.argsort(np.abs(values))]


def seconds(call: Callable[[], object]) -> float:
    start = process_time()
    call()
    return process_time() - start


def row(name: str, value: float, target: str = "") -> None:
    print(f"{name:<60} {value:10.4g}   {target}", flush=True)


def compare(delta: float, half_angle: float, phi: float) -> None:
    """Print what a point costs, and what by the quadratic eigenproblem."""
    hopper = Hopper("cone", radians(delta), radians(half_angle), VON_MISES)
    start = solve_radial(hopper, radians(phi))
    name = f"delta {delta:g}, half angle {half_angle:g}, phi {phi:g} deg"
    known = upper_eigenvalues(start, REFERENCE)[:LEAST_MODES]
    quadratic = quadratic_eigenvalues(start, NODES)
    row(f"{name}: modes, relative difference", partner_changes(known, quadratic).max(), "<= 1e-9")
    times = []
    for at in radians(phi) + 1e-3 * np.arange(1, REPEATS + 1):
        times.append(seconds(partial(judge, hopper, float(at), start, resolve=False)))
    point = median(times)
    row(f"{name}: ms a point", 1e3 * point)
    for vectors, what in ((True, "with vectors"), (False, "eigenvalues only")):
        qz = partial(quadratic_eigenvalues, start, NODES, vectors)
        ratio = median(seconds(qz) for _ in range(3)) / point
        row(f"{name}: quadratic, {what} / a point", ratio, f">= {LEAST}")


def resolved(half_angle: float) -> tuple[float, float]:
    """Return the shares of cones resolved to 1e-10 on 28 and to 1e-6 on 20 half nodes."""
    random = np.random.default_rng(19)
    errors: list[list[float]] = []
    while len(errors) < CONES:
        delta, phi = random.uniform([15, 0], [59, 35])
        try:
            hopper = Hopper("cone", radians(delta), radians(half_angle), VON_MISES)
            solution = solve_radial(hopper, radians(phi))
            if solution.psi.max() > radians(LARGEST_PSI):
                continue
            known = upper_eigenvalues(solution, REFERENCE)[:LEAST_MODES]
        except HopperError:
            continue
        meshes = (upper_eigenvalues(solution, size) for size in (28, 20))
        errors.append([float(partner_changes(known, mesh).max()) for mesh in meshes])
    found = np.array(errors)
    return float(np.mean(found[:, 0] < 1e-10)), float(np.mean(found[:, 1] < 1e-6))


def main() -> None:
    """Print ratios and shares."""
    for point in POINTS:
        compare(*point)
    for half_angle in (10, 30):
        name = f"half angle {half_angle} deg, psi <= {LARGEST_PSI} deg"
        fine, coarse = resolved(half_angle)
        row(f"{name}: six modes to 1e-10 on 28 half nodes", fine, f">= {SHARE}")
        row(f"{name}: six modes to 1e-6 on 20 half nodes", coarse, f">= {SHARE}")


if __name__ == "__main__":
    main()
