"""Smooth-wall theory against closed forms, high precision, and a Ritz method for its equation."""

from math import asin, degrees, nan, pi, radians, sin, sqrt
from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest
from numpy.polynomial import legendre
from scipy.linalg import eigh
from scipy.special import jn_zeros

from hopper.errors import InvalidParameterError
from hopper.stability.smooth_wall import (
    CONE_VARIANTS,
    abscissa,
    cone_eigenvalues,
    cone_wavenumbers,
    crossing_delta,
    largest_distinct_half_angle,
    neutral_delta,
    oscillation_threshold,
    wedge_eigenvalues,
)

# Sturm-Liouville forms (w u')' - w v u + mu w u = 0 of u'' + (u g)' + mu u = 0: (w, v).
STURM_LIOUVILLE: dict[str, tuple[Any, Any]] = {
    "bessel": (lambda x: x, lambda x: 1 / x**2),
    "kummer": (lambda x: x * np.exp(-(x**2) / 6), lambda x: 1 / x**2 + 1 / 3),
    "legendre": (np.sin, lambda x: 1 / np.sin(x) ** 2),
}
CHARACTERISTIC = {
    "bessel": lambda mu, angle: mpmath.besselj(1, mpmath.sqrt(mu) * angle),
    "kummer": lambda mu, angle: mpmath.hyp1f1(1 - 3 * mu / 2, 2, angle**2 / 6),
    "legendre": lambda mu, angle: mpmath.legenp(
        mpmath.sqrt(mu + mpmath.mpf(1) / 4) - mpmath.mpf(1) / 2, 1, mpmath.cos(angle), type=2
    ),
}


def ritz_values(variant, half_angle, count, size=60):
    """Lowest mu_n in odd polynomials that vanish at the wall, by Gauss-Legendre quadrature."""
    weight, potential = STURM_LIOUVILLE[variant]
    # On (0, 1): the weight is odd.
    x, quadrature = legendre.leggauss(2 * size)
    x, quadrature = (x + 1) / 2, quadrature / 2
    basis = np.eye(2 * size)
    slopes = legendre.legder(basis, axis=0) / half_angle
    u, du = (np.diff(legendre.legval(x, c[:, 1::2]).T, axis=1) for c in (basis, slopes))
    theta = half_angle * x
    w = (quadrature * weight(theta))[:, None]
    stiffness = du.T @ (w * du) + u.T @ (w * potential(theta)[:, None] * u)
    return eigh(stiffness, u.T @ (w * u), eigvals_only=True)[:count]


# The line.


def test_abscissae():
    s = np.array([0, 0.3, 0.5, 0.7, 0.9])
    delta = np.arcsin(s)
    np.testing.assert_allclose(abscissa("wedge", delta), (2 - 3 * s) / (1 - s), rtol=1e-14)
    np.testing.assert_allclose(abscissa("cone", delta), (5 - 9 * s) / (2 - 2 * s), rtol=1e-14)


@pytest.mark.parametrize(("geometry", "delta"), [("wedge", 41.81), ("cone", 33.75)])
def test_neutral_delta(geometry, delta):
    neutral = neutral_delta(geometry)
    assert degrees(neutral) == pytest.approx(delta, abs=5e-3)
    assert abs(abscissa(geometry, neutral)) < 1e-14
    assert abscissa(geometry, neutral - 1e-3) > 0 > abscissa(geometry, neutral + 1e-3)


def test_crossing():
    crossing = crossing_delta()
    assert degrees(crossing) == pytest.approx(19.47, abs=5e-3)
    for geometry in ("wedge", "cone"):
        assert abscissa(geometry, crossing) == pytest.approx(1.5, rel=1e-14)
    assert abscissa("cone", crossing - 0.01) > abscissa("wedge", crossing - 0.01)
    assert abscissa("cone", crossing + 0.01) < abscissa("wedge", crossing + 0.01)


# Eigenvalues.


