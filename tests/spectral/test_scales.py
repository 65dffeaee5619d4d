"""Matrices of any scale: powers of two change exponents only, and nothing is wrong without a word.

Values come from the closed form of 2 x 2 matrices in 60 digits, or from the same matrix at scale 1.
"""

from collections.abc import Callable
from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

from hopper import (
    distance_to_instability,
    pseudospectral_abscissa,
    pseudospectral_radius,
    pseudospectrum,
    schur_form,
    smallest_singular_values,
)
from hopper.errors import InvalidParameterError
from hopper.spectral.pseudospectrum import eigenvalue_condition_numbers, kreiss_lower_bound
from hopper.spectral.sensitivity import (
    kept_condition_numbers,
    kept_form,
    kept_sensitivity,
    resolvent_norm,
)
from hopper.spectral.transient import (
    abscissa,
    basis_of,
    condition_number,
    modal_matrix,
    oscillation,
    propagator_norm,
)
from tests.spectral.matrices import defective, grcar

EPS = float(np.finfo(float).eps)
SMALL = np.array([[-1.0, 5], [0, -2]])
POINTS = np.array([0, 0.5j, -1.5 + 0.1j, 3 - 4j, 1e3, -1e-3j, -1.0])
SCALES = [1e-300, 1e-200, 1e-100, 1e-80, 1e-20, 3e-9, 7.0, 1e20, 1e80, 1e100, 1e155, 1e200, 1e300]
RANDOM = np.random.default_rng(16)
NORMAL = np.linalg.qr(RANDOM.normal(size=(12, 12)))[0]
MATRICES = {
    "small": SMALL,
    "random": RANDOM.normal(size=(26, 26)) - 6 * np.eye(26),
    "grcar": grcar(9) - 3 * np.eye(9),
    "defective": defective(-1.0, 30.0),
    # Crowded: sigma_min at many points is left to the SVD.
    "normal": NORMAL * np.linspace(-2, -1, 12) @ NORMAL.T,
    "complex": RANDOM.normal(size=(8, 16)).view(complex) - 6 * np.eye(8),
}
REAL = [name for name in MATRICES if name != "complex"]


def exact_sigma(matrix, z):
    """sigma_min(z I - M) of a 2 x 2 matrix from its norm and determinant, in 60 digits."""
    with mpmath.workdps(60):
        a, b, c, d = (mpmath.mpc(x) for x in np.ravel(matrix))
        z = mpmath.mpc(complex(z))
        square = sum(abs(x) ** 2 for x in (z - a, b, c, z - d))
        determinant = abs((z - a) * (z - d) - b * c)
        root = mpmath.sqrt(square**2 - 4 * determinant**2)
        return determinant * mpmath.sqrt(2 / (square + root))


def relative_error(value, exact):
    return abs(float(value / exact - 1)) if exact else float(value)


# Results, each with the power of the scale that it follows.
Result = tuple[Any, int]


def at_points(matrix, c) -> list[Result]:
    form = schur_form(c * matrix)
    sigma = smallest_singular_values(form, c * POINTS)
    values, condition = eigenvalue_condition_numbers(form)
    found = kept_condition_numbers(form, values[::-1])
    return [(sigma, 1), (values, 1), (form.eigenvalues, 1), (condition, 0), (found, 0)]


def on_grid(matrix, c) -> list[Result]:
    axis = np.array([*-np.logspace(1, -9, 8), 0, *np.logspace(-9, 1, 8)])
    grid = pseudospectrum(schur_form(c * matrix), c * axis, c * axis)
    ratio, z = kreiss_lower_bound(grid, c * 0.25)
    return [(grid.sigma_min, 1), (ratio, 0), (z, 1)]


def searches(matrix, c) -> list[Result]:
    form = schur_form(c * matrix)
    found = [search(form, c * 0.125) for search in (pseudospectral_abscissa, pseudospectral_radius)]
    return [(np.array(x), 1) for x in (*found, distance_to_instability(form))]


def weighted(matrix, c) -> list[Result]:
    form = schur_form(c * matrix, np.logspace(-3, 3, len(matrix)))
    return [
        (smallest_singular_values(form, c * POINTS), 1),
        (np.array(pseudospectral_abscissa(form, c * 0.125)), 1),
        (np.array(distance_to_instability(form)), 1),
    ]


