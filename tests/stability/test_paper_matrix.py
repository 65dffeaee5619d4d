"""The paper's matrix: its action, its split by parity, its refusals."""

import numpy as np
import pytest
from scipy.linalg import eigvals

from hopper.errors import InvalidParameterError
from hopper.spectral import chebyshev
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.paper_matrix import half_matrix, paper_matrix
from tests.stability.witnesses import derived_coefficients, partner_distances, radial

HOPPERS = [("wedge", 35, 10, 0.0), ("cone", 35, 10, 0.0), ("cone", 38, 17, 0.12)]


def exact_action(solution, theta, sigma, dsigma, psi, dpsi):
    """Rows of A U' + F U at ``theta`` for U = (sigma, psi)."""
    a, f = derived_coefficients(solution, theta)
    derivative, value = np.array([dsigma, dpsi]), np.array([sigma, psi])
    return np.einsum("nij,jn->in", a, derivative) + np.einsum("nij,jn->in", f, value)


@pytest.mark.parametrize(("n", "size"), [(200, 398), (400, 798)])
def test_sizes_of_the_paper(n, size):
    solution = radial("wedge", 35, 10)
    assert paper_matrix(solution, n).shape == (size, size)
    assert half_matrix(solution, n // 2).shape == (size // 2, size // 2)


@pytest.mark.parametrize("hopper", HOPPERS)
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_paper_matrix_on_a_smooth_function(hopper, scale):
    solution = radial(*hopper)
    wall = solution.hopper.half_angle
    n = 40
    theta = wall * chebyshev.nodes(n)
    # Neither even nor odd; psi1 vanishes at the walls.
    sigma, dsigma = np.exp(3 * theta), 3 * np.exp(3 * theta)
    angle = np.pi * (theta + wall) / (2 * wall)
    psi, dpsi = np.sin(angle), np.pi / (2 * wall) * np.cos(angle)
    expected = exact_action(solution, theta, sigma, dsigma, psi, dpsi)
    expected = np.concatenate([expected[0], expected[1, 1:-1] / scale])
    action = paper_matrix(solution, n, scale) @ np.concatenate([sigma, psi[1:-1] / scale])
    np.testing.assert_allclose(action, expected, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("hopper", HOPPERS)
@pytest.mark.parametrize("half", ["physical", "mirrored"])
def test_half_matrix_on_a_smooth_function(hopper, half):
    solution = radial(*hopper)
    wall = solution.hopper.half_angle
    m = 20
    theta = wall * chebyshev.half_nodes(m)
    if half == "physical":
        rate = np.pi / wall
        sigma, dsigma = np.cosh(3 * theta), 3 * np.sinh(3 * theta)
        psi, dpsi = np.sin(rate * theta), rate * np.cos(rate * theta)
    else:
        rate = np.pi / (2 * wall)
        sigma, dsigma = np.sinh(3 * theta), 3 * np.cosh(3 * theta)
        psi, dpsi = np.cos(rate * theta), -rate * np.sin(rate * theta)
    expected = np.concatenate(exact_action(solution, theta, sigma, dsigma, psi, dpsi))[:-1]
    action = half_matrix(solution, m, half) @ np.concatenate([sigma, psi[:-1]])
    np.testing.assert_allclose(action, expected, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("hopper", HOPPERS)
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_parity_splits_the_paper_matrix(hopper, scale):
    solution = radial(*hopper)
    n = 60
    full = paper_matrix(solution, n, scale)
    bases, blocks = [], []
    for half, sign in zip(HALVES, (1, -1), strict=True):
        sigma = np.vstack([sign * np.eye(n // 2)[::-1], np.eye(n // 2)])
        psi = np.vstack([-sign * np.eye(n // 2 - 1)[::-1], np.eye(n // 2 - 1)])
        block = half_matrix(solution, n // 2, half, scale)
        basis = np.zeros((2 * n - 2, n - 1))
        basis[:n, : n // 2], basis[n:, n // 2 :] = sigma, psi
        bases.append(basis)
        blocks.append(block)
        assert np.abs(full @ basis - basis @ block).max() < 1e-14 * np.abs(full).max()
    assert np.linalg.matrix_rank(np.hstack(bases)) == 2 * n - 2


@pytest.mark.parametrize("hopper", HOPPERS)
def test_psi_scale_is_a_similarity(hopper):
    solution = radial(*hopper)
    plain, scaled = (half_matrix(solution, 24, psi_scale=scale) for scale in (1.0, 1.7))
    assert np.abs(plain - scaled).max() > 0.1
    change = np.concatenate([np.ones(24), np.full(23, 1.7)])
    np.testing.assert_allclose(scaled, plain * change / change[:, None], rtol=1e-13)
    assert partner_distances(eigvals(plain), eigvals(scaled)).max() < 1e-10


@pytest.mark.parametrize("n", [401, 5, 2, 0, -4])
def test_bad_numbers_of_nodes(n):
    with pytest.raises(InvalidParameterError, match=r"nodes: give an even integer of at least 4"):
        paper_matrix(radial("wedge", 35, 10), n)


@pytest.mark.parametrize("n", [400.0, "400"])
def test_what_is_no_number_of_nodes(n):
    with pytest.raises(InvalidParameterError, match=r"^n = .* is not a whole number: give one"):
        paper_matrix(radial("wedge", 35, 10), n)


def test_half_grids_need_two_nodes():
    assert half_matrix(radial("wedge", 35, 10), 2).shape == (3, 3)
    with pytest.raises(InvalidParameterError, match="m = 1 half-grid nodes: give at least 2"):
        half_matrix(radial("wedge", 35, 10), 1)
