"""Chebyshev tools against polynomials, Gauss quadrature and analytic functions."""

import numpy as np
import pytest
from numpy.polynomial import chebyshev as series
from numpy.polynomial.legendre import leggauss

from hopper.errors import InvalidParameterError
from hopper.spectral import chebyshev

# Random polynomials: an operator that is exact on these is exact, whatever its construction.
RANDOM = np.random.default_rng(20)


def runge(x):
    """Smooth, without parity, with poles at +-i/2: 80 nodes resolve it to rounding."""
    return np.exp(x) / (1 + 4 * x**2)


def runge_slope(x):
    return runge(x) * (1 - 8 * x / (1 + 4 * x**2))


@pytest.mark.parametrize("n", [2, 3, 16, 47, 400])
def test_nodes_are_the_extrema_of_the_chebyshev_polynomial(n):
    x = chebyshev.nodes(n)
    assert x[0] == -1
    assert x[-1] == 1
    assert np.all(np.diff(x) > 0)
    np.testing.assert_array_equal(x, -x[::-1])
    assert np.abs(x + np.cos(np.pi * np.arange(n) / (n - 1))).max() < 5e-16
    polynomial = series.Chebyshev.basis(n - 1)
    np.testing.assert_allclose(np.abs(polynomial(x)), 1, atol=1e-12)


@pytest.mark.parametrize("n", [2, 5, 16, 33])
def test_derivative_of_polynomials_is_exact(n):
    polynomial = series.Chebyshev(RANDOM.normal(size=n))
    x, matrix = chebyshev.nodes(n), chebyshev.differentiation_matrix(n)
    error = np.abs(matrix @ polynomial(x) - polynomial.deriv()(x)).max()
    # Rounding of the n-term sums behind the values, amplified by the norm of the matrix.
    assert error < 3e-16 * n * np.abs(matrix).sum(axis=1).max() * np.abs(polynomial(x)).max()


def test_derivative_of_a_smooth_function_on_a_large_grid():
    x = chebyshev.nodes(400)
    error = chebyshev.differentiation_matrix(400) @ runge(x) - runge_slope(x)
    assert np.abs(error).max() < 1e-10


@pytest.mark.parametrize("n", [2, 3, 16, 31, 200])
def test_differentiation_matrix_symmetry_and_row_sums(n):
    matrix = chebyshev.differentiation_matrix(n)
    rows = np.abs(matrix).sum(axis=1)
    assert np.all(np.abs(matrix.sum(axis=1)) <= 4e-16 * rows)
    mirrored = -matrix[::-1, ::-1]
    # The diagonals of mirrored rows are sums of the same numbers in reversed order; the middle row
    # of an odd grid is its own mirror image. All else is symmetric to the last bit.
    exact = ~np.eye(n, dtype=bool)
    exact[(n - 1) / 2 == np.arange(n)] = False
    np.testing.assert_array_equal(matrix[exact], mirrored[exact])
    assert np.all(np.abs(matrix - mirrored) <= 4e-15 * rows[:, None])


@pytest.mark.parametrize("n", [2, 3, 8, 33, 200, 399])
def test_clenshaw_curtis_is_exact_on_polynomials(n):
    weights = chebyshev.clenshaw_curtis_weights(n)
    assert np.all(weights > 0)
    polynomial = series.Chebyshev(RANDOM.normal(size=n))
    antiderivative = polynomial.integ()
    exact = antiderivative(1) - antiderivative(-1)
    assert abs(weights @ polynomial(chebyshev.nodes(n)) - exact) < 1e-13


def test_clenshaw_curtis_agrees_with_gauss():
    x, gauss = leggauss(120)
    ours = chebyshev.clenshaw_curtis_weights(120) @ runge(chebyshev.nodes(120))
    assert abs(ours - gauss @ runge(x)) < 1e-14


def test_interpolation_between_and_at_nodes():
    x = np.concatenate([np.linspace(-1, 1, 301), chebyshev.nodes(81)[[0, 7, 40, 80]]])
    matrix = chebyshev.interpolation_matrix(81, x)
    assert np.abs(matrix @ runge(chebyshev.nodes(81)) - runge(x)).max() < 1e-14
    # A node returns its own value, exactly.
    np.testing.assert_array_equal(matrix[-4:], np.eye(81)[[0, 7, 40, 80]])