def modes(matrix, c) -> list[Result]:
    kept = np.linalg.eigvals(matrix)
    basis = [basis_of(c * matrix, np.logspace(-1, 1, len(matrix)), c * kept)]
    sensitivity = kept_sensitivity(basis)
    y, times = c * np.linspace(-3, 3, 7), np.linspace(0, 4, 5) / c
    return [
        (modal_matrix(basis[0]), 1),
        (abscissa(basis), 1),
        (kept_form(basis).eigenvalues, 1),
        (condition_number(basis), 0),
        (propagator_norm(basis, times), 0),
        (np.array(oscillation(basis, 1 / c, 4 / c, 9)), 0),
        (resolvent_norm([kept_form(basis)], y), -1),
        (np.array([sensitivity.distance, sensitivity.frequency]), 1),
        (sensitivity.kreiss, 0),
    ]


COMPUTATIONS: list[tuple[Callable[..., list[Result]], str]] = [
    *((part, name) for part in (at_points, on_grid, searches, weighted) for name in MATRICES),
    *((modes, name) for name in REAL if name != "defective"),  # which has no basis of modes
]


def assert_exponents_only(compute, name, powers):
    reference = compute(MATRICES[name], 1.0)
    for power in powers:
        for (value, order), (at_one, _) in zip(
            compute(MATRICES[name], 2.0**power), reference, strict=True
        ):
            np.testing.assert_array_equal(np.asarray(value) / 2.0 ** (order * power), at_one)


@pytest.mark.parametrize(("compute", "name"), COMPUTATIONS)
def test_powers_of_two_change_exponents_only(compute, name):
    assert_exponents_only(compute, name, [-500, -333, 1, 500])


@pytest.mark.soak
@pytest.mark.parametrize(("compute", "name"), COMPUTATIONS)
def test_every_tenth_power_of_two_changes_exponents_only(compute, name):
    assert_exponents_only(compute, name, range(-500, 501, 10))


@pytest.mark.parametrize(("compute", "name"), [(at_points, "random"), (searches, "small")])
@pytest.mark.parametrize("c", [1e-140, 3e-60, 0.3, 1e9, 1e80, 1e100, 1e140])
def test_other_scales_change_rounding_only(compute, name, c):
    # sigma_min moves by rounding of c M, and by the tolerance; both are far below 1e-9 here.
    for (value, order), (at_one, _) in zip(
        compute(MATRICES[name], c), compute(MATRICES[name], 1.0), strict=True
    ):
        np.testing.assert_allclose(np.asarray(value) / c**order, at_one, rtol=1e-9, atol=1e-14)


@pytest.mark.parametrize("scale", SCALES)
def test_sigma_min_of_two_by_two_matrices_of_any_scale(scale):
    matrix, z = scale * SMALL, scale * POINTS
    form = schur_form(matrix)
    if scale < 1e-290:  # below eps of the matrix digits are lost: not at an eigenvalue, then
        z = z[:-1]
    for sigma, point in zip(smallest_singular_values(form, z, 1e-10), z, strict=True):
        error = abs(sigma - float(exact_sigma(matrix, point)))
        assert error <= 1e-10 * sigma + 4 * form.rounding


@pytest.mark.parametrize("scale", [1e-280, 1e-80, 1.0, 1e80, 1e280])
def test_searches_of_two_by_two_matrices_of_any_scale(scale):
    matrix, form = scale * SMALL, schur_form(scale * SMALL)
    epsilon = 0.1 * scale
    for search, size in ((pseudospectral_abscissa, np.real), (pseudospectral_radius, np.abs)):
        value, z = search(form, epsilon)
        assert size(z) == pytest.approx(value, rel=1e-15)
        assert relative_error(exact_sigma(matrix, z), epsilon) < 1e-8
    distance, y = distance_to_instability(form)
    assert relative_error(distance, exact_sigma(matrix, 1j * y)) < 1e-9
    # The Kreiss bound of a stable matrix has no scale.
    x = scale * np.logspace(-3, 3, 61)
    ratio, z = kreiss_lower_bound(pseudospectrum(form, x, [0, scale]))
    assert relative_error(ratio, float(z.real / exact_sigma(matrix, z))) < 1e-6


@pytest.mark.parametrize("z", [1e20, 1e40j, 1e100, 1e160, -1e160 + 1e160j, 1e250j, 1.2e308])
@pytest.mark.parametrize("scale", [1e-80, 1.0])
def test_far_from_the_matrix_sigma_is_the_distance(z, scale):
    sigma = smallest_singular_values(schur_form(scale * SMALL), [z, 1.0])
    assert relative_error(sigma[0], exact_sigma(scale * SMALL, z)) < 4 * EPS
    assert relative_error(sigma[1], exact_sigma(scale * SMALL, 1.0)) < 1e-6


