"""Second ways to modes of von Mises cones: another discretisation, and shooting.

The package under test lends only the radial fields, and to shooting only sigma0 on the axis.
"""

import json
from functools import lru_cache
from math import atan, cos, radians, sin, sqrt, tan
from pathlib import Path

import numpy as np
import sympy as sp  # type: ignore[import-untyped]
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp
from scipy.linalg import eig

from hopper.problem import Hopper
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.yield_conditions import VON_MISES
from tests.von_mises.motion import BASE, JET, linear_parts, mu, s, theta

# Modes, laws and neutral points by two collocation meshes of a program apart from this one and by
# Taylor expansion and DOP853; each with its error. Angles in degrees.
REFERENCE = json.loads((Path(__file__).parents[1] / "data/von_mises_modes.json").read_text())
SETS = [(one["delta"], one["half_angle"], one["mu"]) for one in REFERENCE["sets"]]


def cone(delta: float, half_angle: float) -> Hopper:
    """Return a von Mises cone given in degrees."""
    return Hopper("cone", radians(delta), radians(half_angle), VON_MISES)


@lru_cache(maxsize=64)
def radial(delta: float, half_angle: float, friction: float) -> RadialSolution:
    """Return the radial solution of a cone, angles in degrees, friction mu."""
    return solve_radial(cone(delta, half_angle), atan(friction))


def reference_modes(index: int):
    """Return the modes of a set of REFERENCE and their errors."""
    modes = REFERENCE["sets"][index]["modes"]
    return np.array([m["re"] + 1j * m["im"] for m in modes]), np.array([m["error"] for m in modes])


@lru_cache(maxsize=1)
def _equations():
    """Lambdify the matrices of rates, slopes and values of the unknowns in the linear equations.

    Rows: (2.8), (2.9), (2.10), (2.14), (2.13); columns S, Y, Z, U, W.
    """
    rows = sp.Matrix([linear_parts()[n] for n in ("2.8", "2.9", "2.10", "2.14", "2.13")])
    parts = [[rows.diff(JET[name][i]) for name in JET] for i in (1, 2, 0)]
    flat = [entry for part in parts for column in part for entry in column]
    wall = [linear_parts()["2.15"].diff(JET[name][0]) for name in JET]
    arguments = (s, theta, *BASE)
    return (
        sp.lambdify(arguments, flat, "numpy", cse=True),
        sp.lambdify((*arguments, mu), wall, "numpy", cse=True),
    )


def galerkin_modes(solution: RadialSolution, n: int):
    """Return the finite eigenvalues of the linear equations by a Legendre tau method.

    All five unknowns in n Legendre polynomials of their parity, t = log r not tilted; equations
    projected on the polynomials of theirs, of which the two odd ones leave a row each to the wall.
    """
    half_angle = solution.hopper.half_angle
    x, weight = legendre.leggauss(4 * n)
    x, weight = x[x > 0], weight[x > 0]
    basis = np.eye(2 * n)
    slopes = legendre.legder(basis, axis=0) / half_angle
    value = {p: legendre.legval(x, basis[:, p::2]).T for p in (0, 1)}
    slope = {p: legendre.legval(x, slopes[:, p::2]).T for p in (0, 1)}
    parity = (0, 1, 0, 0, 1)
    interior, wall = _equations()
    entries = interior(solution.hopper.s, half_angle * x, *solution.fields(half_angle * x))
    entries = np.array([np.broadcast_to(e, x.shape) for e in entries]).reshape(3, 5, 5, -1)
    left, right = np.zeros((2, 5 * n, 5 * n))
    for row, test in enumerate((0, 1, 0, 1, 0)):
        count = n - test
        project = (weight[:, None] * value[test][:, :count]).T
        at = slice(row * n, row * n + count)
        for column, p in enumerate(parity):
            to = slice(column * n, (column + 1) * n)
            rate, incline, plain = (part[column, row][:, None] for part in entries)
            left[at, to] = project @ (incline * slope[p] + plain * value[p])
            right[at, to] = project @ (rate * value[p])
    end = [f[0] for f in solution.fields([half_angle])]
    law = wall(solution.hopper.s, half_angle, *end, tan(solution.friction_angle))
    for column in range(5):
        left[2 * n - 1, column * n : (column + 1) * n] = law[column]
    left[4 * n - 1, 4 * n :] = 1.0
    alpha, beta = eig(left, right, right=False, homogeneous_eigvals=True)
    finite = np.abs(beta) > 1e-9 * np.abs(alpha)
    return alpha[finite] / beta[finite]


