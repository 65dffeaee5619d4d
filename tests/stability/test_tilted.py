"""The package's coefficients in tilted time and their collocation, against derived ones."""

from math import cos, pi, radians

import numpy as np
import pytest
from scipy.integrate import quad

from hopper import Hopper, solve_radial
from hopper.errors import InvalidParameterError
from hopper.radial.grid import disc_weights, half_grid
from hopper.spectral import chebyshev
from hopper.stability.collocation import mode_grid, parities_of, require_disturbance, tilted_matrix
from hopper.stability.paper_frame import coefficients
from hopper.stability.paper_matrix import half_matrix
from hopper.stability.tilted import (
    first_tangency,
    on_grids,
    tangency_angle,
    tilt,
    tilted_coefficients,
    wave_matrices,
)
from hopper.yield_conditions import VON_MISES
from tests.stability import tilted_chebyshev
from tests.stability.tilted_data import name, read
from tests.stability.tilted_data import radial as of_case
from tests.stability.witnesses import partner_distances, radial, wall_tangency_friction

# Before the tangency and beyond it, a thin layer at the axis among them.
CASES = read("tilted_reference")[::3]
EVERY = pytest.mark.parametrize("case", CASES, ids=name)


def size_of(matrices):
    return np.abs(matrices).max(axis=(1, 2), keepdims=True)


def angles(solution, count=40):
    """Off the axis, near which 1 - cos 2psi times cot(theta) loses digits."""
    return np.random.default_rng(1).uniform(0.2, 1, count) * solution.hopper.half_angle


@EVERY
def test_matrices_are_those_of_the_derivation(case):
    solution = of_case(case)
    theta = angles(solution)
    for found, derived in zip(
        wave_matrices(solution, theta), tilted_chebyshev.coefficients(solution, theta), strict=True
    ):
        difference = found - np.moveaxis(derived, 2, 0)
        # Slopes of the radial solution by the grid here, by the equations of motion there.
        assert np.all(
            np.abs(difference) <= size_of(found) * (1e-12 + 1e3 * solution.error_estimate)
        )


@EVERY
def test_the_paper_s_matrices_follow(case):
    """A = N^-1 and F = B + (d - 2) C = N^-1 K where q != 0: entry by entry to 1e-12."""
    solution = of_case(case)
    theta = angles(solution)
    n, k = wave_matrices(solution, theta)
    at = coefficients(solution, theta)
    away = np.abs(at.q) > 0.05
    assert away.sum() > 20
    a = np.array([[at.a11, at.a12], [at.a21, at.a11]])
    f = np.array([[at.f11, at.f12], [at.f21, at.f22]])
    for found, expected in ((a, np.linalg.inv(n)), (f, np.linalg.solve(n, k))):
        found = np.moveaxis(found, 2, 0)
        assert np.all(np.abs(found - expected)[away] <= 1e-12 * size_of(expected)[away])


@EVERY
def test_tilted_time_removes_the_diagonal(case):
    solution = of_case(case)
    theta = angles(solution)
    n, k = wave_matrices(solution, theta)
    at = tilted_coefficients(solution, theta)
    s = solution.hopper.s
    slope = np.sin(2 * at.psi) / (s + np.cos(2 * at.psi))
    j = np.zeros((theta.size, 2, 2))
    j[:, 0, 1], j[:, 1, 0] = at.j12, at.j21
    tilted = n + slope[:, None, None] * np.eye(2)
    np.testing.assert_allclose(j @ tilted, np.broadcast_to(np.eye(2), j.shape), atol=1e-12)
    f = np.moveaxis(np.array([[at.f11, at.f12], [at.f21, at.f22]]), 2, 0)
    assert np.all(np.abs(j @ k - f) <= 1e-12 * size_of(f))
    np.testing.assert_allclose(np.sqrt(at.j12 * at.j21), at.w / cos(solution.hopper.delta))


