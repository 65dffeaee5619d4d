"""The paper's formulas as printed, against the package's own."""

from math import asin, degrees, radians, sin

import numpy as np
import pytest

from hopper.evidence import printed
from hopper.stability import paper_frame
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.stability.witnesses import radial


@pytest.mark.parametrize("law", [MOHR_COULOMB, VON_MISES])
@pytest.mark.parametrize("delta", [1, 20, 45, 89])
def test_singular_angles(law, delta):
    s = sin(radians(delta))
    expected = law.singular_angle(radians(delta))
    assert printed.nonsingular_below(law, s) == pytest.approx(expected, rel=1e-13)
    assert printed.first_singular_angle(law, s) == pytest.approx(expected, rel=1e-13)
    for psi in np.linspace(0, 0.99 * expected, 20):
        assert np.linalg.det(printed.radial_matrix(law, s, 1.0, psi)) > 0


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_the_printed_matrices_are_those_of_half_psi(geometry):
    solution = radial(geometry, 38, 17, 0.12)
    theta = np.linspace(0.2, 1, 9) * solution.hopper.half_angle
    a, b, c = printed.linearised(solution, theta)
    at = paper_frame.coefficients(solution, theta, psi_scale=2.0)
    f = b + solution.hopper.curvature * c
    for value, expected in (
        (a[:, 0, 0], at.a11), (a[:, 0, 1], at.a12), (a[:, 1, 0], at.a21), (a[:, 1, 1], at.a11),
        (f[:, 0, 0], at.f11), (f[:, 0, 1], at.f12), (f[:, 1, 0], at.f21), (f[:, 1, 1], at.f22),
    ):  # fmt: skip
        assert np.abs(value - expected).max() < 1e-12 * np.abs(expected).max()


def test_comparison_with_the_equations_of_motion():
    found = printed.compare_linearised(radial("cone", 38, 17, 0.12), 7)
    for ratio in found.ratio:
        np.testing.assert_allclose(ratio, np.array([[1, 2], [0.5, 1]]), rtol=1e-12)
    assert found.spread.max() < 1e-11


def test_the_limit_of_von_mises_is_the_smaller():
    for s in np.linspace(0.01, 0.99, 50):
        limits = [printed.nonsingular_below(law, s) for law in (VON_MISES, MOHR_COULOMB)]
        assert limits[0] < limits[1], degrees(asin(s))
