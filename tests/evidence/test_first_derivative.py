"""d/dx with a boundary condition has no eigenvalues; a second order operator has."""

from itertools import pairwise

import numpy as np
import pytest

from hopper import schur_form
from hopper.evidence.first_derivative import (
    agreeing_eigenvalues,
    digits_lost,
    first_derivative_matrix,
    largest_condition,
)
from hopper.spectral import chebyshev
from hopper.spectral.pseudospectrum import eigenvalue_condition_numbers

EPS = np.finfo(float).eps


def test_the_matrix_differentiates():
    n = 12
    x = chebyshev.nodes(n)
    values = (1 - x) * np.exp(x)
    slope = first_derivative_matrix(n) @ values[:-1]
    np.testing.assert_allclose(slope, (-x * np.exp(x))[:-1], atol=1e-8)


@pytest.mark.parametrize("n", [8, 14])
def test_condition_is_the_worst_shift_of_an_eigenvalue(n):
    matrix = first_derivative_matrix(n)
    values, vectors = np.linalg.eig(matrix)
    inverse = np.linalg.inv(vectors)
    conditions = np.linalg.norm(vectors, axis=0) * np.linalg.norm(inverse, axis=1)
    found = largest_condition(n)
    assert found == pytest.approx(conditions.max(), rel=1e-6)
    # A perturbation of size h along left and right eigenvector shifts it by found * h.
    worst = int(np.argmax(conditions))
    left = inverse[worst].conj() / np.linalg.norm(inverse[worst])
    size = 1e-3 / found
    shifted = np.linalg.eigvals(matrix + size * np.outer(left, vectors[:, worst].conj()))
    assert np.abs(shifted - values[worst]).min() == pytest.approx(found * size, rel=0.05)


def test_condition_grows_until_rounding():
    conditions = [largest_condition(n) for n in (8, 16, 24, 32)]
    assert all(after > 50 * before for before, after in pairwise(conditions))
    assert largest_condition(100) > 1e12


@pytest.mark.parametrize("n", [200, 400])
def test_many_digits_are_lost_whatever_the_rounding(n):
    """Where the condition number itself is rounding, its magnitude is not."""
    matrix = first_derivative_matrix(n)
    rng = np.random.default_rng(4)
    found = [digits_lost(n)]
    for _ in range(4):
        rounded = matrix * (1 + EPS * rng.uniform(-1, 1, matrix.shape))
        found.append(np.log10(eigenvalue_condition_numbers(schur_form(rounded))[1].max()))
    assert min(found) > 12
    assert np.ptp(found) < 4


def test_few_agree_where_most_of_a_second_order_operator_are_right():
    n = 100
    assert agreeing_eigenvalues(n, n // 2, 1e-3) < 0.05 * n
    second = np.linalg.matrix_power(chebyshev.differentiation_matrix(n), 2)[1:-1, 1:-1]
    values = np.sort(-np.linalg.eigvals(second).real)
    exact = (np.pi / 2 * np.arange(1, n - 1)) ** 2
    # pi points a wavelength: 2 / pi of them.
    assert np.sum(np.abs(values / exact - 1) < 1e-2) == pytest.approx(2 / np.pi * n, rel=0.05)
