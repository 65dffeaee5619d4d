"""Random hoppers, and how their radial solutions compare with shooting in extended precision."""

from dataclasses import dataclass
from math import radians

import numpy as np

from hopper import Hopper, friction_limit, radial_solutions
from hopper.errors import ConvergenceError, NonPositiveStressError, NoRadialSolutionError
from hopper.problem import Geometry
from hopper.radial.solution import RadialSolution
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES, YieldCondition
from tests.radial import taylor

KINDS: dict[str, tuple[Geometry, YieldCondition]] = {
    "wedge": ("wedge", MOHR_COULOMB),
    "cone": ("cone", MOHR_COULOMB),
    "von Mises": ("cone", VON_MISES),
}
POINTS = 8


def hoppers(rng, number, kinds=tuple(KINDS)):
    """Yield hoppers with delta in 15-75 deg and half angles of 1-60 deg."""
    for _ in range(number):
        geometry, material = KINDS[kinds[rng.integers(len(kinds))]]
        delta, half_angle = rng.uniform(15, 75), rng.uniform(1, 60)
        yield Hopper(geometry, radians(delta), radians(half_angle), material)


@dataclass
class Sample:
    """Solutions (radial) with their relative distance below the limit of friction; refusals."""

    solutions: list[RadialSolution]
    distances: list[float]
    refused: int


def solve(chosen, distances):
    """Return every radial solution at the given distances; ``refused`` are not resolved."""
    sample = Sample([], [], 0)
    for hopper, distance in zip(chosen, distances, strict=True):
        try:
            phi = friction_limit(hopper).friction_angle * (1 - distance)
            found = radial_solutions(hopper, max(phi, 0.0))
        except ConvergenceError:
            sample.refused += 1
        except (NoRadialSolutionError, NonPositiveStressError):
            continue  # too wide for any wall, or too weak
        else:
            sample.solutions += found
            sample.distances += [distance] * len(found)
    return sample


def errors(solutions):
    """Return the true errors as ``error_estimate`` means them, shape (n,).

    nan where even 80 bits do not determine the solution: psi at the wall then changes by more than
    a tenth of the claim with the last bit of tau.
    """
    chosen = [solution.hopper for solution in solutions]
    phi = [solution.friction_angle for solution in solutions]
    claim = np.array([solution.error_estimate for solution in solutions])
    tau = np.array([solution.member.tau for solution in solutions])
    gap = np.array([solution.member.gap.min() for solution in solutions])
    step = np.clip(3 * claim, 1e-13, np.minimum(1e-2, 1e-3 * gap**2))
    true_tau, log_ratio, psi = taylor.solve(chosen, phi, tau, step, POINTS)
    missed = np.abs(psi[-1] - taylor.wall_angle(chosen, phi))
    at_end = np.flatnonzero(~(missed < np.maximum(claim / 10, 1e-13)))
    if at_end.size:
        again = taylor.solve_at_an_end(
            [chosen[i] for i in at_end],
            [phi[i] for i in at_end],
            tau[at_end],
            np.maximum(5 * claim[at_end], 1e-14),
            POINTS,
        )
        true_tau[at_end], log_ratio[:, at_end], psi[:, at_end] = again
    found = []
    for i, solution in enumerate(solutions):
        theta = np.arange(1, POINTS + 1) / POINTS * solution.hopper.half_angle
        sigma, ours, _, _ = solution.fields(theta)
        of_ratio = np.log(sigma * taylor.Long(tau[i])) - log_ratio[:, i]
        of_tau = abs(np.log(taylor.Long(tau[i]) / true_tau[i]))
        found.append(max(np.abs(of_ratio).max(), np.abs(ours - psi[:, i]).max(), of_tau))
    missed = np.abs(psi[-1] - taylor.wall_angle(chosen, phi))
    return np.where(missed < np.maximum(claim / 10, 1e-13), np.array(found, dtype=float), np.nan)
