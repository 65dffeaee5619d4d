"""(4.3) as it stands, against the formulas the paper deduces from it."""

from math import degrees, pi, radians, sin

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

from hopper import Hopper, linear_stability
from hopper.evidence import smooth_operator
from hopper.evidence.smooth_operator import check_formula, kummer_residual, operator_matrix
from hopper.stability import smooth_wall
from tests.stability.witnesses import radial


@pytest.mark.parametrize(("geometry", "factor"), [("wedge", 3), ("cone", 5)])
@pytest.mark.parametrize("delta", [25, 35, 50])
@pytest.mark.parametrize("half_angle", [10, 45])
def test_the_pairs_lack_one_eigenvalue(geometry, factor, delta, half_angle):
    s = sin(radians(delta))
    check = check_formula(Hopper(geometry, radians(delta), radians(half_angle)), 8, 32)
    assert check.error < 1e-11
    # omega = 0, sigma constant.
    np.testing.assert_allclose(check.missing, [(1 - factor * s) / (1 - s)], rtol=1e-10)
    assert check.missing[0].real < smooth_wall.abscissa(geometry, radians(delta))


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_the_operator_is_the_limit_of_the_full_one(geometry):
    # psi on a smooth wall vanishes with the half angle.
    hopper = Hopper(geometry, radians(35), radians(0.5))
    smooth = np.linalg.eigvals(operator_matrix(hopper, 24)).astype(complex)
    full = linear_stability(radial(geometry, 35, 0.5)).eigenvalues[:3]
    for value in full:
        assert np.abs(smooth - value).min() < 1e-4 * abs(value)


def test_roots_of_the_eigenvalues():
    for geometry in smooth_operator._GEOMETRIES:
        root = smooth_operator.neutral_delta(geometry, radians(10))
        assert root == pytest.approx(smooth_wall.neutral_delta(geometry), abs=1e-12)
    crossing = smooth_operator.crossing_delta(radians(10))
    assert crossing == pytest.approx(smooth_wall.crossing_delta(), abs=1e-12)


@pytest.mark.parametrize("half_angle", [5, 30, 45])
def test_onset_of_real_eigenvalues(half_angle):
    angle = radians(half_angle)
    onset = smooth_operator.real_onset(angle)
    assert sin(onset) == pytest.approx(float(smooth_wall.oscillation_threshold(angle)), abs=1e-12)
    below, above = np.linspace(0.1, 0.999, 20) * onset, np.array([onset + 1e-6])
    assert smooth_operator.real_eigenvalues(below, angle, 10) == 0
    assert smooth_operator.real_eigenvalues(above, angle, 10) == 2


@pytest.mark.parametrize("mu", [100.0, 481.98])
def test_kummer_solves_4_10(mu):
    assert kummer_residual(mu, radians(10), 32) < 1e-8

    def residual(power):
        # In high precision; with power = 0, without the factor theta.
        def omega(x):
            return x**power * mpmath.hyp1f1(1 - 1.5 * mu, 2, x**2 / 6)

        theta = mpmath.mpf(0.1)
        first, second = mpmath.diff(omega, theta), mpmath.diff(omega, theta, 2)
        terms = (
            theta**2 * second,
            (theta - theta**3 / 3) * first,
            ((mu - mpmath.mpf(1) / 3) * theta**2 - 1) * omega(theta),
        )
        return abs(sum(terms)) / max(abs(term) for term in terms)

    with mpmath.workdps(40):
        assert residual(1) < 1e-15
        assert residual(0) > 0.1


def test_the_widest_half_angle_of_the_paper():
    assert degrees(smooth_operator.real_onset(pi / 4)) == pytest.approx(66.34, abs=5e-3)
