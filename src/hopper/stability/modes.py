"""Spectral abscissa of the linearised equations: low modes in tilted time, and the line.

The supremum of Re(lambda) is the larger of the low modes' and the asymptotic line's, so no large
mesh is needed. A hopper is stable where it is negative, because t = log r decreases downwards. At a
fold of the family of radial solutions lambda = 0 is a mode: the family's tangent solves the linear
equations without t.

A cone is judged by axisymmetric disturbances without swirl, a wedge by both parities.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Complex, Numbers
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Geometry
from hopper.radial.grid import layer_clustering
from hopper.radial.solution import RadialSolution
from hopper.stability.asymptotic_line import LINE_SIZES, AsymptoticLine, asymptotic_line, lines_on
from hopper.stability.collocation import (
    Parity,
    assemble,
    mode_grid,
    parities_of,
    require_disturbance,
)
from hopper.stability.low_modes import LEAST_MODES, Modes, low_modes, mesh_sizes
from hopper.stability.tilted import stacked_on_grids

Disturbances = Literal["symmetric", "any"]
Governor = Literal["line", "complex mode", "real mode"]
GOVERNORS: tuple[Governor, ...] = ("line", "complex mode", "real mode")
Verdict = Literal["stable", "stable_symmetric_only", "unstable", "neutral"]

# Meshes on which many solutions are computed together.
_TOGETHER = 2
_TOLERANCE = 1e-10
# Relative error of modes that do not govern, where they must only be seen to lie below.
OTHERS = 1e-5
# Of the tolerance, what the quadrature of the line may take.
_LINE_PART = 0.1


@dataclass(frozen=True)
class LinearStability:
    """What decides the stability of a radial solution.

    Attributes
    ----------
    modes : dict
        Low modes of each parity of disturbances, by its name.
    line : AsymptoticLine
        Of both parities.
    abscissa : float
        Supremum of Re(lambda); not attained by a mode where the line governs.
    governed_by : "line", "complex mode" or "real mode"
    parity : "symmetric", "asymmetric" or None
        Of the governing mode; None where the line governs.
    error_estimate : float
        Absolute, of the abscissa.
    """

    modes: dict[Parity, Modes]
    line: AsymptoticLine
    abscissa: float
    governed_by: Governor
    parity: Parity | None
    error_estimate: float

    __repr__ = brief("abscissa", "governed_by", "parity", "line.abscissa", "error_estimate")

    @property
    def eigenvalues(self) -> Complex:
        """Low modes of symmetric disturbances, shape (n,)."""
        return self.modes["symmetric"].eigenvalues

    @property
    def symmetric(self) -> tuple[float, float]:
        """Supremum of Re(lambda) for symmetric disturbances, and its error."""
        return self.modes["symmetric"].supremum(self.line)

    @property
    def asymmetric(self) -> tuple[float, float] | None:
        """The same for asymmetric disturbances, None where they were not looked at."""
        found = self.modes.get("asymmetric")
        return None if found is None else found.supremum(self.line)

    @property
    def stable(self) -> bool:
        """Whether all disturbances looked at decay down the hopper."""
        return self.abscissa < 0

    @property
    def verdict(self) -> Verdict:
        """Neutral where the error of the abscissa exceeds its size."""
        return verdict_of((self.abscissa, self.error_estimate), self.symmetric)


@checked
def verdict_of(abscissa: tuple[float, float], symmetric: tuple[float, float]) -> Verdict:
    """Return the verdict on an abscissa and on that of symmetric disturbances, with errors.

    Neutral where the error of the abscissa exceeds its size.
    """
    value, error = abscissa
    if abs(value) <= error:
        return "neutral"
    if value < 0:
        return "stable"
    return "stable_symmetric_only" if symmetric[0] < -symmetric[1] else "unstable"


@checked
def linear_stability(
    solution: RadialSolution,
    disturbances: Disturbances | None = None,
    count: int = LEAST_MODES,
    tolerance: float = _TOLERANCE,
    others: float | None = None,
) -> LinearStability:
    """Return the low modes, the asymptotic line and the spectral abscissa of a radial solution.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    disturbances : "symmetric" or "any", optional
        Default: any for wedges, symmetric for cones.
    count : int
        Modes of each parity wanted, at least 3; fewer are returned where no more are resolved.
    tolerance, others : float
        Error of the governing mode, and of the others (default: the same), relative where the
        modulus exceeds 1.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb, or asymmetric disturbances of a cone are asked for.
    ConvergenceError
        If fewer than three low modes or the line converge.

    Examples
    --------
    >>> from hopper import Hopper, linear_stability, solve_radial
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> stability = linear_stability(solution)
    >>> stability.verdict, round(stability.abscissa, 4)
    ('stable', -4.4827)
    """
    found = linear_stabilities([solution], disturbances, count, tolerance, others)[0]
    if isinstance(found, ConvergenceError):
        raise found
    return found


@checked
def linear_stabilities(
    solutions: Sequence[RadialSolution],
    disturbances: Disturbances | None = None,
    count: int = LEAST_MODES,
    tolerance: float = _TOLERANCE,
    others: float | None = None,
) -> list[LinearStability | ConvergenceError]:
    """Return what :func:`linear_stability` does for solutions of one hopper, or the error of each.

    They are computed together, as at these sizes numpy's overhead is most of the cost.

    Raises
    ------
    InvalidParameterError
        As :func:`linear_stability`.
    """
    if not solutions:
        return []
    parities = parities_among(disturbances, solutions[0].hopper.geometry)
    found: dict[int, LinearStability | ConvergenceError] = {}
    groups: dict[tuple[float, tuple[int, ...]], list[int]] = {}
    wanted = max(count, LEAST_MODES), tolerance, others or tolerance
    for i, solution in enumerate(solutions):
        layer = layer_clustering(solution.hopper, solution.member.tau)
        groups.setdefault((layer, mesh_sizes(solution, wanted[-1])), []).append(i)
    for (_, sizes), group in groups.items():
        coarse, spectra = _first_meshes([solutions[i] for i in group], parities, sizes[:_TOGETHER])
        lines: dict[int, AsymptoticLine] = {}
        for row, i in enumerate(group):
            try:
                lines[row] = asymptotic_line(solutions[i], coarse[row], _LINE_PART * tolerance)
            except ConvergenceError as error:
                found[i] = error
        rows, chosen = list(lines), [solutions[group[row]] for row in lines]
        levels = np.array([line.abscissa for line in lines.values()])
        modes = {
            parity: low_modes(chosen, parity, [some[rows] for some in start], levels, *wanted)
            for parity, start in spectra.items()
        }
        for place, (row, line) in enumerate(lines.items()):
            found[group[row]] = _judged({parity: modes[parity][place] for parity in modes}, line)
    return [found[i] for i in range(len(solutions))]


def _first_meshes(
    solutions: Sequence[RadialSolution], parities: Sequence[Parity], sizes: Sequence[int]
) -> tuple[list[AsymptoticLine], dict[Parity, list[Numbers]]]:
    """Return coarse lines, and eigenvalues of each parity on meshes, of solutions in one layer."""
    line_grid = mode_grid(solutions[0], LINE_SIZES[0], "symmetric")
    grids = [mode_grid(solutions[0], m, parity) for parity in parities for m in sizes]
    *first, last = stacked_on_grids(solutions, [*grids, line_grid])
    matrices = [assemble(grid, at) for grid, at in zip(grids, first, strict=True)]
    spectra = iter([np.linalg.eigvals(stack) for stack in matrices])
    by_parity = {parity: [next(spectra) for _ in sizes] for parity in parities}
    return lines_on(solutions, line_grid, last), by_parity


@checked
def parities_among(disturbances: Disturbances | None, geometry: Geometry) -> tuple[Parity, ...]:
    """Return the parities to look at: by default any of wedges, the symmetric one of cones.

    Raises
    ------
    InvalidParameterError
        If asymmetric disturbances of a cone are asked for, or it is neither "symmetric" nor "any".
    """
    if disturbances == "any":
        require_disturbance(geometry, "asymmetric")
    found = parities_of(geometry)
    return found[:1] if disturbances == "symmetric" else found


def _judged(
    found: dict[Parity, Modes | ConvergenceError], line: AsymptoticLine
) -> LinearStability | ConvergenceError:
    modes: dict[Parity, Modes] = {}
    for parity, one in found.items():
        if isinstance(one, ConvergenceError):
            return one
        modes[parity] = one
    top = max(modes, key=lambda name: modes[name].eigenvalues[modes[name].highest].real)
    governing = modes[top]
    highest = governing.eigenvalues[governing.highest]
    if highest.real <= line.abscissa:
        return LinearStability(modes, line, line.abscissa, "line", None, line.error_estimate)
    governor: Governor = "complex mode" if highest.imag else "real mode"
    error = float(governing.errors[governing.highest])
    return LinearStability(modes, line, float(highest.real), governor, top, error)
