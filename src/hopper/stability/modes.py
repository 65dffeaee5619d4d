"""Spectral abscissa of the linearised equations: low modes in tilted time, and the line.

The supremum of Re(lambda) is the larger of the low modes' and the asymptotic line's, so no large
mesh is needed. A hopper is stable where it is negative, because t = log r decreases downwards. At a
fold of the family of radial solutions lambda = 0 is a mode: the family's tangent solves the linear
equations without t.

A cone is judged by axisymmetric disturbances without swirl, a wedge by both parities.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal

import numpy as np
from numpy.typing import NDArray

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

# Half-grid points; many solutions are computed together on the first two meshes.
_SIZES, _TOGETHER = (12, 16, 22, 36, 54, 80, 120), 2
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

    @cached_property
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
    groups: dict[tuple[float, tuple[int, ...]], list[int]] = {}
    for i, solution in enumerate(solutions):
        layer = layer_clustering(solution.hopper, solution.member.tau)
        groups.setdefault((layer, _sizes(solution)), []).append(i)
    found: dict[int, LinearStability | ConvergenceError] = {}
    for (_, sizes), group in groups.items():
        chosen = [solutions[i] for i in group]
        lines, spectra = _first_meshes(chosen, parities, sizes[:_TOGETHER], tolerance)
        levels = [np.inf if isinstance(one, Exception) else one.abscissa for one in lines]
        wanted = _Wanted(max(count, LEAST_MODES), tolerance, others or tolerance, np.array(levels))
        modes = {
            parity: _low_modes(chosen, parity, sizes, spectra[parity], wanted)
            for parity in parities
        }
        for row, i in enumerate(group):
            found[i] = _judged({parity: modes[parity][row] for parity in parities}, lines[row])
    return [found[i] for i in range(len(solutions))]


def _first_meshes(
    solutions: Sequence[RadialSolution],
    parities: Sequence[Parity],
    sizes: Sequence[int],
    tolerance: float,
) -> tuple[list[AsymptoticLine | ConvergenceError], dict[Parity, list[Complex]]]:
    """Return the lines, and the eigenvalues of each parity on meshes, of solutions in one layer."""
    line_grid = mode_grid(solutions[0], LINE_SIZES[0], "symmetric")
    grids = [mode_grid(solutions[0], m, parity) for parity in parities for m in sizes]
    *first, last = stacked_on_grids(solutions, [*grids, line_grid])
    lines: list[AsymptoticLine | ConvergenceError] = []
    for solution, coarse in zip(solutions, lines_on(solutions, line_grid, last), strict=True):
        try:
            lines.append(asymptotic_line(solution, coarse, _LINE_PART * tolerance))
        except ConvergenceError as error:
            lines.append(error)
    spectra = iter(
        [
            _upper(np.linalg.eigvals(assemble(grid, at)))
            for grid, at in zip(grids, first, strict=True)
        ]
    )
    return lines, {parity: [next(spectra) for _ in sizes] for parity in parities}


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


def _sizes(solution: RadialSolution) -> tuple[int, ...]:
    """Return the meshes to use: a layer in a cone asks the same of solution and modes."""
    layered = solution.hopper.curvature and solution.member.grid.size >= _LAYERED
    return _SIZES[1:] if layered else _SIZES


def _judged(
    found: dict[Parity, Modes | ConvergenceError], line: AsymptoticLine | ConvergenceError
) -> LinearStability | ConvergenceError:
    if isinstance(line, ConvergenceError):
        return line
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


@dataclass(frozen=True)
class _Wanted:
    """How many modes, to which relative errors, and the lines that may govern in their place."""

    count: int
    tolerance: float
    others: float
    lines: Array


def _low_modes(
    solutions: Sequence[RadialSolution],
    parity: Parity,
    sizes: Sequence[int],
    start: Sequence[Complex],
    wanted: _Wanted,
) -> list[Modes | ConvergenceError]:
    """Return converged low modes of each solution; ``start`` has those of the first meshes.

    They are as many as wanted, and more if one of larger modulus governs.
    Errors decay geometrically with the mesh, so that of the finer of two meshes is about their
    difference to the power of their ratio. A mode counts while it and all of smaller modulus have
    a partner on the coarser mesh and an error below what is wanted by that estimate.
    """
    found: list[Modes | ConvergenceError] = [
        ConvergenceError(
            f"fewer than {LEAST_MODES} low {parity} modes converged at {sizes[-1]} half-grid "
            f"points; {not_resolved_because(solution.friction_angle)}"
        )
        for solution in solutions
    ]
    rows: NDArray[np.intp] = np.arange(len(solutions))
    coarse = start[0]
    of_fields = np.array([solution.member.error for solution in solutions])
    for index, (previous, size) in enumerate(pairwise(sizes), 1):
        if index < len(start):
            fine = start[index]
        else:
            matrices = [tilted_matrix(solutions[int(i)], size, parity) for i in rows]
            fine = _upper(np.linalg.eigvals(np.stack(matrices)))
        error = _partner_changes(fine, coarse) ** (size / previous)
        run = np.logical_and.accumulate(error <= wanted.others, axis=1)
        # Rounding of the collocation matrix: a few units of its condition, about size ** 2.
        relative = _MESH_SAFETY * error + _EPS * size**2 + _FIELD_SAFETY * of_fields[rows, None]
        errors = np.where(run, relative * np.maximum(np.abs(fine), 1), 0.0)
        lines, real = wanted.lines[rows], np.where(run, fine.real, -np.inf)
        counts = _counts(real, errors, wanted.count, lines)
        real[np.arange(real.shape[1]) >= counts[:, None]] = -np.inf
        top = np.arange(rows.size), real.argmax(axis=1)
        enough = run.sum(axis=1) >= LEAST_MODES
        for row in np.flatnonzero(enough):
            kept = slice(counts[row])
            found[rows[row]] = Modes(fine[row, kept], errors[row, kept])
        by_line = lines - real[top] > errors[top]
        done = enough & (counts >= wanted.count) & (by_line | (error[top] < wanted.tolerance))
        rows, coarse = rows[~done], fine[~done]
        if not rows.size:
            break
    return found


def _counts(real: Array, errors: Array, count: int, lines: Array) -> NDArray[np.intp]:
    """Return how many modes to keep of each row: the first, up to one that exceeds them and lines.

    ``real`` is -inf beyond the resolved ones.
    """
    level = np.maximum(lines, real[:, :count].max(axis=1))
    beyond = real - errors
    beyond[:, :count] = -np.inf
    highest = beyond.argmax(axis=1)
    exceeds = beyond[np.arange(highest.size), highest] > level
    return np.where(exceeds, highest + 1, np.minimum(count, np.isfinite(real).sum(axis=1)))


@checked
def partner_changes(fine: ComplexRow, coarse: ComplexRow) -> Array:
    """Return the distance of each mode to its partner, inf where another one has it.

    Relative to the modulus where that is above 1.
    """
    if not coarse.size:
        return np.full(fine.size, np.inf)
    return _partner_changes(fine[None], coarse[None])[0]


def _partner_changes(fine: Complex, coarse: Complex) -> Array:
    """Return the same for rows of modes; nan where inf fills a row."""
    with np.errstate(invalid="ignore"):
        distance = np.abs(fine[:, :, None] - coarse[:, None])
        partner, own = distance.argmin(axis=2), np.arange(fine.shape[1])
        change = np.take_along_axis(distance, partner[..., None], axis=2)[..., 0]
        change /= np.maximum(np.abs(fine), 1)
    first = np.full(coarse.shape, own.size)
    np.minimum.at(first, (np.arange(len(fine))[:, None], partner), own)
    change[np.take_along_axis(first, partner, axis=1) != own] = np.inf
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
    return _upper(np.linalg.eigvals(tilted_matrix(solution, size, parity))[None])[0]


def _upper(values: Numbers) -> Complex:
    """Return rows of eigenvalues with Im >= 0 by increasing modulus, filled up with inf."""
    upper = np.where(values.imag >= 0, values, np.inf).astype(np.complex128, copy=False)
    ordered = np.take_along_axis(upper, np.abs(upper).argsort(axis=1), axis=1)
    return ordered[:, : np.isfinite(upper).sum(axis=1).max()]
