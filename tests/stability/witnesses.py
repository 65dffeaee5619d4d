"""Second ways to the linearised equations, their modes and their line, for the spectral tests.

Nothing here uses the code under test but the radial fields: the coefficients come from the
equations of motion by computer algebra, low modes from a Legendre-Galerkin method or by shooting.
"""

from functools import lru_cache
from math import atan, cos, pi, radians, sin

import numpy as np
import sympy as sp  # type: ignore[import-untyped]
from numpy.polynomial import legendre
from scipy.integrate import quad, solve_ivp
from scipy.linalg import eigvals
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


def galerkin_modes(solution: RadialSolution, size: int):
    """Return the eigenvalues of physical parity by a Legendre-Galerkin method.

    The equations are solved for the angular derivatives, U' + A^-1 F U = lambda A^-1 U, with
    sigma1 in the even polynomials P_0 ... P_(2 size - 2) and psi1 in the odd ones
    P_(2 j + 1) - P_(2 j - 1), which vanish at the wall; Gauss-Legendre quadrature.
    """
    x, weight = legendre.leggauss(4 * size)
    x, weight = x[x > 0], weight[x > 0]
    basis = np.eye(2 * size)
    slopes = legendre.legder(basis, axis=0) / solution.hopper.half_angle
    even, d_even = (legendre.legval(x, c[:, 0::2]).T for c in (basis, slopes))
    odd, d_odd = (np.diff(legendre.legval(x, c[:, 1::2]).T, axis=1) for c in (basis, slopes))
    a, f = derived_coefficients(solution, solution.hopper.half_angle * x)
    inverse = np.linalg.inv(a)
    potential = inverse @ f
    trial, d_trial = (even, odd), (d_even, d_odd)
    # The equation for sigma1' is odd, that for psi1' even.
    test = (odd, even)

    def project(row, column):
        weighted = weight[:, None] * test[row]
        left = weighted.T @ (potential[:, row, column, None] * trial[column])
        if row == column:
            left += weighted.T @ d_trial[column]
        return left, weighted.T @ (inverse[:, row, column, None] * trial[column])

    blocks = [[project(row, column) for column in range(2)] for row in range(2)]
    left, right = (np.block([[block[side] for block in row] for row in blocks]) for side in (0, 1))
    return eigvals(left, right)


def shoot(solution: RadialSolution, eigenvalues):
    """Return psi1 at the wall of solutions regular on the axis, sigma1(0) = 1, for each lambda.

    DOP853 on U' = A^-1 (lambda - F) U from theta_0 = 1e-5 theta_w. There sigma1 = 1 and
    psi1 = b theta, with b from the first equation at the axis; terms left out are of relative
    size (|Im lambda| theta_0)^2 in psi1, of which the wall sees no more than the cube.
    """
    half_angle = solution.hopper.half_angle
    eigenvalues = np.asarray(eigenvalues, dtype=complex)
    start = np.array([1e-5 * half_angle])
    a, f = derived_coefficients(solution, start)
    # psi1 = b theta: A12 b + F12 theta b = lambda - F11, terms of order theta^2 left out.
    slope = (eigenvalues - f[0, 0, 0]) / (a[0, 0, 1] + f[0, 0, 1] * start)
    u0 = np.concatenate([np.ones_like(slope), slope * start])

    def right(theta, u):
        a, f = derived_coefficients(solution, np.array([theta]))
        u = u.reshape(2, -1)
        return np.linalg.solve(a[0], eigenvalues * u - f[0] @ u).ravel()

    done = solve_ivp(right, (start[0], half_angle), u0, method="DOP853", rtol=1e-12, atol=1e-14)
    return done.y[eigenvalues.size :, -1]


def shooting_roots(solution: RadialSolution, guesses):
    """Return roots of :func:`shoot` near the guesses by the secant method, all at once."""
    previous = np.asarray(guesses, dtype=complex)
    current = previous * (1 + 1e-4)
    before, now = shoot(solution, previous), shoot(solution, current)
    for _ in range(8):
        step = now * (current - previous) / (now - before)
        previous, before = current, now
        current = current - step
        if np.all(np.abs(step) < 1e-9 * np.abs(current)):
            return current
        now = shoot(solution, current)
    raise AssertionError(f"secant method did not converge: last steps {np.abs(step)}")


def line_by_quadrature(solution: RadialSolution):
    """Return the abscissa of the asymptotic line and the spacing of modes by adaptive quadrature.

    For large lambda, U' = A^-1 (lambda - F) U has solutions along both eigenvectors (+-rho, 1) of
    A with exponents lambda times the eigenvalue of A^-1 less the diagonal of A^-1 F in that basis
    (plus a term alike for both). Regularity on the axis and psi1 = 0 at the wall couple the two
    with factors of modulus 1, so the difference of exponents has real part 0.
    """
    hopper = solution.hopper

    def difference(theta, part):
        theta = np.array([theta])
        a, f = derived_coefficients(solution, theta)
        rho = 2 * hopper.s * solution.fields(theta)[0][0] / cos(hopper.delta)
        basis = np.array([[rho, -rho], [1, 1]])
        inverse = np.linalg.inv(a[0])
        factor = inverse if part == "time" else inverse @ f[0]
        transformed = np.linalg.solve(basis, factor @ basis)
        return transformed[0, 0] - transformed[1, 1]

    def integral(part):
        return quad(difference, 0, hopper.half_angle, part, epsabs=1e-14, epsrel=1e-13)[0]

    time = integral("time")
    return integral("growth") / time, 2 * pi / abs(time)


def wall_tangency_friction(delta: float) -> float:
    """Return the friction angle (radians) of the wall on which psi_w = pi/4 - delta/2."""
    return atan(sin(delta) * cos(delta) / (1 + sin(delta) ** 2))
