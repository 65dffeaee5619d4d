"""The radial equations on a half grid and Newton's steps, for one set of unknowns or for stacks.

The innermost loops: arguments are not checked, at this size that would cost as much as the step.
The equations are (2.8), (2.9) with (3.3), divided by sigma; they are linear in
d log(sigma)/d theta and d psi/d theta, and in tau = 1 / sigma_0, the strength of gravity relative
to the stress at the axis.
"""

from functools import lru_cache
from typing import Literal

import numpy as np

from hopper.arrays import Array
from hopper.problem import Hopper
from hopper.radial.grid import Grid

# Factor on the error that geometric convergence predicts; near the singular angle it is slower.
_SAFETY = 100
Unknown = Literal["psi_wall", "tau"]
# Places of the unknowns that a closure can fix.
CLOSED: dict[Unknown, int] = {"psi_wall": -2, "tau": -1}
# Sets of rounding errors, and factor on the largest effect of one.
_ROUNDINGS, _MAGNIFIED = 4, 2
# Terms of the radial equations over sigma, and what is computed from them. L is log sigma.
_TERMS = (
    "1", "versine cot", "cos", "sin", "cos cot", "sin cot", "cos L'", "sin L'", "cos psi'",
    "sin psi'", "L'", "down", "out",
)  # fmt: skip


def normal_weight(hopper: Hopper) -> float:
    """Return the coefficient of -sin(delta) cos(2 psi) in the radial equation.

    Without gravity psi = 0 solves that equation where sin(delta) times this, plus the hoop stress,
    is 1.
    """
    k, law = hopper.curvature, hopper.material
    return (2 + k) * law.radial + law.angular + k * law.hoop_cosine


@lru_cache(maxsize=256)
def equation_coefficients(hopper: Hopper) -> Array:
    """Return the coefficients of the terms, shape (8, len(_TERMS)); sin, cos are of 2 psi.

    The versine is 1 - cos. Rows: radial and angular equation; their derivatives by psi, slopes
    held; the factors of L' and psi' in the radial, and in the angular equation.
    """
    k, s, law = hopper.curvature, hopper.s, hopper.material
    # T_tt - T_pp over sigma is s (excess cos 2psi - hoop), and 0 on the axis: hoop is the excess.
    b, excess = law.angular, law.angular - law.hoop_cosine
    normal = s * normal_weight(hopper)
    rows: list[dict[str, float]] = [
        {"1": 1 - k * law.hoop * s, "cos": -normal, "sin cot": -k * s, "sin L'": -s,
         "cos psi'": -2 * s, "down": 1},
        {"sin": -(3 + k) * s, "versine cot": -k * s * excess, "L'": 1,
         "cos L'": b * s, "sin psi'": -2 * b * s, "out": -1},
        {"sin": 2 * normal, "cos cot": -2 * k * s, "cos L'": -2 * s, "sin psi'": 4 * s},
        {"cos": -2 * (3 + k) * s, "sin cot": -2 * k * s * excess, "sin L'": -2 * b * s,
         "cos psi'": -4 * b * s},
        {"sin": -s},
        {"cos": -2 * s},
        {"1": 1, "cos": b * s},
        {"sin": -2 * b * s},
    ]  # fmt: skip
    return np.array([[row.get(term, 0.0) for term in _TERMS] for row in rows])


def terms_of(psi: Array, cot: Array, dlog: Array, dpsi: Array, down: Array, out: Array) -> Array:
    """Return the terms in their order, shape (len(_TERMS), ..., n)."""
    double = 2 * psi
    terms = np.ones((len(_TERMS), *psi.shape))
    np.cos(double, out=terms[2])
    np.sin(double, out=terms[3])
    for row, factor in ((4, cot), (6, dlog), (8, dpsi)):
        np.multiply(terms[2:4], factor, out=terms[row : row + 2])
    # (1 - cos) cot without cancellation near the axis.
    terms[1] = terms[5] * terms[3] / (1 + terms[2])
    terms[10], terms[11], terms[12] = dlog, down, out
    return terms