@pytest.mark.parametrize("scale", [1e-300, 1.0, 1e300])
def test_epsilon_far_beyond_the_matrix_gives_a_disc(scale):
    form = schur_form(1e-30 * scale * SMALL)
    for search in (pseudospectral_abscissa, pseudospectral_radius):
        assert search(form, scale) == (scale, scale)


def test_the_zero_matrix_at_any_distance():
    z = np.array([0, 1e-320, 1e-300j, 3 + 4j, 1e300])
    np.testing.assert_array_equal(smallest_singular_values(schur_form(0 * SMALL), z), np.abs(z))


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: schur_form(1e308 * np.ones((3, 3))).eigenvalues, "eigenvalues"),
        (lambda: eigenvalue_condition_numbers(schur_form(1e308 * np.ones((3, 3)))), "eigenvalues"),
        (lambda: smallest_singular_values(schur_form(SMALL), [1.7e308 * (1 + 1j)]), r"\|z\|"),
        (lambda: smallest_singular_values(schur_form([[1.7e308]]), -1.7e308), "sigma_min"),
        (lambda: smallest_singular_values(schur_form(1e-320 * SMALL), [0.1e-320]), "sigma_min"),
        (lambda: distance_to_instability(schur_form(1e-318 * SMALL)), "the distance"),
        (lambda: pseudospectral_abscissa(schur_form([[1.5e308]]), 1e308), "the size"),
        (
            lambda: basis_of(1e308 * np.ones((2, 2)), np.ones(2), np.array([1e308 + 0j])),
            "eigenvalues",
        ),
        (lambda: schur_form(SMALL, [1e-300, 1e300]), "weight"),
    ],
)
def test_what_has_no_representation_is_refused(call, name):
    with pytest.raises(InvalidParameterError, match=f"^{name}"):
        call()


# Axes and clusters


@pytest.mark.parametrize("scale", [1e-200, 1.0, 1e200])
def test_rows_of_a_logarithmic_axis_keep_their_values(scale):
    y = scale * np.logspace(-13, 3, 33)
    imag = np.concatenate([-y[::-1], [0], y])
    grid = pseudospectrum(schur_form(scale * SMALL), [-scale, 0], imag)
    for column, x in enumerate((-scale, 0.0)):
        for row in range(imag.size):
            exact = float(exact_sigma(scale * SMALL, x + 1j * imag[row]))
            error = abs(grid.sigma_min[row, column] - exact)
            assert error <= 1e-6 * exact + 10 * EPS * scale
    # -1 is an eigenvalue: from row to row sigma grows with |y|.
    assert (np.diff(grid.sigma_min[y.size :, 0]) > 0).all()


def test_sides_of_an_axis_that_are_equal_to_rounding_cost_once():
    y = np.linspace(0.1, 3, 20)
    totals = set()
    pseudospectrum(
        schur_form(SMALL),
        [0, 1],
        [*-y[::-1] * (1 + EPS), *y],
        progress=lambda done, total: totals.add(total),
    )
    assert totals == {40}


def crowd(n, spread, kind, seed):
    """n distances of which the smallest is 1 and the others are within ``spread``, and a factor."""
    random = np.random.default_rng(seed)
    if kind == "even":
        return 1 + spread * np.linspace(0, 1, n)
    if kind == "two":
        return np.where(np.arange(n), 1 + spread, 1.0)
    return np.concatenate(
        [[1.0], 1 + spread * random.random(n // 2), 1 + 3 * random.random(n // 2)]
    )


@pytest.mark.parametrize("kind", ["even", "two", "half"])
@pytest.mark.parametrize("n", [5, 90])
def test_crowded_clusters_hold_the_tolerance(n, kind):
    for seed, spread in enumerate(np.logspace(-9, 0, 4)):
        distance = crowd(n, spread, kind, seed)
        angle = np.random.default_rng(seed).uniform(0, 2 * np.pi, distance.size)
        form = schur_form(np.diag(0.3 + distance * np.exp(1j * angle)))
        for tolerance in (0.1, 1e-3, 1e-6, 1e-9):
            (sigma,) = smallest_singular_values(form, [0.3], tolerance)
            assert abs(sigma - 1) <= tolerance / 2 + 5 * np.sqrt(n) * form.rounding
