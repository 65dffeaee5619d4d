"""Searches for abscissa, radius and distance against closed forms and dense searches."""

from functools import partial

import numpy as np
import pytest
from scipy.linalg import block_diag
from scipy.optimize import brentq, minimize_scalar

from hopper import (
    distance_to_instability,
    pseudospectral_abscissa,
    pseudospectral_radius,
    schur_form,
)
from hopper.errors import InvalidParameterError
from tests.spectral.matrices import (
    RANDOM,
    complex_normal,
    defective,
    defective_sigma,
    dense,
    grcar,
    jordan,
)

EPS = np.finfo(float).eps


def least_on(matrix, curve):
    """Least sigma_min on the curve over [-1, 1]: every minimum of a dense scan, polished."""
    scan = np.linspace(-1, 1, 2001)
    sigma = dense(matrix, curve(scan))
    lowest = 1 + np.flatnonzero((sigma[1:-1] <= sigma[:-2]) & (sigma[1:-1] <= sigma[2:]))
    polished = [
        minimize_scalar(
            lambda t: float(dense(matrix, curve(t))),
            bounds=(scan[i - 1], scan[i + 1]),
            method="bounded",
            options={"xatol": 1e-10},
        ).fun
        for i in lowest
    ]
    return min([*polished, *sigma])


@pytest.mark.parametrize("epsilon", [1e-6, 1e-2, 1.0])
def test_normal_matrix_grows_by_epsilon(epsilon):
    form = schur_form(np.diag([1.0, -2 + 0.5j, -1 + 1j, 0.5 - 4j]))
    value, z = pseudospectral_abscissa(form, epsilon)
    assert value == pytest.approx(1 + epsilon, rel=1e-12)
    assert z == pytest.approx(1 + epsilon, rel=1e-12)
    value, z = pseudospectral_radius(form, epsilon)
    assert value == pytest.approx(abs(0.5 - 4j) + epsilon, rel=1e-12)
    assert abs(z) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize("epsilon", [1e-8, 1e-2])
def test_jordan_block_fills_a_disc(epsilon):
    matrix = jordan(20)
    radius = brentq(lambda r: dense(matrix, r) - epsilon, 0, 2, xtol=1e-15)
    for search in (pseudospectral_abscissa, pseudospectral_radius):
        value, z = search(schur_form(matrix), epsilon)
        assert value == pytest.approx(radius, rel=1e-10)
        assert dense(matrix, z) == pytest.approx(epsilon, rel=1e-6)


def test_zero_matrix_has_a_disc_of_radius_epsilon():
    for search in (pseudospectral_abscissa, pseudospectral_radius):
        assert search(schur_form(np.zeros((3, 3))), 0.25)[0] == pytest.approx(0.25, rel=1e-12)


def test_searches_leave_the_extreme_eigenvalue_for_a_sensitive_one():
    epsilon, coupling = 0.1, 10.0
    disc = np.sqrt(epsilon**2 + coupling * epsilon)
    unitary = np.linalg.qr(complex_normal(3, 3))[0]
    rightmost = unitary @ block_diag([0.0], defective(-0.5 + 3j, coupling)) @ unitary.conj().T
    value, z = pseudospectral_abscissa(schur_form(rightmost), epsilon)
    assert value == pytest.approx(-0.5 + disc, rel=1e-9)
    assert z.imag == pytest.approx(3, abs=1e-4)  # a maximum: flat in Im z
    largest = unitary @ block_diag([2.0], defective(-1.5, coupling)) @ unitary.conj().T
    value, z = pseudospectral_radius(schur_form(largest), epsilon)
    assert value == pytest.approx(1.5 + disc, rel=1e-9)
    assert z == pytest.approx(-1.5 - disc, abs=1e-4)


@pytest.mark.parametrize(
    "matrix",
    [grcar(16), RANDOM.normal(size=(16, 16)), complex_normal(16, 16), complex_normal(16, 16) + 5],
    ids=["grcar", "real", "complex", "shifted"],
)
@pytest.mark.parametrize("epsilon", [1e-3, 0.3])
def test_nothing_lies_beyond_abscissa_and_radius(matrix, epsilon):
    form = schur_form(matrix)
    bound = np.linalg.norm(matrix, 2) + epsilon

    def abscissa_line(value, t):
        return value + 1j * bound * t

    def circle(value, t):
        return value * np.exp(1j * np.pi * t)

    for search, size, curve in (
        (pseudospectral_abscissa, np.real, abscissa_line),
        (pseudospectral_radius, np.abs, circle),
    ):
        value, z = search(form, epsilon)
        assert value == pytest.approx(size(z), rel=1e-14)
        assert dense(matrix, z) == pytest.approx(epsilon, rel=1e-6)
        assert least_on(matrix, partial(curve, value)) >= epsilon * (1 - 1e-9)


def test_distance_to_instability_of_known_matrices():
    sigma = defective_sigma(1.0, 10.0)
    unitary = np.linalg.qr(complex_normal(3, 3))[0]
    matrix = unitary @ block_diag([-0.3], defective(-1 + 3j, 10.0)) @ unitary.conj().T
    value, y = distance_to_instability(schur_form(matrix))
    assert value == pytest.approx(sigma, rel=1e-9)
    assert y == pytest.approx(3, abs=1e-3)
    # Unstable: the distance is that of the spectrum to the axis, from either side.
    value, y = distance_to_instability(schur_form(np.diag([1.0, -2, 0.5 + 3j])))
    assert value == pytest.approx(0.5, rel=1e-9)
    assert y == pytest.approx(3, abs=1e-4)


@pytest.mark.parametrize("kind", ["real", "complex"])
@pytest.mark.parametrize("shift", [0.0, 6.0])
def test_distance_to_instability_is_the_minimum_of_a_dense_search(kind, shift):
    matrix = RANDOM.normal(size=(20, 20)) if kind == "real" else complex_normal(20, 20)
    matrix = matrix - shift * np.eye(20)
    value, y = distance_to_instability(schur_form(matrix))
    assert value == pytest.approx(float(dense(matrix, 1j * y)), rel=1e-9)
    assert value == pytest.approx(least_on(matrix, lambda t: 12j * t), rel=1e-8)


def test_distance_to_instability_with_an_eigenvalue_on_the_axis():
    form = schur_form(block_diag(defective(-1, 3), [[0, 2], [-2, 0]]))
    value, y = distance_to_instability(form)
    assert 0 <= value <= 10 * form.rounding
    assert abs(y) == pytest.approx(2, rel=1e-14)


def test_distance_and_abscissa_are_inverse_to_each_other():
    form = schur_form(grcar(40) - 4 * np.eye(40))
    distance, _ = distance_to_instability(form)
    assert pseudospectral_abscissa(form, distance)[0] == pytest.approx(0, abs=1e-8)


@pytest.mark.parametrize("search", [pseudospectral_abscissa, pseudospectral_radius])
@pytest.mark.parametrize("epsilon", [0, -1, 1e-17, np.nan, np.inf])
def test_bad_epsilon_is_refused(search, epsilon):
    with pytest.raises(
        InvalidParameterError, match=r"^epsilon = .* must be finite and exceed rounding, 3\.1e-16$"
    ):
        search(schur_form(np.eye(2)), epsilon)