@EVERY
def test_moving_the_apex_is_a_solution_with_lambda_one(case):
    """Upwards in all hoppers, sideways in wedges, to 1e-9; slopes on the package's own grids."""
    solution = of_case(case)
    for parity in parities_of(solution.hopper.geometry):
        grid = mode_grid(solution, 120, parity)
        first = int(grid.centred)
        sigma, _, d_sigma, d_psi = solution.fields(grid.theta)
        if parity == "symmetric":
            u = np.array([grid.cos * sigma - grid.sin * d_sigma, -grid.sin * (1 + d_psi)])
            slopes = np.array([grid.d_even @ u[0], grid.d_odd @ u[1]])
        else:
            u = np.array([grid.sin * sigma + grid.cos * d_sigma, grid.cos * (1 + d_psi)])
            slopes = np.array([grid.d_odd @ u[0], grid.d_even @ u[1]])
        n, k = wave_matrices(solution, grid.theta[first:])
        right = np.einsum("nij,jn->in", n - k, u[:, first:])
        assert np.abs(slopes[:, first:] - right).max() < 1e-9 * np.abs(slopes).max()
        # And so with the coefficients on the grid: U' = exp(h) U in tilted time.
        (at,) = on_grids(solution, [grid])
        slopes = slopes + np.sin(2 * at.psi) / at.w * u
        left = np.array(
            [
                at.j12 * slopes[1] + at.f11 * u[0] + at.f12 * u[1],
                at.j21 * slopes[0] + at.f21 * u[0] + at.f22 * u[1],
            ]
        )
        scale = np.abs(np.array([at.j12 * slopes[1], at.j21 * slopes[0]])).max()
        assert np.abs(left - u)[:, first:].max() < 1e-9 * scale


def test_coefficients_are_even_or_odd():
    solution = radial("cone", 38, 17, 0.12)
    theta = np.linspace(0.1, 1, 7) * solution.hopper.half_angle
    right, left = tilted_coefficients(solution, theta), tilted_coefficients(solution, -theta)
    for key, value in vars(right).items():
        sign = -1 if key in ("psi", "f12", "f21") else 1
        np.testing.assert_allclose(getattr(left, key), sign * value, rtol=1e-12)


@EVERY
def test_tilt_by_adaptive_quadrature(case):
    solution = of_case(case)
    s = solution.hopper.s

    def slope(theta):
        psi = float(solution.psi_at(theta)[0])
        return np.sin(2 * psi) / (s + np.cos(2 * psi))

    theta, h = tilt(solution, 64)
    assert theta[-1] == solution.hopper.half_angle
    assert np.all(np.diff(h) > 0)
    for i in (20, 63):
        expected = quad(slope, 0, theta[i], epsabs=1e-13, epsrel=1e-12, limit=200)[0]
        assert h[i] == pytest.approx(expected, abs=1e-9)


# The tangency, where t is no time.


@pytest.mark.parametrize(("delta", "mu"), [(25, 0.325), (30, 0.346), (35, 0.354), (45, 0.333)])
@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_tangency_at_the_wall(geometry, delta, mu):
    hopper = Hopper(geometry, radians(delta), radians(10))
    tangency = wall_tangency_friction(hopper.delta)
    assert np.tan(tangency) == pytest.approx(mu, abs=5e-4)
    assert tangency_angle(hopper.delta) == pytest.approx(pi / 4 - hopper.delta / 2)
    assert first_tangency(solve_radial(hopper, tangency * (1 - 1e-6))) is None
    beyond = solve_radial(hopper, tangency * (1 + 1e-6))
    found = first_tangency(beyond)
    assert found is not None
    assert found == pytest.approx(hopper.half_angle, rel=1e-5)
    assert beyond.psi_at(found)[0] == pytest.approx(tangency_angle(hopper.delta), abs=1e-12)
    # There the paper's frame is singular, and this one is not.
    assert abs(coefficients(beyond, [found]).q[0]) < 1e-11
    assert tilted_coefficients(beyond, found).w[0] > 0.5