def residual_and_jacobian(hopper: Hopper, grid: Grid, u: Array) -> tuple[Array, Array]:
    """Return the residuals of the equations, shape (..., 2 m + 1), and their derivatives by ``u``.

    ``u`` = (log(sigma / sigma_0), psi, tau), shape (..., 2 m + 1); the last rows are left to the
    closure.
    """
    m = grid.size
    log_ratio, psi, tau = u[..., :m], u[..., m:-1], u[..., -1:]
    lightness = np.exp(-log_ratio)
    down, out = lightness * grid.cos, lightness * grid.sin
    dlog, dpsi = log_ratio @ grid.d_even.T, psi @ grid.d_odd.T
    terms = terms_of(psi, grid.cot, dlog, dpsi, tau * down, tau * out)
    rows = equation_coefficients(hopper) @ terms.reshape(len(_TERMS), -1)
    rows = rows.reshape(len(rows), *psi.shape)

    residual = np.zeros(u.shape)
    residual[..., :m], residual[..., m:-1] = rows[0], rows[1]

    jacobian = np.zeros((*u.shape, 2 * m + 1))
    for block, factors in ((slice(0, m), rows[4:6]), (slice(m, 2 * m), rows[6:8])):
        np.multiply(factors[0][..., None], grid.d_even, out=jacobian[..., block, :m])
        np.multiply(factors[1][..., None], grid.d_odd, out=jacobian[..., block, m:-1])
    # Diagonals of the four blocks as strided views: adding to them needs no index arrays.
    step, half = 2 * m + 2, m * (2 * m + 1)
    flat = jacobian.reshape(*u.shape[:-1], -1)
    flat[..., :half:step] -= terms[11]
    flat[..., m:half:step] += rows[2]
    flat[..., half : 2 * half : step] += terms[12]
    flat[..., half + m : 2 * half : step] += rows[3]
    jacobian[..., :m, -1] = down
    jacobian[..., m:-1, -1] = -out
    return residual, jacobian


def closed_system(hopper: Hopper, grid: Grid, unknown: Unknown, u: Array) -> tuple[Array, Array]:
    """Return the residual of the equations and its derivative, with ``unknown`` held as it is."""
    residual, jacobian = residual_and_jacobian(hopper, grid, u)
    # log(sigma / sigma_0) = 0 on the axis replaces the angular equation at the wall: that equation
    # is odd with one degree less, so one of its rows is redundant.
    residual[..., -2] = u[..., : grid.size] @ grid.axis_row
    jacobian[..., -2, :] = 0.0
    jacobian[..., -2, : grid.size] = grid.axis_row
    jacobian[..., -1, CLOSED[unknown]] = 1.0
    return residual, jacobian


def solved_by(jacobian: Array, right: Array) -> Array:
    """Return the solutions for the columns of ``right``; nan where there are none."""
    try:
        return np.linalg.solve(jacobian, right).astype(float, copy=False)
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan)


def size_of(step: Array, u: Array) -> float:
    """Size of a step: absolute in log(sigma) and psi, relative in tau where tau > 1."""
    return max(float(np.abs(step[:-1]).max()), float(abs(step[-1])) / max(abs(u[-1]), 1.0))


def sizes_of(steps: Array, u: Array) -> Array:
    """Return the size of each step, as :func:`size_of`; shapes (k, n) to (k,)."""
    last = np.abs(steps[:, -1]) / np.maximum(np.abs(u[:, -1]), 1)
    return np.maximum(np.abs(steps[:, :-1]).max(axis=1), last)


@lru_cache(maxsize=64)
def _signs(size: int) -> Array:
    return np.random.default_rng(0).choice([-1.0, 1.0], (size, _ROUNDINGS))


def rounding_of_rows(jacobian: Array, u: Array) -> Array:
    """Return a few sets of rounding errors of the equations, shape (..., n, _ROUNDINGS).

    Products of the equations' derivatives and u are rounded independently, so that their squares
    add up.
    """
    size = np.finfo(float).eps * np.sqrt(np.square(jacobian * u[..., None, :]).sum(axis=-1))
    return size[..., None] * _signs(u.shape[-1])


def rounding_of_unknowns(moved: Array, u: Array) -> Array:
    """Return the rounding of u, shape (k,), from what those errors make of it, (k, n, sets)."""
    largest = np.max([sizes_of(moved[..., i], u) for i in range(moved.shape[-1])], axis=0)
    # Fields and stresses computed from u are rounded a few times more.
    return 4 * np.finfo(float).eps + _MAGNIFIED * largest


def extrapolated(observed: list[tuple[int, float]], grid: Grid) -> float:
    """Return the error on a grid from those (size, error) on coarser ones, which decay as C q^size.

    Of the last error alone, C taken as 1, or from its ratio to the one before: the larger. On bent
    grids what is left of the square root decays as size^-3, measured.
    """
    (coarse, error), size = observed[-1], grid.size
    guess = _SAFETY * error ** (size / coarse)
    if grid.map.bend:
        guess = max(guess, error * (coarse / size) ** 3)
    if len(observed) > 1:
        coarser, before = observed[-2]
        guess = max(guess, 3 * error * (error / before) ** ((size - coarse) / (coarse - coarser)))
    return float(guess)
