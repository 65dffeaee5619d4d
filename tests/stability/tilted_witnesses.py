"""Modes by shooting, for every radial solution, before the tangency and beyond it.

With modes exp(-lambda t) the linear equations are u_theta = (lambda N - K) u, regular while
psi < pi/4 + delta/2. The radial solution is integrated along with them from its stress on the axis,
so that nothing but ``hopper`` and ``sigma_axis`` is taken from the package; N and K are those of
:mod:`tests.stability.tilted_equations`.

Parities: "symmetric" is sigma1 even, psi1 odd; "asymmetric" the reverse, for wedges only.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np
from scipy.integrate import solve_ivp

from hopper.problem import Hopper
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


@dataclass(frozen=True)
class AtWall:
    """Radial solution and regular disturbances at the wall; ``d_*`` by lambda, shape (n,)."""

    sigma: float
    psi: float
    sigma1: np.ndarray
    psi1: np.ndarray
    d_sigma1: np.ndarray
    d_psi1: np.ndarray


def on_axis(member: Base, fastest: float = 1.0) -> tuple[float, list[float]]:
    """Return theta, sigma and psi where integration starts: on the axis, in cones next to it.

    ``fastest`` is the largest rate along theta that must not have turned anything there.
    """
    hopper, sigma = member.hopper, member.sigma_axis
    k, f = hopper.curvature, compiled(hopper.curvature)
    if k == 0:
        return 0.0, [sigma, 0.0]
    start = _START * min(1.0, sigma, 1 / fastest) * hopper.half_angle
    # psi = p theta: its slope is prescribed as (psi' at psi = 0) - k p.
    psi = f(hopper.s, start, sigma, 0.0)[1] / (1 + k) * start
    # sigma is even: its slope grows linearly from the axis.
    return start, [sigma + f(hopper.s, start, sigma, psi)[0] * start / 2, psi]


def to_wall(solution, eigenvalues, parity=SYMMETRIC, rtol=_RTOL) -> AtWall:
    """Integrate the radial solution and the regular disturbance of each lambda to the wall.

    The disturbance is scaled to sigma1(0) = 1 (symmetric) or psi1(0) = 1 (asymmetric).
    """
    member = base(solution)
    hopper = member.hopper
    k, s = hopper.curvature, hopper.s
    assert parity == SYMMETRIC or k == 0, "asymmetric disturbances of cones are singular"
    lam = np.atleast_1d(np.asarray(eigenvalues, dtype=complex))
    f, n = compiled(k), lam.size

    both = np.concatenate([lam, lam])

    def slopes(theta, y):
        values = f(s, theta, y[0].real, y[1].real)
        # Columns of u: the disturbances, then their derivatives by lambda.
        u = y[2:].reshape(2, 2 * n)
        in_time, algebraic = np.array(values[2:]).reshape(2, 2, 2) @ u
        u_theta = both * in_time - algebraic
        u_theta[:, n:] += in_time[:, :n]
        return np.concatenate([values[:2], u_theta.ravel()])

    start, radial = on_axis(member, 1 + np.abs(lam).max())
    u = np.zeros((2, 2 * n), dtype=complex)
    u[0 if parity == SYMMETRIC else 1, :n] = 1
    if k:
        # As psi and sigma of the radial solution: psi1 odd, sigma1 even.
        _, _, _, _, n21, _, _, _, k21, _ = f(s, start, *radial)
        u[1, :n], u[1, n:] = (lam * n21 - k21) / (1 + k) * start, n21 / (1 + k) * start
        u[0] += slopes(start, np.concatenate([radial, u.ravel()]))[2 : 2 + 2 * n] * start / 2
    y = np.concatenate([radial, u.ravel()])
    done = solve_ivp(slopes, (start, hopper.half_angle), y, "DOP853", rtol=rtol, atol=_ATOL)
    assert done.success, done.message
    end = done.y[:, -1]
    return AtWall(end[0].real, end[1].real, *end[2:].reshape(4, n)[[0, 2, 1, 3]])


def shoot(solution, guess, parity=SYMMETRIC, rtol=_RTOL) -> complex:
    """Return the eigenvalue near ``guess``: Newton in lambda on psi1(theta_w) = 0."""
    return complex(shoot_all(solution, [guess], parity, rtol)[0])


def shoot_all(solution, guesses, parity=SYMMETRIC, rtol=_RTOL) -> np.ndarray:
    """Return the eigenvalues near several guesses, shot together."""
    lam, last = np.array(guesses, dtype=complex), np.inf
    for _ in range(40):
        wall = to_wall(solution, lam, parity, rtol)
        step = wall.psi1 / wall.d_psi1
        lam = lam - step
        size = float((np.abs(step) / np.maximum(1, np.abs(lam))).max())
        # Quadratic convergence: the error left is of the square of the step, down to rounding.
        if size < 1e-9 or (size < 1e-7 and size > last / 4):
            return lam
        last = size
    raise AssertionError(f"shooting did not converge near {guesses}: last step {size:.1e}")


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


def contour(solution, low, high, parity=SYMMETRIC) -> tuple[int, complex]:
    """Return number and sum of the eigenvalues in the rectangle, by the argument principle.

    psi1(theta_w) is entire in lambda. Its winding number is added up from turns between points;
    the points are dense enough when no turn is large and the integral of its logarithmic
    derivative, over 2 pi i, says the same.
    """
    for panels in (3, 6, 12, 24):
        points, weights = _boundary(complex(low), complex(high), panels)
        wall = to_wall(solution, points, parity, rtol=1e-9)
        turns = np.angle(np.roll(wall.psi1, -1) / wall.psi1)
        number = round(turns.sum() / (2 * pi))
        density = weights * wall.d_psi1 / wall.psi1 / (2j * pi)
        if np.abs(turns).max() < 1.6 and abs(density.sum() - number) < 1e-2:
            return number, (density * points).sum()
    raise AssertionError(f"an eigenvalue lies on the boundary of {low} ... {high}")


def modes(solution, low, high, parity=SYMMETRIC) -> np.ndarray:
    """Return all eigenvalues in the rectangle, by bisection down to single ones and Newton."""
    number, total = contour(solution, low, high, parity)
    return _modes(solution, complex(low), complex(high), parity, number, total)


def _modes(solution, low, high, parity, number, total):
    if number == 0:
        return np.zeros(0, dtype=complex)
    if number == 1:
        # The sum is the eigenvalue, but for the quadrature.
        return np.array([shoot(solution, total, parity)])
    size = high - low
    # Off the middle, where real eigenvalues of symmetric rectangles would lie.
    for part in (0.5377, 0.4291, 0.6413):
        if size.real > size.imag:
            upper = complex(low.real + part * size.real, high.imag)
            lower = complex(upper.real, low.imag)
        else:
            lower = complex(low.real, low.imag + part * size.imag)
            upper = complex(high.real, lower.imag)
        try:
            first = contour(solution, low, upper, parity)
        except AssertionError:
            continue
        # What is not in the one part is in the other.
        rest = number - first[0], total - first[1]
        return np.concatenate([
            _modes(solution, low, upper, parity, *first),
            _modes(solution, lower, high, parity, *rest),
        ])  # fmt: skip
    raise AssertionError(f"eigenvalues not separated in {low} ... {high}")
