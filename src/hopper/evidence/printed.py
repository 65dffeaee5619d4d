"""Formulas exactly as the paper prints them, to be held against what they stand for.

Nothing else in this package uses them. s = sin delta; angles in radians.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import acos, asin, pi, sqrt

import numpy as np

from hopper.arguments import Fraction, Row, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.evidence import motion
from hopper.radial.solution import RadialSolution
from hopper.roots import root_between
from hopper.stability.tilted import require_mohr_coulomb
from hopper.yield_conditions import MOHR_COULOMB, YieldCondition


@checked
def radial_matrix(law: YieldCondition, s: Fraction, sigma: float, psi: float) -> Array:
    """Return A of the radial equations A (sigma, psi)' = F, (3.3), shape (2, 2)."""
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    b = 1.0 if law == MOHR_COULOMB else 1 / sqrt(3)
    return np.array(
        [[-s * s2, -2 * s * sigma * c2], [1 + b * s * c2, -2 * b * s * sigma * s2]], dtype=float
    )


@checked
def nonsingular_below(law: YieldCondition, s: Fraction) -> float:
    """Return the psi below which the paper says that A of (3.3) is nonsingular."""
    if law == MOHR_COULOMB:
        return pi / 4 + asin(s) / 2
    return pi / 2 - acos(s / sqrt(3)) / 2


@checked
def first_singular_angle(law: YieldCondition, s: Fraction) -> float:
    """Return the least psi > 0 at which the determinant of :func:`radial_matrix` vanishes."""

    def determinant(psi: float) -> float:
        return float(np.linalg.det(radial_matrix(law, s, 1.0, psi)))

    grid = np.linspace(0, pi / 2, 91)
    signs = np.sign([determinant(psi) for psi in grid])
    first = int(np.flatnonzero(signs[1:] != signs[0])[0])
    return root_between(determinant, grid[first], grid[first + 1], xtol=1e-15)


@checked
def linearised(solution: RadialSolution, theta: Row) -> tuple[Array, Array, Array]:
    """Return A, B and C of (4.1) at ``theta`` (shape (n,)), each of shape (n, 2, 2)."""
    require_mohr_coulomb(solution.hopper)
    s = solution.hopper.s
    sigma, psi, dsigma, dpsi = solution.fields(theta)
    c2, s2, cot = np.cos(2 * psi), np.sin(2 * psi), 1 / np.tan(theta)
    q = s - c2
    a: list[Array | float] = [
        -2 * sigma * s * s2,
        8 * s**2 * sigma**2,
        (1 - s**2) / 2,
        -2 * s * sigma * s2,
    ]
    b = [
        2 * sigma * s * (3 + 2 * dpsi) - 2 * sigma * c2,
        8 * s * sigma * dsigma,
        -s2 * (1 + dpsi),
        2 * sigma * q * (3 + 2 * dpsi) - 2 * dsigma * s2,
    ]
    c = [
        2 * sigma * s * (1 + c2 + s2 * cot),
        8 * sigma**2 * s * cot,
        -(1 + s) * (s2 + (1 - c2) * cot) / 2,
        2 * sigma * (q - s2 * cot),
    ]
    return (_entries(a, 2 * sigma * s * q), _entries(b, 2 * sigma * q), _entries(c, 2 * sigma * q))


def _entries(numerators: Sequence[Array | float], denominator: Array) -> Array:
    """Return the four entries, row by row, as matrices of shape (n, 2, 2)."""
    return np.array([part / denominator for part in numerators]).T.reshape(-1, 2, 2)


@dataclass(frozen=True)
class Comparison:
    """Printed over derived entries of A, B, C of (4.1), unknowns (sigma1, psi1).

    ``ratio`` is their mean over the hopper and ``spread`` their range, each of shape (3, 2, 2).
    """

    ratio: Array
    spread: Array

    __repr__ = brief("ratio", "spread")


@checked
def compare_linearised(solution: RadialSolution, points: int) -> Comparison:
    """Hold (4.1) as printed against the equations of motion, differentiated numerically.

    At ``points`` angles between the axis and the wall, excluded and included.
    """
    if points < 1:
        raise InvalidParameterError(f"points = {points}: give at least 1")
    theta = solution.hopper.half_angle * np.arange(1, points + 1) / points
    a, b = motion.linearised(solution, theta, curvature=0)
    _, f = motion.linearised(solution, theta, curvature=1)
    ratios = np.array(linearised(solution, theta)) / np.array([a, b, f - b])
    return Comparison(ratios.mean(axis=1), np.ptp(ratios, axis=1))
