"""The spectral abscissa against the algorithm of the paper, and mesh spectra against LAPACK.

Ratios are medians over repeats in which both sides run one after the other.
"""

from collections.abc import Callable
from functools import partial
from math import radians
from statistics import median
from time import perf_counter

import numpy as np

from benchmarks.paper import MESHES, TOLERANCE, by_lapack, by_the_paper
from hopper import Hopper, LinearStability, linear_stability, solve_radial
from hopper.errors import HopperError
from hopper.problem import Geometry
from hopper.spectral import chebyshev
from hopper.stability.convergence_filter import convergence_filter
from hopper.stability.low_modes import upper_eigenvalues
from hopper.stability.mesh_spectrum import mesh_spectrum

GEOMETRIES: tuple[Geometry, ...] = ("wedge", "cone")


def by_line_and_low_modes(hopper: Hopper) -> LinearStability:
    return linear_stability(solve_radial(hopper, 0.0))


def filtered_spectrum(hopper: Hopper) -> None:
    """Radial solution, both mesh spectra with their eigenvectors, and the verdicts."""
    solution = solve_radial(hopper, 0.0)
    fine, coarse = (mesh_spectrum(solution, n) for n in MESHES)
    convergence_filter(fine, coarse, TOLERANCE)


def seconds(call: Callable[[], object], times: int) -> float:
    """Mean time of a call."""
    start = perf_counter()
    for _ in range(times):
        call()
    return (perf_counter() - start) / times


def ratio(slow: Callable[[], object], quick: Callable[[], object], times: int) -> float:
    """Median of time(slow) / time(quick), ``quick`` the mean of ``times`` calls."""
    slow(), quick()
    return median(seconds(slow, 1) / seconds(quick, times) for _ in range(9))


def derivative_error(n: int) -> float:
    """Largest error of the differentiation matrix on exp(sin(3 x))."""
    x = chebyshev.nodes(n)
    values = np.exp(np.sin(3 * x))
    slopes = chebyshev.differentiation_matrix(n) @ values
    return float(np.abs(slopes - 3 * np.cos(3 * x) * values).max())


def accurate(half_angle: float, side: int = 30) -> float:
    """Share of a map of cones where 24 half-grid points give the abscissa to 1e-8.

    The governing mode is held against that of :func:`linear_stability`, whose mesh is as fine as
    it needs; where the line governs no mode is needed.
    """
    good = total = 0
    for delta in np.radians(np.linspace(12, 60, side)):
        hopper = Hopper("cone", float(delta), radians(half_angle))
        for phi in np.radians(np.linspace(0, 30, side)):
            try:
                solution = solve_radial(hopper, float(phi))
                found = linear_stability(solution)
            except HopperError:
                continue
            total += 1
            highest = found.eigenvalues[found.modes["symmetric"].highest]
            error = float(np.abs(upper_eigenvalues(solution, 24) - highest).min())
            good += found.governed_by == "line" or error <= 1e-8
    return good / total


def main() -> None:
    """Print ratios and errors for the hopper of Figure 4.2."""
    for geometry in GEOMETRIES:
        hopper = Hopper(geometry, radians(35), radians(10))
        solution = solve_radial(hopper, 0.0)
        fast = partial(by_line_and_low_modes, hopper)
        found = fast()
        reference = upper_eigenvalues(solution, 108)[: found.eigenvalues.size]
        error = abs(found.abscissa - max(reference.real.max(), found.line.abscissa))
        speed_up = ratio(partial(by_the_paper, solution), fast, 100)
        overhead = ratio(partial(filtered_spectrum, hopper), partial(by_lapack, solution), 1)
        print(f"{geometry}: algorithm of the paper / radial + stability  {speed_up:8.0f} x")
        print(f"{geometry}: error of the abscissa                        {error:8.1e}")
        print(f"{geometry}: radial + mesh spectra + filter / LAPACK      {overhead:8.2f} x")
    print(f"error of D at N = 400                               {derivative_error(400):8.1e}")
    for half_angle, least in ((10, 0.98), (30, 0.85)):
        share = accurate(half_angle)
        print(f"cone {half_angle} deg: 24 half-grid points suffice       {share:8.3f}   >= {least}")
