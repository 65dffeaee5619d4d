"""The collocation matrix against exact solutions, shooting, and a second discretisation."""

from math import cos, log2, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import jn_zeros, lpmv

from hopper.errors import InvalidParameterError, SingularVelocityError
from hopper.problem import Hopper
from hopper.radial.grid import half_grid
from hopper.radial.solution import solve_radial, solve_radial_family
from hopper.radial.velocity import solve_velocity
from hopper.spectral import chebyshev
from hopper.von_mises.collocation import flow_rates, mode_matrix, stress_rates, without_flow_rate
from hopper.von_mises.linearisation import coefficients
from tests.stability.witnesses import partner_distances
from tests.von_mises.witnesses import SETS, Shooting, galerkin_modes, radial, reference_modes

FINE = 32


def eigenvalues(solution, n):
    return np.linalg.eigvals(without_flow_rate(mode_matrix(solution, n)))


@pytest.mark.parametrize("index", range(len(SETS)), ids=str)
def test_modes_by_shooting(index):
    modes, _ = reference_modes(index)
    found = eigenvalues(radial(*SETS[index]), FINE)
    lowest = modes[:4]
    mine = found[[np.argmin(np.abs(found - mode)) for mode in lowest]]
    # The guess is off by a millionth, so that shooting has to find its own root.
    roots = Shooting(radial(*SETS[index])).roots(mine * (1 + 1e-6))
    assert np.all(np.abs(roots - mine) < 1e-9 * np.maximum(1, np.abs(mine)))


@pytest.mark.parametrize("index", range(len(SETS)), ids=str)
def test_modes_of_the_reference(index):
    modes, errors = reference_modes(index)
    found = eigenvalues(radial(*SETS[index]), 2 * FINE)
    distances = np.abs(found[:, None] - modes).min(axis=0)
    rounding = 1e-12 * np.abs(modes)
    assert np.all(distances < 3 * errors + rounding)


@pytest.mark.parametrize("index", [0, 3, 5, 6, 9, 12])
def test_modes_by_a_second_discretisation(index):
    solution = radial(*SETS[index])
    n = 24
    galerkin = galerkin_modes(solution, n)
    # As many eigenvalues are finite as the matrix has, one of them the flow rate's.
    assert galerkin.size == 4 * n - 2
    assert len(mode_matrix(solution, n)) == 4 * n - 2
    galerkin = np.delete(galerkin, np.argmin(np.abs(galerkin)))
    low = galerkin[np.argsort(np.abs(galerkin))][:12]
    assert partner_distances(low, eigenvalues(solution, n)).max() < 1e-6
    assert partner_distances(low[:6], eigenvalues(solution, n)).max() < 1e-9


@pytest.mark.parametrize("index", range(len(SETS)), ids=str)
@pytest.mark.parametrize("n", [8, 13, 30])
def test_the_flow_rate_is_an_exact_mode_and_the_only_one_taken_out(index, n):
    matrix = mode_matrix(radial(*SETS[index]), n)
    flow_rate = np.zeros(4 * n - 2)
    flow_rate[2 * n - 1 : 3 * n - 1] = 1.0
    assert np.abs(matrix @ flow_rate).max() < 1e-13 * np.abs(matrix).max()
    rest = np.linalg.eigvals(without_flow_rate(matrix))
    every = np.linalg.eigvals(matrix)
    # Compared by the characteristic polynomial at points: eigenvalues of large modulus are
    # ill-conditioned.
    for z in (1.3, -2.0 + 3j, 5j):
        ratio = np.prod((every - z) / np.append(rest - z, -z))
        assert abs(ratio - 1) < 1e-7


@pytest.mark.parametrize("index", [0, 1, 2, 3])
@pytest.mark.parametrize("n", [12, 24, 40])
def test_modes_of_elliptic_flows_halve(index, n):
    # Each end carries half of the conditions, and one of them the flow rate: 2 n - 1, 1, 2 n - 2.
    found = eigenvalues(radial(*SETS[index]), n)
    assert np.sum(found.real < 0) == 2 * n - 1
    assert np.sum(found.real > 0) == 2 * n - 2


