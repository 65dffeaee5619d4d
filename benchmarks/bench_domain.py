"""Stability maps: time per point, against the paper's algorithm, and its growth with the grid.

A map is swept as the workflow does, a row of wall frictions for each delta. Times are processor
times, medians of several runs; `OPENBLAS_NUM_THREADS=1 python -m benchmarks.bench_domain large`
adds the map of 400 x 400 points. The peak is that of the process, other benchmarks included.
"""

import resource
import sys
from collections.abc import Callable
from math import radians
from statistics import median
from time import process_time

import numpy as np

from benchmarks.paper import by_the_paper
from hopper import Hopper, solve_radial
from hopper.domain.stability_map import REGIONS, sweep_friction
from hopper.problem import Geometry

# How many times a point should be quicker than by the paper; a wedge's has both parities.
LEAST: dict[Geometry, dict[int, int]] = {"cone": {10: 600, 30: 450}, "wedge": {10: 350, 30: 350}}
# delta, phi (deg) of the hopper for the paper's algorithm, whose cost depends on neither.
POINT = (35.0, 10.0)


def sweep_map(half_angle: float, side: int, geometry: Geometry = "cone") -> tuple[int, int]:
    """Sweep delta over 12 ... 60 deg and phi over 0 ... 30 deg.

    Returns the numbers of verdicts and of points that are not resolved.
    """
    phis = np.radians(np.linspace(0, 30, side))
    verdicts = unresolved = 0
    for delta in np.radians(np.linspace(12, 60, side)):
        sweep = sweep_friction(Hopper(geometry, float(delta), radians(half_angle)), phis)
        verdicts += int(np.isfinite(sweep.abscissa).sum())
        unresolved += int(np.sum(sweep.region == REGIONS.index("not_converged")))
    return verdicts, unresolved


def seconds(call: Callable[[], object]) -> float:
    start = process_time()
    call()
    return process_time() - start


def per_point(half_angle: float, side: int, repeats: int = 1) -> list[float]:
    """Milliseconds per map point, of each repetition."""
    times = [seconds(lambda: sweep_map(half_angle, side)) for _ in range(repeats)]
    return [1e3 * time / side**2 for time in times]


def row(name: str, value: float, target: str = "") -> None:
    print(f"{name:<56} {value:10.4g}   {target}", flush=True)


def compare(geometry: Geometry, half_angle: int) -> None:
    """Print what a map point costs, and what it costs by the paper's algorithm."""
    delta, phi = map(radians, POINT)
    solution = solve_radial(Hopper(geometry, delta, radians(half_angle)), phi)
    by_the_paper(solution), sweep_map(half_angle, 4, geometry)
    verdicts, unresolved = sweep_map(half_angle, 60, geometry)
    times, ratios = [], []
    for _ in range(3):
        # One after the other, so that both sides see the same machine.
        times.append(seconds(lambda: sweep_map(half_angle, 60, geometry)))
        paper = median(seconds(lambda: by_the_paper(solution)) for _ in range(3))
        ratios.append(paper / times[-1])
    name = f"{geometry} {half_angle} deg, 60 x 60"
    row(f"{name}: ms a point", 1e3 * median(times) / 60**2)
    row(f"{name}: share of points with a verdict", verdicts / 60**2)
    row(f"{name}: share not resolved", unresolved / (verdicts + unresolved), "<= 0.005")
    least = f">= {LEAST[geometry][half_angle]}"
    row(f"{name}: paper's algorithm / a point", median(ratios) * 60**2, least)
    row(f"{name}: paper's algorithm / a verdict", median(ratios) * verdicts)


def main() -> None:
    """Print times, ratios and memory."""
    large = "large" in sys.argv[1:]
    for geometry, angles in LEAST.items():
        for half_angle in angles:
            compare(geometry, half_angle)
    for side in (200, 400)[: 1 + large]:
        # The small map before and after: the clock of these machines drifts over a minute.
        before, (time,), after = per_point(10, 50, 5), per_point(10, side), per_point(10, 50, 5)
        ratio = time / median(before + after)
        row(f"cone 10 deg: ms a point, {side} x {side} / 50 x 50", ratio, "0.8 ... 1.2")
    # Linux counts in KiB.
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    row("peak memory, MiB", peak, "<= 500")


if __name__ == "__main__":
    main()
