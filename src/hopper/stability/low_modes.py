"""Converged low modes of one parity in tilted time, of several solutions of one hopper at once."""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import ComplexRow, Positive, checked
from hopper.arrays import Array, Complex, Numbers
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError, not_resolved_because
from hopper.radial.solution import RadialSolution
from hopper.stability.asymptotic_line import AsymptoticLine
from hopper.stability.collocation import Parity, tilted_matrix

# Half-grid points.
_SIZES = (9, 12, 16, 22, 36, 54, 80, 120)
# Half-grid points of radial solutions of wedges and of cones from which on one more of the first
# meshes is too coarse, and the error of modes below which the first of all is.
_TOO_COARSE, _LOOSE = {0: (36,), 1: (24, 36)}, 1e-7
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


@checked
def mesh_sizes(solution: RadialSolution, others: Positive) -> tuple[int, ...]:
    """Return the meshes to use: what asks for points in a solution does so in its modes.

    ``others`` as in :func:`low_modes`.
    """
    limits = _TOO_COARSE[solution.hopper.curvature]
    skipped = bisect_right(limits, solution.member.grid.size)
    return _SIZES[max(skipped, others < _LOOSE) :]


@checked
def low_modes(
    solutions: Sequence[RadialSolution],
    parity: Parity,
    start: Sequence[Numbers],
    lines: Array,
    count: int,
    tolerance: Positive,
    others: Positive,
) -> list[Modes | ConvergenceError]:
    """Return converged low modes of solutions of one hopper, or why there are too few of them.

    They are as many as wanted, and more if one of larger modulus governs.
    Errors decay geometrically with the mesh, so that of the finer of two meshes is about their
    difference to the power of their ratio. A mode counts while it and all of smaller modulus have
    a partner on the coarser mesh and an error below what is wanted by that estimate.

    Parameters
    ----------
    solutions : sequence of RadialSolution
        That :func:`mesh_sizes` gives the same meshes.
    parity : "symmetric" or "asymmetric"
        Of the disturbances.
    start : sequence of arrays, shape (solutions, n)
        Eigenvalues on the first of these meshes.
    lines : array, shape (solutions,)
        Abscissae of their lines, which may govern.
    count : int
        Modes wanted.
    tolerance, others : float
        Errors of the governing mode and of the others, relative where the modulus exceeds 1.

    Raises
    ------
    InvalidParameterError
        If the parity is unknown or singular at the apex of a cone, or rows are missing.
    """
    if not solutions:
        return []
    rows: NDArray[np.intp] = np.arange(len(solutions))
    _require_rows(rows.shape, start, lines)
    sizes, spectra = mesh_sizes(solutions[0], others), [_rows_of_upper(values) for values in start]
    found: list[Modes | None] = [None] * len(solutions)
    coarse, of_fields = spectra[0], np.array([solution.member.error for solution in solutions])
    for index, (previous, size) in enumerate(pairwise(sizes), 1):
        if index < len(spectra):
            fine = spectra[index][rows]
        else:
            fine = _rows_of_upper(_spectra([solutions[int(i)] for i in rows], size, parity))
        error = _partner_changes(fine, coarse) ** (size / previous)
        run = np.logical_and.accumulate(error <= others, axis=1)
        # Rounding of the collocation matrix: a few units of its condition, about size ** 2.
        relative = _MESH_SAFETY * error + _EPS * size**2 + _FIELD_SAFETY * of_fields[rows, None]
        errors = np.where(run, relative * np.maximum(np.abs(fine), 1), 0.0)
        level, real = lines[rows], np.where(run, fine.real, -np.inf)
        counts = _counts(real, errors, count, level)
        real[np.arange(real.shape[1]) >= counts[:, None]] = -np.inf
        top = np.arange(rows.size), real.argmax(axis=1)
        enough = run.sum(axis=1) >= LEAST_MODES
        for row in np.flatnonzero(enough):
            found[rows[row]] = Modes(fine[row, : counts[row]], errors[row, : counts[row]])
        by_line = level - real[top] > errors[top]
        going_on = ~enough | (counts < count) | ~(by_line | (error[top] < tolerance))
        rows, coarse = rows[going_on], fine[going_on]
        if not rows.size:
            break
    return [one or _too_few(solutions[i], parity, sizes[-1]) for i, one in enumerate(found)]


def _require_rows(shape: tuple[int, ...], start: Sequence[Numbers], lines: Array) -> None:
    if not start or any(values.ndim != 2 or values.shape[:1] != shape for values in start):
        raise InvalidParameterError("start must be arrays with a row for each solution")
    if lines.shape != shape:
        raise InvalidParameterError("lines must be a row with a number for each solution")


def _spectra(solutions: Sequence[RadialSolution], size: int, parity: Parity) -> Numbers:
    return np.linalg.eigvals(np.stack([tilted_matrix(one, size, parity) for one in solutions]))


def _too_few(solution: RadialSolution, parity: Parity, size: int) -> ConvergenceError:
    return ConvergenceError(
        f"fewer than {LEAST_MODES} low {parity} modes converged at {size} half-grid points; "
        f"{not_resolved_because(solution.friction_angle)}"
    )


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
    row, own = np.arange(len(fine))[:, None], np.arange(fine.shape[1])
    with np.errstate(invalid="ignore"):
        distance = np.abs(fine[:, :, None] - coarse[:, None])
        partner = distance.argmin(axis=2)
        change = distance[row, own, partner] / np.maximum(np.abs(fine), 1)
    first = np.full(coarse.shape, own.size)
    np.minimum.at(first, (row, partner), own)
    change[first[row, partner] != own] = np.inf
    return change


@checked
def upper_eigenvalues(solution: RadialSolution, size: int, parity: Parity = "symmetric") -> Complex:
    """Return the eigenvalues with Im >= 0 on ``size`` half-grid points, by increasing modulus.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.low_modes import upper_eigenvalues
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> upper_eigenvalues(solution, 24)[:2].round(4)
    array([-14.2776 +0.j   ,  -4.4827+16.902j])
    """
    return _rows_of_upper(_spectra([solution], size, parity))[0]


def _rows_of_upper(values: Numbers) -> Complex:
    """Return rows of eigenvalues with Im >= 0 by increasing modulus, filled up with inf."""
    upper = np.where(values.imag >= 0, values, np.inf).astype(np.complex128, copy=False)
    ordered = upper[np.arange(len(upper))[:, None], np.abs(upper).argsort(axis=1)]
    return ordered[:, : np.isfinite(ordered).sum(axis=1).max()]