def test_an_eigenvalue_zero_of_another_mode_is_kept():
    # A matrix of this structure, shifted on all but the flow rate to have a second zero.
    n = 6
    size, block = 4 * n - 2, slice(2 * n - 1, 3 * n - 1)
    matrix = np.random.default_rng(5).normal(size=(size, size))
    matrix[:, block] -= matrix[:, block].mean(axis=1, keepdims=True)
    values = np.linalg.eigvals(without_flow_rate(matrix))
    flow_rate = np.zeros((size, 1))
    flow_rate[block] = 1 / sqrt(n)
    real = values[values.imag == 0].real[0]
    shifted = matrix - real * (np.eye(size) - flow_rate @ flow_rate.T)
    found = np.linalg.eigvals(without_flow_rate(shifted))
    assert partner_distances(values - real, found).max() < 1e-12
    assert np.abs(found).min() < 1e-12


# Exact solutions.


def translation(solution, theta):
    """S, Y, Z, U, W of an apex moved vertically; exact for lambda = 1, but at the walls."""
    sigma, psi, dsigma, dpsi = solution.fields(theta)
    h = sqrt(12) * np.tan(2 * psi)
    return (
        np.cos(theta) - dsigma / sigma * np.sin(theta),
        -(dpsi + sqrt(3) / 2) * np.sin(theta),
        np.sin(2 * psi) * np.sin(theta),
        -2 * np.cos(theta) + h * np.sin(theta),
        -np.sin(theta),
    )


def applied(solution, n, S, Y, U, W):
    """lambda (S, Y, U, W) of disturbances given by functions of theta, without walls.

    They are divided by exp(f) = u**(lambda / 4), the factor of the tilted time, beforehand.
    """
    grid = half_grid(n, solution.hopper.half_angle)
    at = coefficients(solution, [grid])[0]
    S, Y, U, W = (f[:, None] for f in (S, Y, U, W))
    flow = flow_rates(grid, at, Y, U, W)
    stress = stress_rates(grid, at, (S, Y, U, W), flow)
    return [f[:, 0] for f in (*stress[:2], *flow)]


@pytest.mark.parametrize("hopper", SETS)
def test_translation_of_the_apex(hopper):
    solution = radial(*hopper)
    residuals = []
    # Two derivatives of rounding errors grow with the mesh, truncation errors fall.
    for n in (14, 18, 24, 32):
        theta = half_grid(n, solution.hopper.half_angle).theta
        S, Y, _, U, W = translation(solution, theta)
        weight = solve_velocity(solution).at(theta) ** -0.25
        disturbance = [weight * f for f in (S, Y, U, W)]
        rates = applied(solution, n, *disturbance)
        size = max(np.abs(f).max() for f in disturbance)
        residuals.append(np.abs(np.array(rates) - disturbance).max() / size)
    assert min(residuals) < 1e-9


def test_translation_has_the_hoop_stress_of_the_flow_rule():
    solution = radial(40, 30, 0.2)
    grid = half_grid(32, solution.hopper.half_angle)
    at = coefficients(solution, [grid])[0]
    _, _, Z, _, W = translation(solution, grid.theta)
    by_rule = at.c / sqrt(12) * (grid.d_odd @ W - (at.h + at.cot) * W)
    np.testing.assert_allclose(Z, by_rule, atol=1e-11)


@pytest.mark.parametrize("hopper", [(25, 10, 0.1), (40, 30, 0.2), (50, 10, 0.2), (30, 30, 0.3)])
def test_derivative_of_the_family(hopper):
    """lambda = 0: solves the equations, and leaves the wall the change of its friction."""
    solution = radial(*hopper)
    n, step = 24, 1e-4 * solution.sigma_axis
    theta = half_grid(n, solution.hopper.half_angle).theta
    near = [
        solve_radial_family(solution.hopper, solution.sigma_axis + k * step) for k in (-2, -1, 1, 2)
    ]

    def by_sigma0(f):
        # Central difference of fourth order.
        a, b, c, d = (f(one) for one in near)
        return (a - 8 * b + 8 * c - d) / (12 * step)

    S = by_sigma0(lambda one: np.log(one.fields(theta)[0]))
    Y = by_sigma0(lambda one: one.fields(theta)[1])
    slope = by_sigma0(lambda one: -sqrt(12) * np.tan(2 * one.fields(theta)[1]))
    U = chebyshev.integrate_odd(slope * solution.hopper.half_angle)
    rates = applied(solution, n, S, Y, U, np.zeros(n))
    size = max(np.abs(f).max() for f in (S, Y, U))
    assert np.abs(rates).max() < 1e-7 * size
    # Z = 0: T_rt + mu T_tt changes by -dmu T_tt.
    at = coefficients(solution, [half_grid(n, solution.hopper.half_angle)])[0]
    s, m, c, q = at.s, at.m, at.c[-1], at.q[-1]
    mu = tan(solution.friction_angle)
    law = -s * q * S[-1] - 2 * s * c * Y[-1] + mu * ((1 + m * c) * S[-1] - 2 * m * q * Y[-1])
    change = by_sigma0(lambda one: tan(one.friction_angle))
    assert law == pytest.approx(-change * (1 + m * c), rel=1e-7)
    assert abs(change) > 1e-2