@pytest.mark.parametrize(("delta", "half_angle"), [(35, 10), (20, 60), (70, 85)])
def test_wedge_eigenvalues_solve_4_4(delta, half_angle):
    s, angle, count = sin(radians(delta)), radians(half_angle), 6
    physical, mirrored = wedge_eigenvalues(radians(delta), angle, count)
    n = np.tile(np.arange(count), 2)
    for eigenvalues, wavenumber in (
        (physical, (n + 1) * pi / angle),
        (mirrored, (2 * n + 1) * pi / (2 * angle)),
    ):
        # Omega'' = -wavenumber^2 Omega in (4.4).
        terms = np.array(
            [
                (1 - s) * eigenvalues**2,
                (-4 + 6 * s) * eigenvalues,
                3 * (1 - 3 * s) + 0 * n,
                (1 + s) * wavenumber**2,
            ]
        )
        assert np.all(np.abs(terms.sum(axis=0)) < 1e-13 * np.abs(terms).max(axis=0))
        assert np.unique(np.round(eigenvalues, 6)).size == 2 * count


@pytest.mark.parametrize("delta", [20, 35, 66.5, 80])
def test_cone_eigenvalues_solve_4_5(delta):
    s = sin(radians(delta))
    mu = cone_wavenumbers(radians(45), 5)
    eigenvalues = cone_eigenvalues(radians(delta), mu)
    assert eigenvalues.shape == (10,)
    terms = np.array(
        [
            (1 - s) * eigenvalues**2,
            (-5 + 9 * s) * eigenvalues,
            np.tile(4 - 20 * s + (1 + s) * mu, 2),
        ]
    )
    assert np.all(np.abs(terms.sum(axis=0)) < 1e-13 * np.abs(terms).max(axis=0))
    assert np.unique(np.round(eigenvalues, 6)).size == 10


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_complex_eigenvalues_lie_on_the_line(geometry):
    delta, half_angle = radians(35), radians(10)
    if geometry == "wedge":
        eigenvalues = np.concatenate(wedge_eigenvalues(delta, half_angle, 30))
    else:
        eigenvalues = cone_eigenvalues(delta, cone_wavenumbers(half_angle, 30))
    np.testing.assert_allclose(eigenvalues.real, abscissa(geometry, delta), rtol=1e-13)
    assert np.all(np.abs(eigenvalues.imag) > 10)


# Wavenumbers of the cone.


@pytest.mark.parametrize("half_angle", [10, 60])
@pytest.mark.parametrize("variant", CONE_VARIANTS)
def test_wavenumbers_are_roots_in_high_precision(variant, half_angle):
    characteristic = CHARACTERISTIC[variant]
    with mpmath.workdps(30):
        angle = mpmath.radians(half_angle)
        for mu in cone_wavenumbers(radians(half_angle), 20, variant):
            below, above = (
                characteristic(mpmath.mpf(mu) * (1 + shift), angle) for shift in (-1e-11, 1e-11)
            )
            assert below * above < 0


@pytest.mark.parametrize("half_angle", [1, 10, 45, 89])
@pytest.mark.parametrize("variant", CONE_VARIANTS)
def test_wavenumbers_by_a_ritz_method(variant, half_angle):
    # Counts them too: none is skipped, none found twice.
    angle = radians(half_angle)
    mu = cone_wavenumbers(angle, 20, variant)
    np.testing.assert_allclose(mu, ritz_values(variant, angle, 20), rtol=1e-10)


def test_many_wavenumbers_shift_within_bounds():
    # In normal form y'' + (mu - 3 / (4 x^2) - d(x)) y = 0 the variants differ in d alone: 0, x^2/36
    # and x^2/20 + O(x^4). By min-max each mu_n is shifted by at most max d.
    half_angle = radians(10)
    bessel, kummer, legendre_ = (cone_wavenumbers(half_angle, 150, v) for v in CONE_VARIANTS)
    np.testing.assert_allclose(np.sqrt(bessel) * half_angle, jn_zeros(1, 150), rtol=1e-14)
    largest = 3 / (4 * np.sin(half_angle) ** 2) - 1 / 4 - 3 / (4 * half_angle**2)
    assert largest == pytest.approx(half_angle**2 / 20, rel=0.01)
    assert np.all((kummer > bessel) & (kummer < bessel + half_angle**2 / 36))
    assert np.all((legendre_ > bessel) & (legendre_ < bessel + largest))


