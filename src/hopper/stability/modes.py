"""Spectral abscissa of the linearised equations: low modes in tilted time, and the line.

The supremum of Re(lambda) is the larger of the low modes' and the asymptotic line's, so no large
mesh is needed. A hopper is stable where it is negative, because t = log r decreases downwards. At a
fold of the family of radial solutions lambda = 0 is a mode: the family's tangent solves the linear
equations without t.

A cone is judged by axisymmetric disturbances without swirl, a wedge by both parities.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from hopper.arguments import ComplexRow, checked
from hopper.arrays import Array, Complex, Numbers
from hopper.brief import brief
from hopper.errors import ConvergenceError, not_resolved_because
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
    tilted_matrix,
)
from hopper.stability.tilted import stacked_on_grids

Disturbances = Literal["symmetric", "any"]
Governor = Literal["line", "complex mode", "real mode"]
GOVERNORS: tuple[Governor, ...] = ("line", "complex mode", "real mode")
Verdict = Literal["stable", "stable_symmetric_only", "unstable", "neutral"]

_SIZES = (12, 16, 22, 36, 54, 80, 120)
# Half-grid points of a cone's radial solution from which on the first mesh is too coarse.
_LAYERED = 36
_TOLERANCE = 1e-10
# Of the tolerance, what the quadrature of the line may take.
_LINE_PART = 0.1
LEAST_MODES = 3
# Estimates of a mode's error are orders of magnitude: that by two meshes guesses the rate of
# convergence (one of 748 random sets of modes exceeded a hundred times the guess).
_MESH_SAFETY, _FIELD_SAFETY = 100, 10
_EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Modes:
    """Converged low modes of one parity with Im >= 0, by increasing modulus.

    ``errors`` are absolute, what the mesh and the error of the radial fields leave in them.
    """

    eigenvalues: Complex
    errors: Array

    __repr__ = brief("eigenvalues", "errors")

    @property
    def highest(self) -> int:
        """Index of the mode with the largest real part."""
        return int(np.argmax(self.eigenvalues.real))

    @checked
    def supremum(self, line: AsymptoticLine) -> tuple[float, float]:
        """Return the larger of the highest real part and the line's, with its error."""
        value = float(self.eigenvalues[self.highest].real)
        if value > line.abscissa:
            return value, float(self.errors[self.highest])
        return line.abscissa, line.error_estimate

    def _first(self, count: int, line: float) -> "Modes":
        """Return the first modes, up to one beyond ``count`` that exceeds them and the line."""
        level = max(line, float(self.eigenvalues[:count].real.max()))
        beyond = self.eigenvalues.real - self.errors
        beyond[:count] = level
        if beyond.max() > level:
            count = int(beyond.argmax()) + 1
        return Modes(self.eigenvalues[:count], self.errors[:count])


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
        if abs(self.abscissa) <= self.error_estimate:
            return "neutral"
        if self.stable:
            return "stable"
        value, error = self.symmetric
        return "stable_symmetric_only" if value < -error else "unstable"


@dataclass(frozen=True)
class Start:
    """The line on a coarse grid, and the eigenvalues with Im >= 0 of each parity on two meshes."""

    line: AsymptoticLine
    eigenvalues: dict[Parity, list[Complex]]

    __repr__ = brief("line.abscissa")


