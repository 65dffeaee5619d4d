"""Batched inverse Lanczos against one SVD for each point, on the paper's matrix of order 798."""

import time
import tracemalloc
from collections.abc import Callable
from math import radians
from statistics import median

import numpy as np
from numpy.typing import NDArray

from hopper import Hopper, SchurForm, schur_form, smallest_singular_values, solve_radial
from hopper.spectral.chebyshev import clenshaw_curtis_weights
from hopper.stability.paper_matrix import half_matrix, paper_matrix
from hopper.stability.transient import half_weights

NODES = 400
# Half width in Re z, largest Im z: the window of a figure, and one mostly far from the spectrum.
WINDOWS = {"figure": (4.0, 200.0), "far": (60.0, 2000.0)}


def by_svd(matrix: NDArray[np.float64], z: NDArray[np.complex128]) -> NDArray[np.float64]:
    identity = np.eye(len(matrix))
    return np.array([np.linalg.svd(p * identity - matrix, compute_uv=False)[-1] for p in z])


def seconds(task: Callable[[], object], repeats: int) -> float:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        task()
        times.append(time.perf_counter() - start)
    return median(times)


def grid(window: str, side: int) -> NDArray[np.complex128]:
    width, height = WINDOWS[window]
    return np.linspace(-width, width, side) + 1j * np.linspace(0, height, side)[:, None]


def row(name: str, value: float, target: str = "") -> None:
    print(f"{name:<52} {value:12.3g}   {target}", flush=True)


def peak(form: SchurForm) -> float:
    tracemalloc.start()
    smallest_singular_values(form, grid("figure", 100))
    size = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return size


def main() -> None:
    """Print speed, accuracy and memory."""
    solution = solve_radial(Hopper("wedge", radians(35), radians(10)), 0.0)
    weight = clenshaw_curtis_weights(NODES)
    weight = np.concatenate([weight, weight[1:-1]])
    matrix = paper_matrix(solution, NODES)
    transformed = np.sqrt(weight)[:, None] * matrix / np.sqrt(weight)
    row("Schur form, s", seconds(lambda: schur_form(matrix, weight), 3))
    form = schur_form(matrix, weight)
    half = schur_form(
        half_matrix(solution, NODES // 2), half_weights(solution.hopper, NODES // 2, "L2")
    )

    rng = np.random.default_rng(0)
    for window, (width, height) in WINDOWS.items():
        z = grid(window, 50)
        svd = 1e3 * seconds(lambda: by_svd(transformed, rng.choice(z.ravel(), 1)), 9)  # noqa: B023
        batched = 1e3 / z.size * seconds(lambda: smallest_singular_values(form, z), 3)  # noqa: B023
        row(f"SVD, {window} window, ms a point", svd)
        row(f"batched, {window} window, ms a point", batched)
        row(f"ratio, {window} window", svd / batched, ">= 100")
        by_half = 1e3 / z.size * seconds(lambda: smallest_singular_values(half, z), 3)  # noqa: B023
        row(f"ratio, {window} window, the flow's parity", svd / by_half, ">= 200")
        points = rng.uniform(-width, width, 100) + 1j * rng.uniform(0, height, 100)
        error = np.abs(smallest_singular_values(form, points) / by_svd(transformed, points) - 1)
        row(f"largest relative difference, {window} window", error.max(), "<= 1e-6")
    eigenvalues = form.eigenvalues[np.argsort(np.abs(form.eigenvalues))][:30]
    for distance, target in ((1e-3, "<= 1e-6"), (1e-6, "")):
        points = eigenvalues + distance * np.exp(2j * np.pi * rng.random(30))
        expected = by_svd(transformed, points)
        error = np.abs(smallest_singular_values(form, points) - expected)
        row(f"  relative, {distance:g} from eigenvalues", (error / expected).max(), target)
        row(f"  over eps ||M||, {distance:g} from eigenvalues", error.max() / form.rounding, "<= 1")
    row("peak memory of 10^4 points, MiB", peak(form) / 2**20, "<= 1024")


if __name__ == "__main__":
    main()
