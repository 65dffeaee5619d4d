"""The linearised equations in the paper's frame by computer algebra, and small helpers.

Nothing here uses the code under test but the radial fields. Modes and the line by second ways:
:mod:`tests.stability.tilted_chebyshev`, ``tilted_witnesses`` and ``tilted_line``.
"""

from functools import lru_cache
from math import atan, cos, radians, sin

import numpy as np
import sympy as sp  # type: ignore[import-untyped]
from scipy.optimize import linear_sum_assignment

from hopper import Hopper, RadialSolution, solve_radial
from hopper.problem import Geometry


@lru_cache(maxsize=64)
def radial(geometry: Geometry, delta: float, half_angle: float, mu: float = 0.0) -> RadialSolution:
    """Return the radial solution of a hopper given in degrees."""
    return solve_radial(Hopper(geometry, radians(delta), radians(half_angle)), atan(mu))


def partner_distances(left, right):
    """Distance of each entry of the shorter list to its one-to-one partner in the other.

    Relative to max(1, |entry|).
    """
    if len(left) > len(right):
        left, right = right, left
    distance = np.abs(left[:, None] - right) / np.maximum(1, np.abs(left))[:, None]
    return distance[linear_sum_assignment(distance)]


@lru_cache(maxsize=2)
def _linearised_equations(k):
    """Lambdify the matrices of u_t, u_theta and u in (2.8), (2.9) linearised by computer algebra.

    u = (sigma1, psi1); arguments of the function: s, theta, sigma0, psi0, sigma0', psi0'.
    """
    t, theta, s, eps = sp.symbols("t theta s epsilon")
    sigma0, psi0 = (sp.Function(name)(theta) for name in ("sigma0", "psi0"))
    sigma1, psi1 = (sp.Function(name)(t, theta) for name in ("sigma1", "psi1"))
    r = sp.exp(t)
    sigma = r * (sigma0 + eps * sigma1)
    psi = psi0 + eps * psi1
    trr = sigma * (1 - s * sp.cos(2 * psi))
    ttt = sigma * (1 + s * sp.cos(2 * psi))
    trt = -sigma * s * sp.sin(2 * psi)
    tpp = sigma * (1 + s)
    d_r, cot = (lambda f: sp.diff(f, t) / r), sp.cot(theta)
    radial_equation = (
        d_r(trr)
        + sp.diff(trt, theta) / r
        + ((1 + k) * trr - ttt - k * tpp + k * cot * trt) / r
        + sp.cos(theta)
    )
    angular_equation = (
        d_r(trt)
        + sp.diff(ttt, theta) / r
        + ((2 + k) * trt + k * cot * (ttt - tpp)) / r
        - sp.sin(theta)
    )
    linear = sp.Matrix([radial_equation, angular_equation]).diff(eps).subs(eps, 0)
    unknowns = [sigma1.diff(t), psi1.diff(t), sigma1.diff(theta), psi1.diff(theta), sigma1, psi1]
    base = [sigma0.diff(theta), psi0.diff(theta), sigma0, psi0]
    plain = sp.symbols("a:6"), sp.symbols("b:4")
    linear = linear.subs(list(zip(unknowns, plain[0], strict=True)))
    # The equations are autonomous in t: any r does.
    linear = linear.subs(list(zip(base, plain[1], strict=True))).subs(t, 0)
    dsigma, dpsi, value, angle = plain[1]
    arguments = (s, theta, value, angle, dsigma, dpsi)
    return sp.lambdify(arguments, list(linear.jacobian(plain[0])), "numpy", cse=True)


def derived_coefficients(solution: RadialSolution, theta):
    """Return A and F of u_t + A u_theta + F u = 0 at ``theta``, each of shape (n, 2, 2)."""
    hopper = solution.hopper
    entries = _linearised_equations(hopper.curvature)(hopper.s, theta, *solution.fields(theta))
    entries = np.array([np.broadcast_to(entry, theta.shape) for entry in entries])
    in_time, in_angle, algebraic = np.moveaxis(entries.reshape(2, 3, 2, -1), (1, 3), (0, 1))
    return np.linalg.solve(in_time, in_angle), np.linalg.solve(in_time, algebraic)


def wall_tangency_friction(delta: float) -> float:
    """Return the friction angle (radians) of the wall on which psi_w = pi/4 - delta/2."""
    return atan(sin(delta) * cos(delta) / (1 + sin(delta) ** 2))