class Shooting:
    """The theta-form of the equations, integrated from the axis with the radial flow itself."""

    def __init__(self, solution: RadialSolution):
        self.s = sin(solution.hopper.delta)
        self.m = self.s / sqrt(3)
        self.mu = tan(solution.friction_angle)
        self.sigma0, self.wall = solution.sigma_axis, solution.hopper.half_angle

    def base_slopes(self, angle, log_sigma, psi):
        """Slopes of log sigma and psi by (2.8), (2.9)."""
        s, m, c, q = self.s, self.m, cos(2 * psi), sin(2 * psi)
        light = np.exp(-log_sigma)
        first = -(3 * (1 - 2 * m * c) - 2 * (1 + m * c) - s * q / tan(angle) + cos(angle) * light)
        second = 4 * s * q + sin(angle) * light
        a11, a12, a21, a22 = -s * q, -2 * s * c, 1 + m * c, -2 * m * q
        determinant = a11 * a22 - a12 * a21
        return (a22 * first - a12 * second) / determinant, (
            a11 * second - a21 * first
        ) / determinant

    def slopes(self, angle, y, lam):
        """Slopes of log sigma, psi and of P, Q, U, W, shape (4, k) for k solutions."""
        s, m = self.s, self.m
        log_sigma, psi = y[0].real, y[1].real
        l, dpsi = self.base_slopes(angle, log_sigma, psi)  # noqa: E741
        c, q, cot = cos(2 * psi), sin(2 * psi), 1 / tan(angle)
        P, Q, U, W = y[2:].reshape(4, -1)
        Z = c / sqrt(12) * (lam * U - 2 * cot * W)
        B = P - s * Z
        S = (c * B - q / sqrt(3) * Q) / (c + m)
        Y = -((1 + m * c) * Q + s * q * B) / (2 * s * (c + m))
        R = (1 - 2 * m * c) * S + 4 * m * q * Y
        return np.concatenate([
            [l, dpsi],
            -l * P + (lam - 4) * Q - 2 * s * cot * Z,
            -(l + cot) * Q + (lam - 3) * R + 2 * B,
            (3 + lam) * W - sqrt(3) * q / c * lam * U - 4 * sqrt(3) / c**2 * Y,
            lam * U - (cot - sqrt(12) * q / c) * W,
        ])  # fmt: skip

    def determinant(self, eigenvalues):
        """Determinant of (W, Q + mu P) at the wall of the two solutions regular on the axis."""
        s, m, lam = self.s, self.m, np.asarray(eigenvalues, dtype=complex)
        k, start = lam.size, 1e-5 * self.wall
        incline = (1 + (1 - 8 * m) * self.sigma0) / (4 * s * self.sigma0)
        y = np.zeros((4, 2, k), dtype=complex)
        y[0, 0], y[1, 0] = 1, ((lam - 3) * (1 - 2 * m) / (1 + m) + 2) * start / 2
        y[2, 1], y[3, 1] = 1, lam * start / 2
        base = [np.log(self.sigma0), incline * start]
        twice = np.concatenate([lam, lam])
        done = solve_ivp(
            self.slopes, (start, self.wall), np.concatenate([base, y.ravel()]), method="DOP853",
            args=(twice,), rtol=1e-12, atol=1e-14,
        )  # fmt: skip
        P, Q, _, W = done.y[2:, -1].reshape(4, 2, k)
        law = Q + self.mu * P
        return law[0] * W[1] - law[1] * W[0]

    def roots(self, guesses):
        """Roots of the determinant near the guesses by the secant method, all at once."""
        previous = np.asarray(guesses, dtype=complex)
        current = previous + 1e-5 * np.maximum(1, np.abs(previous))
        before, now = self.determinant(previous), self.determinant(current)
        for _ in range(8):
            step = now * (current - previous) / (now - before)
            previous, before, current = current, now, current - step
            if np.all(np.abs(step) < 1e-10 * np.maximum(1, np.abs(current))):
                return current
            now = self.determinant(current)
        raise AssertionError(f"secant method did not converge: last steps {np.abs(step)}")


def law_by_shooting(solution: RadialSolution, points: int = 48):
    """Return Phi, Gamma of both families and A, B, C, F of the law of high frequency.

    K1 and K0 of V = (P, Q, lambda U, lambda W) are read off the theta-form at three lambda; its
    eigenvectors are numpy's, their slopes central differences; Gauss-Legendre quadrature.
    """
    form = Shooting(solution)

    def parts(theta):
        sigma, psi, _, _ = (f[0] for f in solution.fields([theta]))

        def matrix(lam):
            columns = form.slopes(theta, np.array([np.log(sigma), psi, *np.eye(4).ravel()]), lam)
            scale = np.array([1, 1, lam, lam])
            return columns[2:].reshape(4, 4) * scale[:, None] / scale

        plus, minus, two = matrix(1.0), matrix(-1.0), matrix(2.0)
        k0 = (plus + minus) / 2
        odd = (plus - minus) / 2
        return (two - k0 - odd / 2) / 1.5, k0

    def waves(theta):
        """Slopes and right vectors of a+, b+, b-, a-, and K0."""
        k1, k0 = parts(theta)
        kappa, right = np.linalg.eig(k1)
        if np.iscomplexobj(kappa):
            order = np.lexsort((kappa.imag * np.sign(kappa.real), -np.sign(kappa.real)))
            order = order[[0, 1, 3, 2]]
        else:
            order = np.argsort(-kappa)
        right = right[:, order]
        return kappa[order], right / right[3], k0

    def exponents(theta):
        h = 2e-4 * form.wall
        kappa, right, k0 = waves(theta)
        slope = (
            sum(
                w * (waves(theta + i * h)[1] - waves(theta - i * h)[1])
                for i, w in ((1, 0.75), (2, -0.15), (3, 1 / 60))
            )
            / h
        )
        g = np.linalg.inv(right) @ (k0 @ right - slope)
        return kappa[:2], np.diag(g)[:2]

    # Differences next to the wall need room, which the nodes leave.
    x, weight = legendre.leggauss(points)
    sums = [exponents(form.wall * node) for node in x]
    phi, gamma = (
        form.wall * sum(w * one[i] for w, one in zip(weight, sums, strict=True)) for i in (0, 1)
    )
    _, right, _ = waves(form.wall)
    v = right[1] + form.mu * right[0]
    a_out, b_out, b_in, a_in = v
    return phi, gamma, np.array([a_in - b_in, a_out - b_in, a_in - b_out, a_out - b_out])
