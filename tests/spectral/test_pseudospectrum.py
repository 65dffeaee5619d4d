"""Pseudospectra against dense SVD and closed forms."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq, linear_sum_assignment, minimize_scalar

from hopper import pseudospectrum, schur_form, smallest_singular_values
from hopper.errors import InvalidParameterError
from hopper.spectral import chebyshev
from hopper.spectral.pseudospectrum import eigenvalue_condition_numbers, kreiss_lower_bound
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


# sigma_min at points


@pytest.mark.parametrize("n", [1, 2, 23, 24, 25, 49, 50, 80])
@pytest.mark.parametrize("kind", ["real", "complex"])
def test_random_matrices_of_all_block_cuts_agree_with_svd(n, kind, monkeypatch):
    matrix = RANDOM.normal(size=(n, n)) if kind == "real" else complex_normal(n, n)
    z = np.sqrt(n) * complex_normal(4, 10)
    expected = dense(matrix, z)
    monkeypatch.delattr(np.linalg, "svd")  # the resort of points that do not converge
    sigma = smallest_singular_values(schur_form(matrix), z)
    assert sigma.shape == z.shape
    np.testing.assert_allclose(sigma, expected, rtol=5e-7)


@pytest.mark.parametrize("n", [64, 100])
def test_grcar_matrix_agrees_with_svd_down_to_rounding(n):
    matrix = grcar(n)
    form = schur_form(matrix)
    z = RANDOM.uniform(-1, 3, 200) + 1j * RANDOM.uniform(-4, 4, 200)
    expected = dense(matrix, z)
    assert expected.min() < 1e-7  # well inside the curve of computed eigenvalues
    error = np.abs(smallest_singular_values(form, z) - expected)
    assert np.all(error <= 5e-7 * expected + 10 * form.rounding)


def test_normal_matrix_gives_the_distance_to_the_spectrum():
    eigenvalues = complex_normal(60)
    unitary = np.linalg.qr(complex_normal(60, 60))[0]
    form = schur_form(unitary * eigenvalues @ unitary.conj().T)
    z = 2 * complex_normal(300)
    distance = np.abs(z[:, None] - eigenvalues).min(axis=1)
    np.testing.assert_allclose(smallest_singular_values(form, z), distance, rtol=5e-7)


def test_crowded_singular_values_far_from_a_normal_spectrum():
    eigenvalues = np.linspace(-1, 1, 201) + 0.5j
    z = np.array([100j, 3 + 4j, 50, -1.5])
    sigma = smallest_singular_values(schur_form(np.diag(eigenvalues)), z, tolerance=1e-12)
    distance = np.abs(z[:, None] - eigenvalues).min(axis=1)
    np.testing.assert_allclose(sigma, distance, rtol=1e-12)


@pytest.mark.parametrize("radius", [0.3, 0.6, 0.9, 0.99])
def test_jordan_block_decays_as_its_order_th_power(radius):
    n = 40
    z = radius * np.exp(1j * np.linspace(0, 6, 7))
    sigma = smallest_singular_values(schur_form(jordan(n)), z)
    # |(z - J)^-1| is at least its corner entry and at most the sum of its diagonals' norms.
    assert np.all(sigma <= radius**n * (1 + 1e-6))
    assert np.all(sigma >= (1 - radius) / (radius**-n - 1) * (1 - 1e-6))
    np.testing.assert_allclose(sigma, sigma[0], rtol=1e-6)
    np.testing.assert_allclose(sigma, dense(jordan(n), z), rtol=5e-7, atol=10 * EPS)


def test_derivative_operator_without_spectrum_converges_to_its_resolvent():
    # u' on [-1, 1] with u(1) = 0: v = (z - d/dx) u, v(-1) = 0 at a singular function makes
    # sigma = sqrt(x^2 - k^2) with x tanh(2 k) + k = 0, x = Re z < -1/2, whatever Im z.
    x = -3.0
    k = brentq(lambda k: x * np.tanh(2 * k) + k, 1e-3, -x)
    exact = np.sqrt(x**2 - k**2)
    errors = []
    for n in (32, 64, 128):
        matrix = chebyshev.differentiation_matrix(n)[:-1, :-1]
        weight = chebyshev.clenshaw_curtis_weights(n)[:-1]
        sigma = smallest_singular_values(schur_form(matrix, weight), [x, x + 5j, x - 2j])
        errors.append(sigma / exact - 1)
    assert np.abs(errors[-1]).max() < 2e-3
    # The dropped end point leaves an error of the size of its weight, n^-2.
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    assert np.all((ratios > 3.5) & (ratios < 4.6))


@pytest.mark.parametrize("kind", ["real", "complex"])
def test_near_an_eigenvalue_sigma_is_the_distance_over_the_condition_number(kind):
    matrix = RANDOM.normal(size=(30, 30)) if kind == "real" else complex_normal(30, 30)
    form = schur_form(matrix)
    eigenvalues, condition = eigenvalue_condition_numbers(form)
    z = eigenvalues + 1e-3 * np.exp(1j * np.arange(30))
    np.testing.assert_allclose(smallest_singular_values(form, z), dense(matrix, z), rtol=1e-6)
    # The next order is the distance over the separation, times the condition number.
    close = smallest_singular_values(form, eigenvalues + 1e-7)
    np.testing.assert_allclose(close * condition, 1e-7, rtol=1e-4)


@pytest.mark.parametrize(
    "matrix",
    [np.zeros((3, 3)), np.diag([1.0, 2, 3]), jordan(400), grcar(80), RANDOM.normal(size=(50, 50))],
    ids=["zero", "diagonal", "jordan", "grcar", "random"],
)
def test_at_an_eigenvalue_sigma_is_tiny_and_not_negative(matrix):
    form = schur_form(matrix)
    sigma = smallest_singular_values(form, form.eigenvalues)
    assert np.all((sigma >= 0) & (sigma <= 10 * form.rounding))


def test_at_a_well_conditioned_eigenvalue_sigma_is_of_rounding_size_not_zero():
    form = schur_form(np.diag([1.0, 2, 3]))
    np.testing.assert_allclose(smallest_singular_values(form, [1, 2, 3]), form.rounding, rtol=1e-6)


def test_overflowing_resolvent_gives_zero_beside_good_points():
    sigma = smallest_singular_values(schur_form(jordan(100)), [0.01, 3.0])  # 1e-200 and ordinary
    assert sigma[0] == 0
    assert sigma[1] == pytest.approx(float(dense(jordan(100), 3.0)), rel=5e-7)


@pytest.mark.parametrize("kind", ["real", "complex"])
def test_weight_is_a_similarity_with_its_square_root(kind):
    matrix = RANDOM.normal(size=(40, 40)) if kind == "real" else complex_normal(40, 40)
    weight = RANDOM.uniform(0.01, 10, 40)
    root = np.diag(np.sqrt(weight))
    explicit = root @ matrix @ np.linalg.inv(root)
    z = 6 * complex_normal(50)
    sigma = smallest_singular_values(schur_form(matrix, weight), z)
    np.testing.assert_allclose(sigma, dense(explicit, z), rtol=5e-7)
    unweighted = dense(matrix, z)
    assert np.abs(sigma / unweighted - 1).max() > 0.1  # the weight matters here
    # A constant weight changes nothing.
    constant = smallest_singular_values(schur_form(matrix, np.full(40, 7.0)), z)
    np.testing.assert_allclose(constant, unweighted, rtol=5e-7)


def test_inputs_are_left_alone_and_results_repeat():
    matrix, weight = RANDOM.normal(size=(20, 20)), RANDOM.uniform(1, 2, 20)
    copies = matrix.copy(), weight.copy()
    z = complex_normal(30)
    first = smallest_singular_values(schur_form(matrix, weight), z)
    np.testing.assert_array_equal(first, smallest_singular_values(schur_form(matrix, weight), z))
    np.testing.assert_array_equal(matrix, copies[0])
    np.testing.assert_array_equal(weight, copies[1])


def test_tolerance_bounds_the_error():
    matrix = RANDOM.normal(size=(60, 60))
    z = 12 * complex_normal(100)
    form, expected = schur_form(matrix), dense(matrix, z)
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        error = smallest_singular_values(form, z, tolerance) / expected - 1
        assert np.abs(error).max() <= tolerance / 2 + 1e-12


def test_progress_reports_every_batch():
    calls = []
    z = complex_normal(5000)
    matrix = RANDOM.normal(size=(4, 4))
    sigma = smallest_singular_values(
        schur_form(matrix), z, progress=lambda *call: calls.append(call)
    )
    done = [done for done, _ in calls]
    assert len(calls) > 1
    assert done == sorted(set(done))
    assert done[-1] == 5000
    assert {total for _, total in calls} == {5000}
    np.testing.assert_allclose(sigma, dense(matrix, z), rtol=5e-7)


def test_no_points_give_no_values():
    assert smallest_singular_values(schur_form(np.eye(3)), np.zeros((0, 2))).shape == (0, 2)


# Grids


def test_symmetric_grid_of_a_real_matrix_costs_half():
    matrix = grcar(30)
    real, imag = np.linspace(-1, 3, 9), np.linspace(-3.1, 3.1, 21)
    totals = set()
    grid = pseudospectrum(
        schur_form(matrix), real, imag, progress=lambda done, total: totals.add(total)
    )
    assert totals == {9 * 11}
    assert grid.sigma_min.shape == (21, 9)
    np.testing.assert_array_equal(grid.real, real)
    np.testing.assert_array_equal(grid.imag, imag)
    np.testing.assert_array_equal(grid.sigma_min, grid.sigma_min[::-1])
    np.testing.assert_allclose(grid.sigma_min, dense(matrix, real + 1j * imag[:, None]), rtol=5e-7)


@pytest.mark.parametrize("matrix", [grcar(20), grcar(20) + 0.3j * jordan(20)])
def test_partly_mirrored_grid(matrix):
    real, imag = [-1, 0, 2.5], [-2, -1, -0.25, 1, 3]
    totals = set()
    grid = pseudospectrum(
        schur_form(matrix), real, imag, progress=lambda done, total: totals.add(total)
    )
    assert totals == {12 if np.isrealobj(matrix) else 15}
    points = np.array(real) + 1j * np.array(imag)[:, None]
    np.testing.assert_allclose(grid.sigma_min, dense(matrix, points), rtol=5e-7)


# Eigenvalue condition numbers


@pytest.mark.parametrize("kind", ["real", "complex"])
def test_condition_numbers_follow_their_definition(kind):
    matrix = RANDOM.normal(size=(25, 25)) if kind == "real" else complex_normal(25, 25)
    weight = RANDOM.uniform(0.1, 10, 25)
    values, condition = eigenvalue_condition_numbers(schur_form(matrix, weight))
    expected, vectors = np.linalg.eig(
        np.sqrt(weight)[:, None] * matrix @ np.diag(1 / np.sqrt(weight))
    )
    # Rows of the inverse are the left eigenvectors with y* x = 1.
    product = np.linalg.norm(vectors, axis=0) * np.linalg.norm(np.linalg.inv(vectors), axis=1)
    row, column = linear_sum_assignment(np.abs(values[:, None] - expected))
    np.testing.assert_allclose(values[row], expected[column], atol=1e-12 * np.abs(expected).max())
    np.testing.assert_allclose(condition[row], product[column], rtol=1e-10)


def test_condition_numbers_of_known_matrices():
    _, condition = eigenvalue_condition_numbers(schur_form([[1, 8], [0, -1]]))
    np.testing.assert_allclose(condition, np.sqrt(1 + 4**2), rtol=1e-14)
    _, condition = eigenvalue_condition_numbers(schur_form(np.diag([1.0, 2, 5])))
    np.testing.assert_allclose(condition, 1, rtol=1e-14)
    _, condition = eigenvalue_condition_numbers(schur_form(jordan(2)))
    assert condition.min() > 1e7


# Kreiss


def test_kreiss_bound_of_a_defective_block():
    centre, coupling, shift = -1.0, 30.0, 0.5
    real = np.linspace(-1.7, 20, 2171)
    grid = pseudospectrum(schur_form(defective(centre, coupling)), real, [-1.0, 0, 1.0])
    for floor in (0.0, shift):
        value, z = kreiss_lower_bound(grid, floor)

        def loss(x, floor=floor):
            return -(x - floor) / defective_sigma(x - centre, coupling)

        best = minimize_scalar(loss, bounds=(floor, 20), method="bounded", options={"xatol": 1e-8})
        assert z.imag == 0
        assert z.real == pytest.approx(best.x, abs=0.02)
        assert value == pytest.approx(-best.fun, rel=1e-4)
        assert value <= -best.fun * (1 + 1e-6)


def test_kreiss_bound_is_below_the_largest_propagator_norm():
    matrix = grcar(30) - 1.8 * np.eye(30)
    assert np.linalg.eigvals(matrix).real.max() < 0
    grid = pseudospectrum(schur_form(matrix), np.linspace(0.02, 2, 60), np.linspace(-4, 4, 81))
    value, z = kreiss_lower_bound(grid)
    assert value == pytest.approx(z.real / dense(matrix, z), rel=1e-6)
    largest = max(np.linalg.norm(expm(t * matrix), 2) for t in np.linspace(0, 20, 201))
    assert 1 < value <= largest
    assert largest <= np.e * 30 * value  # the other half of Kreiss's theorem


# Bad input


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.ones((2, 3)),), r"^matrix has shape \(2, 3\): it must be square$"),
        ((np.ones(3),), r"^matrix has shape \(3,\): it must be square$"),
        ((np.ones((0, 0)),), r"^matrix has shape \(0, 0\): it must be square$"),
        (([[1, np.nan], [0, 1]],), "^matrix must be finite: remove NaN and inf$"),
        (([[1, np.inf * 1j], [0, 1]],), "^matrix must be finite: remove NaN and inf$"),
        ((np.eye(2), [1, 2, 3]), r"^weight has shape \(3,\): it must be \(2,\)$"),
        ((np.eye(2), np.eye(2)), r"^weight has shape \(2, 2\): it must be \(2,\)$"),
        ((np.eye(2), [1, 0]), "^weight must be positive and finite everywhere$"),
        ((np.eye(2), [1, np.nan]), "^weight must be finite: remove NaN and inf$"),
    ],
)
def test_bad_matrices_and_weights_are_refused(arguments, message):
    with pytest.raises(InvalidParameterError, match=message):
        schur_form(*arguments)


def test_bad_points_and_tolerances_are_refused():
    form = schur_form(np.eye(2))
    with pytest.raises(InvalidParameterError, match=r"^z must be finite: remove NaN and inf$"):
        smallest_singular_values(form, [0, np.nan])
    for tolerance in (0, 1, np.nan):
        with pytest.raises(InvalidParameterError, match=r"^tolerance = .* use 0 < value < 1$"):
            smallest_singular_values(form, [0], tolerance)


@pytest.mark.parametrize(
    ("axis", "message"),
    [
        ([1], r"has shape \(1,\): give at least two values$"),
        ([], r"has shape \(0,\): give at least two values$"),
        ([[0, 1]], r"has shape \(1, 2\): give at least two values$"),
        ([0, np.inf], "must be finite: remove NaN and inf$"),
        ([1, 0], "must increase: sort it, without repeated values$"),
        ([0, 0, 1], "must increase: sort it, without repeated values$"),
    ],
)
def test_bad_axes_are_refused_by_name(axis, message):
    form = schur_form(np.eye(2))
    with pytest.raises(InvalidParameterError, match=f"^real {message}"):
        pseudospectrum(form, axis, [0, 1])
    with pytest.raises(InvalidParameterError, match=f"^imag {message}"):
        pseudospectrum(form, [0, 1], axis)


def test_kreiss_needs_a_grid_beyond_the_shift():
    grid = pseudospectrum(schur_form(-np.eye(2)), [-2, -0.5], [0, 1])
    with pytest.raises(
        InvalidParameterError, match=r"^real ends at -0\.5: extend the grid beyond shift = 0$"
    ):
        kreiss_lower_bound(grid)