# Narrow cones with smooth walls.


def quartic(m, K):
    """The four lambda of a smooth narrow cone for one wave number."""
    return np.roots([
        1 - 2 * m,
        2 * (5 * m - 1),
        (1 + m) * K + 12 * m - 9,
        (11 * m - 1) * K - 80 * m + 10,
        K * ((1 + m) * K - 32 * m + 4),
    ])  # fmt: skip


def lpmv_of_degree(nu, x):
    return float(lpmv(1, nu, x))


@pytest.mark.parametrize("delta", [25, 30, 40, 50])
def test_smooth_narrow_cones(delta):
    m = sin(radians(delta)) / sqrt(3)
    quartics, uniform = [], []
    for half_angle in (4, 2, 1, 0.5):
        # K = nu (nu + 1), P^1_nu(cos theta_w) = 0; close to (x / theta_w)**2 with J_1(x) = 0.
        angle = radians(half_angle)
        first = jn_zeros(1, 1)[0] / angle - 0.5
        nu = brentq(lpmv_of_degree, first - 0.4, first + 0.4, args=(cos(angle),))
        found = eigenvalues(radial(delta, half_angle, 0.0), 16)
        quartics.append(partner_distances(quartic(m, nu * (nu + 1)), found))
        # The mode of K = 0.
        uniform.append(np.abs(found - (1 - 8 * m) / (1 - 2 * m)).min())
    # Errors relative to lambda are of the order theta_w**2, and theta_w**6 for K = 0.
    np.testing.assert_allclose(np.log2(quartics[2] / quartics[3]), 2, atol=0.1)
    assert quartics[3].max() < 2e-5
    assert log2(uniform[0] / uniform[1]) == pytest.approx(6, abs=0.1)


# Modes as functions.


@pytest.mark.parametrize("hopper", [(25, 10, 0.1), (40, 30, 0.2), (45, 20, 0.1), (32, 10, 0.25)])
def test_no_mode_but_the_flow_rate_carries_flux(hopper):
    solution = radial(*hopper)
    n = 24
    theta = half_grid(n, solution.hopper.half_angle).theta
    values, vectors = np.linalg.eig(mode_matrix(solution, n))
    order = np.argsort(np.abs(values))[:8]
    u = solve_velocity(solution).at(theta)
    for k in order:
        # Of the mode in t, which has the factor exp(lambda f) = u**(lambda / 4).
        U = vectors[2 * n - 1 : 3 * n - 1, k] * u ** (values[k] / 4)
        density = U * u * np.sin(theta)
        flux = abs(
            sum(
                z * chebyshev.integrate_odd(f)[-1]
                for z, f in ((1, density.real), (1j, density.imag))
            )
        )
        flux /= np.abs(density).max()
        assert (flux < 1e-8) != (k == order[0])


# Bad input.


def test_bad_input():
    solution = radial(40, 10, 0.1)
    with pytest.raises(InvalidParameterError, match="n = 3 half-grid nodes: give at least 4"):
        mode_matrix(solution, 3)
    coulomb = solve_radial(Hopper("cone", radians(40), radians(10)), 0.1)
    with pytest.raises(InvalidParameterError, match="use model = von-mises"):
        mode_matrix(coulomb, 12)


def test_no_flow_beyond_45_degrees():
    # At the wall psi = 45 deg for mu = sin(delta).
    solution = radial(40, 10, 1.01 * sin(radians(40)))
    assert solution.psi_wall > pi / 4
    with pytest.raises(SingularVelocityError, match="exceeds 45 deg at theta = 9"):
        mode_matrix(solution, 12)
