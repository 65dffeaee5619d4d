"""Modes by shooting, for every radial solution, before the tangency and beyond it.

With modes exp(-lambda t) the linear equations are u_theta = (lambda N - K) u, regular while
psi < pi/4 + delta/2. The radial solution is integrated along with them from its stress on the axis,
so that nothing but ``hopper`` and ``sigma_axis`` is taken from the package; N and K are those of
:mod:`tests.stability.tilted_equations`.

Parities: "symmetric" is sigma1 even, psi1 odd; "asymmetric" the reverse, for wedges only.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import atan, pi, radians

import numpy as np
from scipy.integrate import solve_ivp

from hopper.problem import Hopper
from hopper.radial.solution import RadialSolution, solve_radial
from tests.stability.tilted_equations import compiled

SYMMETRIC, ASYMMETRIC = "symmetric", "asymmetric"
_RTOL, _ATOL = 1e-13, 1e-15
# Start of a cone's integration relative to the width of the layer at the axis. What the series
# leaves out is of its square, and the singular solution it excites falls off as its square again.
_START = 1e-5


@dataclass(frozen=True)
class Base:
    """A member of the family: the hopper and the average stress on its axis."""

    hopper: Hopper
    sigma_axis: float


def base(solution) -> Base:
    """Return what shooting needs of a RadialSolution; a Base passes."""
    return solution if isinstance(solution, Base) else Base(solution.hopper, solution.sigma_axis)


def hopper_of(case) -> RadialSolution:
    """Return the radial solution of an entry of the reference files (degrees; mu or phi)."""
    hopper = Hopper(case["geometry"], radians(case["delta_deg"]), radians(case["half_angle_deg"]))
    phi = atan(case["mu"]) if "mu" in case else radians(case["phi_deg"])
    return solve_radial(hopper, phi, case.get("branch", "physical"))


@dataclass(frozen=True)
class AtWall:
    """Radial solution and regular disturbances at the wall; ``d_*`` by lambda, shape (n,)."""

    sigma: float
    psi: float
    sigma1: np.ndarray
    psi1: np.ndarray
    d_sigma1: np.ndarray
    d_psi1: np.ndarray


def to_wall(solution, eigenvalues, parity=SYMMETRIC, rtol=_RTOL) -> AtWall:
    """Integrate the radial solution and the regular disturbance of each lambda to the wall.

    The disturbance is scaled to sigma1(0) = 1 (symmetric) or psi1(0) = 1 (asymmetric).
    """
    member = base(solution)
    hopper = member.hopper
    k, s, half_angle = hopper.curvature, hopper.s, hopper.half_angle
    assert parity == SYMMETRIC or k == 0, "asymmetric disturbances of cones are singular"
    lam = np.atleast_1d(np.asarray(eigenvalues, dtype=complex))
    f, n = compiled(k), lam.size

    def slopes(theta, y):
        sigma, psi, n11, n12, n21, n22, k11, k12, k21, k22 = f(s, theta, y[0].real, y[1].real)
        a, b, da, db = y[2:].reshape(4, n)
        m11, m12, m21, m22 = lam * n11 - k11, lam * n12 - k12, lam * n21 - k21, lam * n22 - k22
        return np.concatenate([
            [sigma, psi], m11 * a + m12 * b, m21 * a + m22 * b,
            m11 * da + m12 * db + n11 * a + n12 * b, m21 * da + m22 * db + n21 * a + n22 * b,
        ])  # fmt: skip

    zero, one = np.zeros(n, dtype=complex), np.ones(n, dtype=complex)
    start, y = 0.0, np.concatenate([[member.sigma_axis, 0], one, zero, zero, zero])
    if parity == ASYMMETRIC:
        y[2 : 2 + n], y[2 + n : 2 + 2 * n] = 0, 1
    if k:
        start = _START * min(1.0, member.sigma_axis, 1 / (1 + np.abs(lam).max())) * half_angle
        # psi = p theta: its slope is prescribed as (psi' at psi = 0) - k p; alike for psi1.
        y[1] = f(s, start, member.sigma_axis, 0.0)[1] / (1 + k) * start
        at = f(s, start, member.sigma_axis, y[1].real)
        y[2 + n : 2 + 2 * n] = (lam * at[4] - at[8]) / (1 + k) * start
        y[2 + 3 * n :] = at[4] / (1 + k) * start
        # sigma and sigma1 are even: their slopes grow linearly from the axis.
        slope = slopes(start, y)
        y[0] += slope[0] * start / 2
        y[2 : 2 + n] += slope[2 : 2 + n] * start / 2
        y[2 + 2 * n : 2 + 3 * n] += slope[2 + 2 * n : 2 + 3 * n] * start / 2
    done = solve_ivp(slopes, (start, half_angle), y, "DOP853", rtol=rtol, atol=_ATOL)
    assert done.success, done.message
    end = done.y[:, -1]
    return AtWall(end[0].real, end[1].real, *end[2:].reshape(4, n))


def shoot(solution, guess, parity=SYMMETRIC, rtol=_RTOL) -> complex:
    """Return the eigenvalue near ``guess``: Newton in lambda on psi1(theta_w) = 0."""
    lam, last = complex(guess), np.inf
    for _ in range(40):
        wall = to_wall(solution, lam, parity, rtol)
        step = wall.psi1[0] / wall.d_psi1[0]
        lam -= step
        size = abs(step) / max(1.0, abs(lam))
        # Quadratic convergence: the error left is of the square of the step, down to rounding.
        if size < 1e-9 or (size < 1e-7 and size > last / 4):
            return lam
        last = size
    raise AssertionError(f"shooting did not converge near {guess}: last step {size:.1e}")


def _boundary(low, high, panels):
    """Return points and complex weights of Gauss-Legendre panels around a rectangle."""
    x, weight = np.polynomial.legendre.leggauss(16)
    corners = [low, complex(high.real, low.imag), high, complex(low.real, high.imag), low]
    points, weights = [], []
    for start, end in pairwise(corners):
        edges = start + (end - start) * np.linspace(0, 1, panels + 1)
        middle, half = (edges[1:] + edges[:-1]) / 2, (edges[1:] - edges[:-1]) / 2
        points.append((middle[:, None] + half[:, None] * x).ravel())
        weights.append((half[:, None] * weight).ravel())
    return np.concatenate(points), np.concatenate(weights)


def moments(solution, low, high, parity=SYMMETRIC, panels=3) -> tuple[complex, complex]:
    """Return number and sum of the eigenvalues in the rectangle, by the argument principle.

    psi1(theta_w) is entire in lambda: (1 / 2 pi i) times the contour integrals of its logarithmic
    derivative, and of that times lambda.
    """
    points, weights = _boundary(complex(low), complex(high), panels)
    wall = to_wall(solution, points, parity, rtol=1e-9)
    density = weights * wall.d_psi1 / wall.psi1 / (2j * pi)
    return density.sum(), (density * points).sum()


def count(solution, low, high, parity=SYMMETRIC) -> int:
    """Return the number of eigenvalues in the rectangle; refines until it is an integer."""
    for panels in (3, 6, 12, 24, 48):
        number = moments(solution, low, high, parity, panels)[0]
        if abs(number - round(number.real)) < 1e-3:
            return round(number.real)
    raise AssertionError(f"an eigenvalue lies on the boundary of {low} ... {high}")


def modes(solution, low, high, parity=SYMMETRIC) -> np.ndarray:
    """Return all eigenvalues in the rectangle, by bisection down to single ones and Newton."""
    low, high = complex(low), complex(high)
    number = count(solution, low, high, parity)
    if number == 0:
        return np.zeros(0, dtype=complex)
    if number == 1:
        for panels in (6, 12, 24):
            guess = moments(solution, low, high, parity, panels)[1]
            found = shoot(solution, guess, parity)
            inside = low.real < found.real < high.real and low.imag < found.imag < high.imag
            if inside:
                return np.array([found])
    # Off the middle, where real eigenvalues of symmetric rectangles would lie.
    size, part = high - low, 0.5377
    if size.real > size.imag:
        cut = low.real + part * size.real
        halves = [(low, complex(cut, high.imag)), (complex(cut, low.imag), high)]
    else:
        cut = low.imag + part * size.imag
        halves = [(low, complex(high.real, cut)), (complex(low.real, cut), high)]
    return np.concatenate([modes(solution, *half, parity) for half in halves])