@checked
def linear_stability(
    solution: RadialSolution,
    disturbances: Disturbances | None = None,
    count: int = LEAST_MODES,
    tolerance: float = _TOLERANCE,
    others: float | None = None,
    start: Start | None = None,
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
    start : Start, optional
        Of this solution, from :func:`stacked_starts`, which then has chosen the disturbances.

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
    if start is None:
        parities = parities_among(disturbances, solution.hopper.geometry)
        start = stacked_starts([solution], parities)[0]
    line = asymptotic_line(solution, start.line, _LINE_PART * tolerance)
    wanted = _Wanted(max(count, LEAST_MODES), tolerance, others or tolerance, line.abscissa)
    modes = {
        parity: _low_modes(solution, parity, spectra, wanted)
        for parity, spectra in start.eigenvalues.items()
    }
    return _judged(modes, line)


@checked
def stacked_starts(solutions: Sequence[RadialSolution], parities: Sequence[Parity]) -> list[Start]:
    """Return what :func:`linear_stability` begins with, for solutions of one hopper at once."""
    found: dict[int, Start] = {}
    groups: dict[tuple[float, tuple[int, ...]], list[int]] = {}
    for i, solution in enumerate(solutions):
        layer = layer_clustering(solution.hopper, solution.member.tau)
        groups.setdefault((layer, _first_sizes(solution)), []).append(i)
    for (_, sizes), group in groups.items():
        chosen = [solutions[i] for i in group]
        line_grid = mode_grid(chosen[0], LINE_SIZES[0], "symmetric")
        grids = [mode_grid(chosen[0], m, parity) for parity in parities for m in sizes]
        *first, last = stacked_on_grids(chosen, [*grids, line_grid])
        lines = lines_on(chosen, line_grid, last)
        spectra = [
            np.linalg.eigvals(assemble(grid, at)) for grid, at in zip(grids, first, strict=True)
        ]
        for row, i in enumerate(group):
            upper = iter([_upper(values[row]) for values in spectra])
            by_parity = {parity: [next(upper) for _ in sizes] for parity in parities}
            found[i] = Start(lines[row], by_parity)
    return [found[i] for i in range(len(solutions))]


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


def _first_sizes(solution: RadialSolution) -> tuple[int, ...]:
    """Return the meshes to begin with: a layer in a cone asks the same of solution and modes."""
    layered = solution.hopper.curvature and solution.member.grid.size >= _LAYERED
    return _SIZES[1:3] if layered else _SIZES[:2]


def _judged(modes: dict[Parity, Modes], line: AsymptoticLine) -> LinearStability:
    parity = max(modes, key=lambda name: modes[name].eigenvalues.real.max())
    found = modes[parity]
    highest = found.eigenvalues[found.highest]
    if highest.real <= line.abscissa:
        return LinearStability(modes, line, line.abscissa, "line", None, line.error_estimate)
    governor: Governor = "complex mode" if highest.imag else "real mode"
    error = float(found.errors[found.highest])
    return LinearStability(modes, line, float(highest.real), governor, parity, error)


@dataclass(frozen=True)
class _Wanted:
    """How many modes, to which relative errors, and the line that may govern in their place."""

    count: int
    tolerance: float
    others: float
    line: float


def _low_modes(
    solution: RadialSolution, parity: Parity, start: list[Complex], wanted: _Wanted
) -> Modes:
    """Return converged low modes; ``start`` has those of the first meshes.

    They are as many as wanted, and more if one of larger modulus governs.
    Errors decay geometrically with the mesh, so that of the finer of two meshes is about their
    difference to the power of their ratio. A mode counts while it and all of smaller modulus have
    a partner on the coarser mesh and an error below what is wanted by that estimate.
    """
    coarse, best = start[0], None
    sizes = _SIZES[_SIZES.index(_first_sizes(solution)[0]) :]
    for index, (previous, size) in enumerate(pairwise(sizes), 1):
        fine = start[index] if index < len(start) else upper_eigenvalues(solution, size, parity)
        error = partner_changes(fine, coarse) ** (size / previous)
        coarse = fine
        unresolved = np.flatnonzero(error > wanted.others)
        run = int(unresolved[0]) if unresolved.size else fine.size
        if run < LEAST_MODES:
            continue
        # Rounding of the collocation matrix: a few units of its condition, about size ** 2.
        relative = _MESH_SAFETY * error[:run] + _EPS * size**2
        relative += _FIELD_SAFETY * solution.member.error
        resolved = Modes(fine[:run], relative * np.maximum(np.abs(fine[:run]), 1))
        best = resolved._first(wanted.count, wanted.line)
        converged, top = best.eigenvalues.size, best.highest
        by_line = wanted.line - best.eigenvalues[top].real > best.errors[top]
        if converged >= wanted.count and (by_line or error[top] < wanted.tolerance):
            return best
    if best is None:
        raise ConvergenceError(
            f"fewer than {LEAST_MODES} low {parity} modes converged at {size} half-grid points; "
            f"{not_resolved_because(solution.friction_angle)}"
        )
    return best


@checked
def partner_changes(fine: ComplexRow, coarse: ComplexRow) -> Array:
    """Return the distance of each mode to its partner, inf where another one has it.

    Relative to the modulus where that is above 1.
    """
    if not coarse.size:
        return np.full(fine.size, np.inf)
    distance = np.abs(fine[:, None] - coarse)
    partner, own = distance.argmin(axis=1), np.arange(fine.size)
    change = distance[own, partner] / np.maximum(np.abs(fine), 1)
    first = np.empty(coarse.size, dtype=int)
    first[partner[::-1]] = own[::-1]
    change[first[partner] != own] = np.inf
    return change


@checked
def upper_eigenvalues(solution: RadialSolution, size: int, parity: Parity = "symmetric") -> Complex:
    """Return the eigenvalues with Im >= 0 on ``size`` half-grid points, by increasing modulus.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.modes import upper_eigenvalues
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> upper_eigenvalues(solution, 24)[:2].round(4)
    array([-14.2776 +0.j   ,  -4.4827+16.902j])
    """
    return _upper(np.linalg.eigvals(tilted_matrix(solution, size, parity)))


def _upper(values: Numbers) -> Complex:
    upper = values[values.imag >= 0].astype(np.complex128)
    return upper[np.argsort(np.abs(upper))]