@pytest.mark.parametrize("mu", [0.32, 0.3112, 0.31097])
def test_tangency_inside(mu):
    # delta = 25 deg, half angle 30 deg: max psi passes 32.5 deg at mu = 0.3109606.
    solution = radial("cone", 25, 30, mu)
    found = first_tangency(solution)
    assert found is not None
    assert found < radians(29)
    assert solution.psi_at(found)[0] == pytest.approx(radians(32.5), abs=1e-12)


# Collocation.


@pytest.mark.parametrize("hopper", [("wedge", 38, 17, 0.12), ("cone", 38, 17, 0.12)])
def test_eigenvalues_are_those_of_the_paper_s_frame(hopper):
    solution = radial(*hopper)
    for parity, half in (("symmetric", "physical"), ("asymmetric", "mirrored")):
        if parity == "asymmetric" and hopper[0] == "cone":
            continue
        tilted = np.linalg.eigvals(tilted_matrix(solution, 40, parity))  # type: ignore[arg-type]
        paper = np.linalg.eigvals(half_matrix(solution, 40, half))  # type: ignore[arg-type]
        low = tilted[np.argsort(np.abs(tilted))][:11]
        assert partner_distances(low, paper).max() < 1e-9


@pytest.mark.parametrize(
    ("case", "clustered"), [(CASES[0], False), (CASES[-1], True)], ids=["plain", "layer"]
)
def test_sizes_and_grids(case, clustered):
    solution = of_case(case)
    assert tilted_matrix(solution, 12).shape == (23, 23)
    grid = mode_grid(solution, 12, "symmetric")
    assert (grid.map.clustering > 0) == clustered
    assert not grid.centred
    if not clustered:
        assert tilted_matrix(solution, 12, "asymmetric").shape == (22, 22)
        assert mode_grid(solution, 12, "asymmetric").theta[0] == 0


@pytest.mark.parametrize("clustering", [0.0, 1.5, 4.0])
@pytest.mark.parametrize("size", [12, 36])
def test_disc_weights(size, clustering):
    """Integrals with the weight sin(theta) of even functions that the grid resolves."""
    angle = radians(30)
    grid = half_grid(size, angle, clustering)
    weights = disc_weights(grid)
    assert np.all(weights > 0)
    x = chebyshev.half_nodes(size)
    scale = angle / np.sinh(clustering) if clustering else angle

    def function(theta):
        y = np.arcsinh(theta / scale) / clustering if clustering else theta / scale
        return 1 + y**4 - y**6

    np.testing.assert_allclose(function(grid.theta), 1 + x**4 - x**6, rtol=1e-12)
    integral = quad(lambda t: function(t) * np.sin(t), 0, angle, epsabs=1e-15, epsrel=1e-13)[0]
    assert weights @ function(grid.theta) == pytest.approx(integral, rel=1e-12)


# Refusals.


def test_refusals():
    cone, wedge = radial("cone", 35, 10), radial("wedge", 35, 10)
    with pytest.raises(InvalidParameterError, match="axis of a cone: use other angles"):
        tilted_coefficients(cone, [0.1, 0.0])
    assert np.isfinite(tilted_coefficients(wedge, 0.0).f12).all()
    with pytest.raises(InvalidParameterError, match="outside the hopper"):
        tilted_coefficients(cone, 0.2)
    for m in (2, 0, -1):
        with pytest.raises(InvalidParameterError, match="half-grid points: give at least 3"):
            tilted_matrix(wedge, m)
    with pytest.raises(
        InvalidParameterError, match="singular at the apex of a cone: use symmetric"
    ):
        tilted_matrix(cone, 12, "asymmetric")
    with pytest.raises(InvalidParameterError, match="parity = 'odd' is unknown: use symmetric or"):
        require_disturbance("wedge", "odd")
    soft = solve_radial(Hopper("cone", radians(30), radians(10), VON_MISES), 0.1)
    for call in (tilted_matrix, tilt):
        with pytest.raises(InvalidParameterError, match="use mohr-coulomb"):
            call(soft, 12)
