"""Sensitivity of kept modes by definition: perturbations, brute force, dense algebra."""

from functools import lru_cache

import numpy as np
import pytest
from scipy.linalg import block_diag, eig

from hopper import schur_form
from hopper.spectral.sensitivity import kept_condition_numbers, kept_sensitivity
from hopper.spectral.transient import condition_number, modal_matrix, propagator_norm
from hopper.stability.paper_matrix import half_matrix
from hopper.stability.transient import half_weights
from tests.stability.kept_modes import (
    EPS,
    eigenvectors,
    kept_bases,
    kept_eigenvalues,
    matrix_norm,
    restricted,
)
from tests.stability.witnesses import radial

GEOMETRIES = ("wedge", "cone")
N = 64


@lru_cache(maxsize=4)
def bases(geometry):
    """Some twenty modes on a small mesh, of both parities for the wedge."""
    if geometry == "wedge":
        return kept_bases(geometry, "low", N, "discrete", 2.0)
    return kept_bases(geometry, "physical", N, "L2", 1.0)


@lru_cache(maxsize=4)
def operator(geometry):
    return block_diag(*[modal_matrix(basis) for basis in bases(geometry)])


@lru_cache(maxsize=4)
def sensitivity(geometry):
    return kept_sensitivity(bases(geometry))


def sigma_min(matrix, z):
    """Smallest singular values of z - M, by dense SVD."""
    shifted = np.atleast_1d(z)[:, None, None] * np.eye(len(matrix)) - matrix
    return np.linalg.svd(shifted, compute_uv=False)[:, -1]


def random_perturbation(random, n):
    """A complex matrix of 2-norm 1: full, or of rank one."""
    matrix = random.normal(size=(n, n, 2)).view(complex)[..., 0]
    if random.random() < 0.5:
        matrix = np.outer(matrix[0], matrix[1])
    return matrix / np.linalg.norm(matrix, 2)


# Condition numbers of eigenvalues.


@lru_cache(maxsize=4)
def weighted_matrix(geometry):
    root = np.sqrt(half_weights(radial(geometry, 35, 10).hopper, N // 2, "L2"))
    return root[:, None] * half_matrix(radial(geometry, 35, 10), N // 2) / root


def conditions(geometry):
    solution = radial(geometry, 35, 10)
    form = schur_form(half_matrix(solution, N // 2), half_weights(solution.hopper, N // 2, "L2"))
    kept = kept_eigenvalues(geometry, "physical", N)["physical"]
    return kept, kept_condition_numbers(form, kept)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_condition_numbers_by_definition(geometry):
    # Rows of V^-1 are the left eigenvectors with y* x = 1.
    values, vectors = eig(weighted_matrix(geometry))
    expected = np.linalg.norm(vectors, axis=0) * np.linalg.norm(np.linalg.inv(vectors), axis=1)
    kept, found = conditions(geometry)
    assert np.all(found >= 1)
    index = np.abs(kept[:, None] - values).argmin(axis=1)
    np.testing.assert_allclose(found, expected[index], rtol=EPS * np.linalg.cond(vectors) * 100)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_condition_numbers_bound_the_shift_and_are_attained(geometry):
    matrix, size = weighted_matrix(geometry), 1e-7
    kept, found = conditions(geometry)
    random = np.random.default_rng(5)
    # Second order in the perturbation, by the distance to the neighbours; and rounding.
    gap = np.abs(kept[:, None] - kept + 1e9 * np.eye(kept.size)).min()
    slack = len(matrix) * found * size * found.max() / gap
    slack += 4 * EPS * np.linalg.norm(matrix) * found / size
    assert slack.max() < 0.02 * found.min()

    def shifts(perturbation):
        values = np.linalg.eigvals(matrix + size * perturbation)
        return np.abs(kept[:, None] - values).min(axis=1) / size

    for _ in range(10):
        shift = shifts(random_perturbation(random, len(matrix)))
        assert np.all(shift <= found + slack)
    for i, value in enumerate(kept[kept.imag >= 0]):
        # Left and right null vectors: the worst perturbation is their outer product.
        u, _, vh = np.linalg.svd(value * np.eye(len(matrix)) - matrix)
        j = int(np.argmin(np.abs(kept - value)))
        attained = shifts(np.outer(u[:, -1], vh[-1]))[j]
        assert abs(attained - found[j]) <= slack[j], i


def test_condition_numbers_of_strangers():
    solution = radial(geometry, 35, 10)
    form = schur_form(half_matrix(solution, N // 2), half_weights(solution.hopper, N // 2, "L2"))
    kept = kept_eigenvalues(geometry, mode, 400)
    found_bases = kept_bases(geometry, mode, 400, norm, psi_scale)
    found = kept_sensitivity(found_bases)
    measured = condition_number(found_bases), found.distance, found.kreiss
    # Half a unit of the last digit.
    np.testing.assert_allclose(measured, [kappa, distance, kreiss_bound], rtol=5e-5)

    # Again, from eigenvectors of the whole matrix. Rounding of it, through kappa.
    rounding = 10 * EPS * matrix_norm(geometry, 400)
    every = np.concatenate(list(kept.values()))
    _, vectors = eigenvectors(geometry, 400, every, norm, psi_scale)
    assert abs(measured[0] / np.linalg.cond(vectors) - 1) < rounding * kappa
    halves = [
        restricted(*eigenvectors(geometry, 400, values, norm, psi_scale))
        for values in kept.values()
    ]
    assert min(sigma_min(half, 1j * found.frequency)[0] for half in halves) == pytest.approx(
        found.distance, abs=rounding * kappa
    )
    # A singular value of i y - M is d where the Hamiltonian matrix has the eigenvalue i y: none
    # below the distance, one above.
    for factor, crosses in ((1 - 1e-3, False), (1 + 1e-3, True)):
        level = factor * found.distance
        assert any(has_imaginary_eigenvalue(half, level) for half in halves) == crosses
    alpha = max(values.real.max() for values in kept.values())
    times = np.linspace(0, 5, 126)
    assert found.kreiss <= (propagator_norm(found_bases, times) * np.exp(-alpha * times)).max()
    best = max(kreiss(half, alpha, (0.02, 1, 20, 600), low_and_high(half)) for half in halves)
    assert found.kreiss == pytest.approx(best, rel=0.03)


def has_imaginary_eigenvalue(matrix, level):
    identity = level * np.eye(len(matrix))
    values = np.linalg.eigvals(np.block([[matrix, identity], [-identity, -matrix.conj().T]]))
    return bool(np.abs(values.real).min() < 1e-4 * level)


def low_and_high(matrix):
    """Im of the three lowest modes and of a high one."""
    heights = np.linalg.eigvals(matrix).imag
    return np.sort(heights[heights >= 0])[[0, 1, 2, -4]]