def test_first_wavenumber_at_10_degrees():
    values = [cone_wavenumbers(radians(10), 1, variant)[0] for variant in CONE_VARIANTS]
    np.testing.assert_allclose(values, [481.98067, 481.98095, 481.98117], rtol=0, atol=1e-5)
    # "virtually unchanged"
    assert abs(values[1] / values[0] - 1) < 6.5e-7


# The threshold f.


def test_threshold_values():
    assert oscillation_threshold(0.0) == pytest.approx(1, rel=1e-15)
    assert oscillation_threshold(pi / 4) == pytest.approx(0.9159, abs=5e-5)
    assert degrees(asin(oscillation_threshold(pi / 4))) == pytest.approx(66.34, abs=5e-3)
    assert np.all(np.diff(oscillation_threshold(np.linspace(0, pi / 4, 200))) < 0)


@pytest.mark.parametrize("half_angle", [10, 30, 45, 80])
def test_threshold_is_where_the_first_pair_becomes_real(half_angle):
    angle = radians(half_angle)
    threshold = asin(oscillation_threshold(angle))
    mu = cone_wavenumbers(angle, 1, "bessel")
    assert np.all(cone_eigenvalues(threshold - 1e-6, mu).imag != 0)
    assert np.all(cone_eigenvalues(threshold + 1e-6, mu).imag == 0)
    for delta in np.linspace(0.1, 0.99, 10) * threshold:
        assert np.all(cone_eigenvalues(delta, mu).imag != 0)


def test_first_wavenumber_exceeds_2_below_the_largest_distinct_half_angle():
    largest = largest_distinct_half_angle()
    assert largest == pytest.approx(2.709, abs=5e-4)
    assert degrees(largest) == pytest.approx(155, abs=0.5)
    assert (jn_zeros(1, 1)[0] / largest) ** 2 == pytest.approx(2, rel=1e-14)
    assert np.isfinite(oscillation_threshold(largest * (1 - 1e-12)))
    # At mu_1 = 2 both zeros of the discriminant meet.
    x1 = largest * sqrt(2)
    double_root = -3 * largest**2 / (largest**2 + 4 * x1**2)
    assert oscillation_threshold(largest * (1 - 1e-12)) == pytest.approx(double_root, abs=1e-5)
    assert cone_wavenumbers(radians(89.9), 1, "bessel")[0] > 2


# Refusals.


@pytest.mark.parametrize("value", [0.0, -0.1, pi / 2, nan])
def test_bad_angles(value):
    with pytest.raises(InvalidParameterError, match=r"half_angle = .* must lie in \(0, 90\) deg"):
        wedge_eigenvalues(0.5, value, 3)
    with pytest.raises(InvalidParameterError, match=r"half_angle = .* must lie in \(0, 90\) deg"):
        cone_wavenumbers(value, 3)
    with pytest.raises(InvalidParameterError, match=r"delta = .* must lie in \(0, 90\) deg"):
        wedge_eigenvalues(value, 0.5, 3)


@pytest.mark.parametrize("count", [0, -1])
def test_bad_counts(count):
    with pytest.raises(InvalidParameterError, match="modes: ask for at least 1"):
        wedge_eigenvalues(0.5, 0.5, count)
    with pytest.raises(InvalidParameterError, match="modes: ask for at least 1"):
        cone_wavenumbers(0.5, count)


def test_unknown_variant():
    with pytest.raises(
        InvalidParameterError, match="'airy' is unknown: use one of bessel, kummer, legendre"
    ):
        cone_wavenumbers(0.5, 3, "airy")  # type: ignore[arg-type]
