"""Folds, corners and neutral points of the family by shooting: roots in its own parameters.

A point is (delta, sigma_0, ...): the family never folds along sigma_0 = sigma(0). At a fold the
wall angle psi_w is stationary in sigma_0; its derivative solves the linear equations with
lambda = 0, so a fold is where the disturbance of lambda = 0, called D(0), vanishes at the wall. A
corner of the stable domain is a fold with a double zero there, D(0) = D'(0) = 0.
"""

from math import degrees, exp, log, radians

import numpy as np

from hopper.problem import Hopper
from tests.stability.tilted_witnesses import SYMMETRIC, Base, shoot, to_wall


def newton(function, start, step=1e-5, rounding=1e-12):
    """Solve function(x) = 0 by Newton with central differences; return x and the last step.

    Ends when steps no longer shrink below 1e-8: what is left is rounding.
    """
    x, last = np.asarray(start, dtype=float), np.inf
    for _ in range(30):
        columns = []
        for i in range(x.size):
            shift = np.zeros(x.size)
            shift[i] = step * max(1.0, abs(x[i]))
            columns.append((function(x + shift) - function(x - shift)) / (2 * shift[i]))
        move = np.linalg.solve(np.array(columns).T, function(x))
        x, size = x - move, float(np.abs(move).max())
        if size < rounding or (size < 1e-8 and size > last / 4):
            return x, size
        last = size
    raise AssertionError(f"Newton did not converge: x = {x}, last step {size:.1e}")


def wall_friction(solution) -> float:
    """Return phi (radians) of the wall a Base belongs to, from the stresses at the wall."""
    s, psi = solution.hopper.s, to_wall(solution, 0).psi
    return float(np.arctan(s * np.sin(2 * psi) / (1 + s * np.cos(2 * psi))))


def at_zero(solution) -> tuple[float, float]:
    """Return D(0) and D'(0)."""
    wall = to_wall(solution, 0)
    return wall.psi1[0].real, wall.d_psi1[0].real


def fold(hopper: Hopper, sigma_axis: float) -> Base:
    """Return the fold next to a member, by D(0) = 0."""

    def wall_slope(x):
        return np.array([at_zero(Base(hopper, exp(x[0])))[0]])

    return Base(hopper, exp(newton(wall_slope, [log(sigma_axis)])[0][0]))


def psi_wall_slope(solution: Base, step=1e-3) -> float:
    """Return d psi_w / d log sigma_0 by differences of radial solutions of eighth order."""

    def psi_wall(shift):
        return to_wall(Base(solution.hopper, solution.sigma_axis * exp(shift)), 0).psi

    weights = 4 / 5, -1 / 5, 4 / 105, -1 / 280
    return sum(
        weight * (psi_wall(i * step) - psi_wall(-i * step)) / step
        for i, weight in enumerate(weights, start=1)
    )


def corner(half_angle_deg: float, delta_deg: float, sigma_axis: float):
    """Return the corner of a cone's stable domain, delta and phi in degrees, and its Base."""

    def member(x):
        return Base(Hopper("cone", x[0], radians(half_angle_deg)), exp(x[1]))

    x, _ = newton(lambda x: np.array(at_zero(member(x))), [radians(delta_deg), log(sigma_axis)])
    return degrees(x[0]), degrees(wall_friction(member(x))), member(x)


def neutral(geometry, half_angle_deg, phi_deg, start, parity=SYMMETRIC):
    """Return delta (degrees) of a purely imaginary mode, omega and sigma_0, for a given wall.

    ``start`` is (delta in degrees, sigma_0, omega) nearby.
    """

    def member(x):
        return Base(Hopper(geometry, x[0], radians(half_angle_deg)), exp(x[1]))

    def conditions(x):
        solution = member(x)
        wall, s = to_wall(solution, 1j * x[2], parity), solution.hopper.s
        # T_rt + tan(phi) T_tt = 0 over sigma: the law of friction at the wall.
        slip = np.tan(radians(phi_deg)) * (1 + s * np.cos(2 * wall.psi)) - s * np.sin(2 * wall.psi)
        return np.array([slip, wall.psi1[0].real, wall.psi1[0].imag])

    x, _ = newton(conditions, [radians(start[0]), log(start[1]), start[2]])
    return degrees(x[0]), x[2], exp(x[1])


def positive_real_modes(solution, reach=60.0) -> np.ndarray:
    """Return the real eigenvalues in (1e-7, reach): real lambda have real D, its signs tell."""
    grid = np.concatenate([np.geomspace(1e-7, 0.1, 60), np.linspace(0.1, reach, 400)[1:]])
    signs = np.sign(to_wall(solution, grid, rtol=1e-11).psi1.real)
    change = np.flatnonzero(signs[1:] != signs[:-1])
    return np.array([shoot(solution, (grid[i] + grid[i + 1]) / 2).real for i in change])
