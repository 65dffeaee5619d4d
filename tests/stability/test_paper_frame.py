"""Coefficients of the paper's frame against their derivation by computer algebra."""

from math import inf, nan, radians

import numpy as np
import pytest

from hopper import Hopper, solve_radial
from hopper.errors import InvalidParameterError
from hopper.spectral import chebyshev
from hopper.stability.paper_frame import coefficients, coefficients_on_half_grid
from hopper.yield_conditions import VON_MISES
from tests.stability.witnesses import derived_coefficients, radial

HOPPERS = [
    ("wedge", 35, 10, 0.0),
    ("cone", 35, 10, 0.0),
    ("wedge", 38, 17, 0.12),
    ("cone", 38, 17, 0.12),
    ("wedge", 25, 50, 0.2),
    ("cone", 30, 30, 0.3),
]
PARITY = {
    "q": 1, "a11": -1, "a12": 1, "a21": 1, "f11": 1, "f12": -1, "f21": -1, "f22": 1,
}  # fmt: skip


def relative_difference(value, reference):
    return np.abs(value - reference).max() / np.abs(reference).max()


@pytest.mark.parametrize("hopper", HOPPERS)
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_agree_with_derivation(hopper, scale):
    solution = radial(*hopper)
    # Near the axis both sides lose digits of (1 - cos 2psi) cot(theta).
    theta = np.random.default_rng(1).uniform(0.2, 1, 40) * solution.hopper.half_angle
    at = coefficients(solution, theta, psi_scale=scale)
    a, f = derived_coefficients(solution, theta)
    # Unknowns (sigma1, psi1 / scale): the second column grows, the second row shrinks.
    change = np.array([[1, scale], [1 / scale, 1]])
    a, f = a * change, f * change
    assert relative_difference(at.a11, a[:, 0, 0]) < 1e-12
    assert relative_difference(at.a11, a[:, 1, 1]) < 1e-12
    assert relative_difference(at.a12, a[:, 0, 1]) < 1e-12
    assert relative_difference(at.a21, a[:, 1, 0]) < 1e-12
    assert relative_difference(at.f11, f[:, 0, 0]) < 1e-12
    assert relative_difference(at.f12, f[:, 0, 1]) < 1e-12
    assert relative_difference(at.f21, f[:, 1, 0]) < 1e-12
    assert relative_difference(at.f22, f[:, 1, 1]) < 1e-12


@pytest.mark.parametrize("size", [12, 24, 80])
def test_on_a_half_grid(size):
    solution = radial("cone", 38, 17, 0.12)
    theta = solution.hopper.half_angle * chebyshev.half_nodes(size)
    on_grid, at = coefficients_on_half_grid(solution, size, 2.0), coefficients(solution, theta, 2.0)
    for name in ("sigma", "psi", *PARITY):
        assert relative_difference(getattr(on_grid, name), getattr(at, name)) < 1e-11


@pytest.mark.parametrize("hopper", HOPPERS)
def test_q_and_the_slopes_of_the_characteristics(hopper):
    solution = radial(*hopper)
    theta = np.linspace(0.1, 1, 7) * solution.hopper.half_angle
    at = coefficients(solution, theta)
    psi = solution.psi_at(theta)
    np.testing.assert_allclose(at.q, solution.hopper.s - np.cos(2 * psi), rtol=1e-13)
    a = np.moveaxis(np.array([[at.a11, at.a12], [at.a21, at.a11]]), 2, 0)
    slopes = np.sort(np.linalg.eigvals(a).real, axis=1)
    expected = (-np.sin(2 * psi)[:, None] + np.cos(solution.hopper.delta) * np.array([1, -1])) / (
        at.q[:, None]
    )
    np.testing.assert_allclose(slopes, expected, rtol=1e-11)


@pytest.mark.parametrize("hopper", [HOPPERS[2], HOPPERS[3]])
def test_parity(hopper):
    solution = radial(*hopper)
    theta = np.linspace(0.1, 1, 7) * solution.hopper.half_angle
    right, left = coefficients(solution, theta), coefficients(solution, -theta)
    for name, sign in PARITY.items():
        np.testing.assert_allclose(getattr(left, name), sign * getattr(right, name), rtol=1e-12)


def test_von_mises_is_refused():
    solution = solve_radial(Hopper("cone", radians(30), radians(10), VON_MISES), 0.1)
    with pytest.raises(InvalidParameterError, match=r"Mohr-Coulomb .* only: use mohr-coulomb"):
        coefficients(solution, [0.1])


@pytest.mark.parametrize("scale", [0.0, -1.0, nan, inf])
def test_bad_psi_scale(scale):
    with pytest.raises(InvalidParameterError, match=r"psi_scale = .* must be a positive number"):
        coefficients(radial("wedge", 35, 10), [0.1], psi_scale=scale)


def test_angles_outside_the_hopper():
    with pytest.raises(InvalidParameterError, match=r"outside the hopper: keep .* = 10 deg"):
        coefficients(radial("wedge", 35, 10), [0.1, radians(10.1)])