def test_interpolation_converges_at_the_rate_of_the_pole():
    """The Bernstein ellipse through the pole i/2 has parameter (1 + sqrt 5) / 2."""
    x = np.linspace(-1, 1, 501)

    def error(n):
        return np.abs(
            chebyshev.interpolation_matrix(n, x) @ runge(chebyshev.nodes(n)) - runge(x)
        ).max()

    rate = (error(20) / error(40)) ** (1 / 20)
    assert rate == pytest.approx((1 + 5**0.5) / 2, rel=0.02)


@pytest.mark.parametrize("n", [2, 3, 24, 25])
def test_coefficients_round_trip(n):
    expected = RANDOM.normal(size=(n, 2))
    values = series.chebvander(chebyshev.nodes(n), n - 1) @ expected
    assert np.abs(chebyshev.coefficients(values) - expected).max() < 2e-14


def test_half_nodes_are_the_positive_half():
    np.testing.assert_array_equal(chebyshev.half_nodes(12), chebyshev.nodes(24)[12:])


@pytest.mark.parametrize(
    ("parity", "function"),
    [("even", lambda x: np.cos(3 * x) / (1 + x**2)), ("odd", lambda x: np.sin(3 * x) / (1 + x**2))],
)
def test_half_grid_operators_equal_the_full_ones(parity, function):
    m = 20
    full, half = chebyshev.nodes(2 * m), chebyshev.half_nodes(m)
    matrix = chebyshev.differentiation_matrix(2 * m)
    slope = chebyshev.half_differentiation_matrix(m, parity) @ function(half)
    # Same products in another order.
    rounding = 1e-15 * np.abs(matrix).sum(axis=1).max()
    assert np.abs(slope - (matrix @ function(full))[m:]).max() < rounding
    x = np.linspace(-1, 1, 57)
    ours = chebyshev.half_interpolation_matrix(m, x, parity) @ function(half)
    np.testing.assert_allclose(
        ours, chebyshev.interpolation_matrix(2 * m, x) @ function(full), atol=2e-15
    )
    everything = chebyshev.coefficients(function(full))
    kept, dropped = (0, 1) if parity == "even" else (1, 0)
    np.testing.assert_allclose(
        chebyshev.half_coefficients(function(half), parity), everything[kept::2], atol=2e-15
    )
    assert np.abs(everything[dropped::2]).max() < 1e-15
    last = chebyshev.last_half_coefficients(half.size, parity, 3) @ function(half)
    np.testing.assert_allclose(last, everything[kept::2][-3:], atol=2e-15)
    for count in (0, half.size + 1):
        with pytest.raises(InvalidParameterError, match="count"):
            chebyshev.last_half_coefficients(half.size, parity, count)


def test_integral_of_an_odd_function():
    x = chebyshev.half_nodes(30)
    ours = chebyshev.integrate_odd(2 * x * np.cos(3 * x**2))
    assert np.abs(ours - np.sin(3 * x**2) / 3).max() < 1e-15


def test_integral_of_an_odd_polynomial_is_exact_up_to_the_last_degree():
    m = 7
    coefficients = np.zeros(2 * m)
    coefficients[1::2] = RANDOM.normal(size=m)
    polynomial = series.Chebyshev(coefficients)
    x = chebyshev.half_nodes(m)
    expected = polynomial.integ(lbnd=0)(x)
    np.testing.assert_allclose(chebyshev.integrate_odd(polynomial(x)), expected, atol=1e-15)


@pytest.mark.parametrize(
    "cached",
    [
        lambda: chebyshev.nodes(9),
        lambda: chebyshev.half_nodes(9),
        lambda: chebyshev.differentiation_matrix(9),
        lambda: chebyshev.half_differentiation_matrix(9, "odd"),
        lambda: chebyshev.clenshaw_curtis_weights(9),
    ],
)
def test_cached_arrays_are_read_only(cached):
    with pytest.raises(ValueError, match="read-only"):
        cached()[0] = 0
