"""Stresses at the top: what they are, and what is refused."""

from math import degrees, radians

import numpy as np
import pytest

from hopper.errors import InvalidParameterError, NonPositiveStressError, TangencyError
from hopper.march.base import base_of, radial_fields
from hopper.march.fields import stress_of
from hopper.march.outcome import march
from hopper.march.tops import (
    Top,
    bin_like,
    bump_of_psi,
    bump_of_sigma,
    linear_psi,
    one_sided_bump,
    profile,
    require_admissible,
    riemann_deviation,
    scaled,
)
from hopper.problem import Hopper
from hopper.radial.solution import solve_radial
from hopper.yield_conditions import VON_MISES
from tests.march.witnesses import BEYOND, base

X = np.linspace(-1, 1, 41)
CONE = ("cone", 38, 17, 0.12)


def fields(under, top, x=X):
    even, odd = top.deviation(under, x)
    sigma, psi = radial_fields(under, under.hopper.half_angle * x)
    return sigma * np.exp(even), psi + odd


def given(under, count=81, half=True):
    theta = under.hopper.half_angle * np.linspace(0 if half else -1, 1, count)
    return (theta, *radial_fields(under, theta))


@pytest.mark.parametrize("case", [CONE, ("wedge", 38, 17, 0.12)])
@pytest.mark.parametrize(
    "top", [scaled(0.8), linear_psi(), bin_like(), bump_of_sigma(0.1), bump_of_psi(0.1)]
)
def test_tops_are_symmetric_and_keep_the_wall_law(case, top):
    under = base(*case)
    sigma, psi = fields(under, top)
    np.testing.assert_allclose(sigma, sigma[::-1], rtol=1e-13)
    np.testing.assert_allclose(psi, -psi[::-1], rtol=0, atol=1e-13)
    assert psi[-1] == pytest.approx(under.solution.psi_wall, abs=1e-13)
    require_admissible(under, top)


def test_bin_has_a_uniform_vertical_stress_and_a_horizontal_major_axis():
    under = base(*CONE)
    sigma, psi = fields(under, bin_like())
    theta = under.hopper.half_angle * X
    t = stress_of(under.hopper.s, sigma, psi)
    vertical = t.rr * np.cos(theta) ** 2 + t.tt * np.sin(theta) ** 2 - t.rt * np.sin(2 * theta)
    np.testing.assert_allclose(vertical, vertical[20], rtol=1e-12)
    # Near the axis the major axis is horizontal: psi = -theta.
    assert psi[21] == pytest.approx(-theta[21], rel=0.02)


def test_bumps_are_as_stated():
    under, x = base(*CONE), np.array([0.25, 0.5])
    sigma, psi = fields(under, bump_of_sigma(0.3), x)
    radial = fields(under, scaled(1.0), x)
    np.testing.assert_allclose(np.log(sigma / radial[0]), 0.3 * (1 - x**2) ** 6, rtol=1e-12)
    np.testing.assert_allclose(psi, radial[1], rtol=1e-14)
    _, psi = fields(under, bump_of_psi(0.3), x)
    np.testing.assert_allclose(psi - radial[1], 0.3 * x * (1 - x**2) ** 6, rtol=1e-12)
    even, odd = one_sided_bump(0.1).deviation(under, np.array([-0.5, 0.0, 0.5, 0.75, 1.0]))
    np.testing.assert_allclose(even, 0.1 * np.array([0, 0, 1, 0.75**6, 0]), rtol=1e-14)
    assert np.all(odd == 0)


def test_profile_of_the_radial_field_is_the_radial_field():
    under = base(*CONE)
    for half in (True, False):
        top = profile(*given(under, half=half))
        assert top.symmetric
        w = riemann_deviation(under, top, X)
        assert np.abs(w).max() < 1e-7


def test_profile_without_symmetry():
    under = base("wedge", 38, 17, 0.12)
    theta, sigma, psi = given(under, 161, half=False)
    even, _ = one_sided_bump(0.1).deviation(under, theta / under.hopper.half_angle)
    top = profile(theta, sigma * np.exp(even), psi)
    assert not top.symmetric
    np.testing.assert_allclose(
        riemann_deviation(under, top, X),
        riemann_deviation(under, one_sided_bump(0.1), X),
        atol=2e-6,
    )


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        (lambda t, s, p: (t, s, p * (1 - 0.1 * (t == t[-1]))), InvalidParameterError, "wall law"),
        (lambda t, s, p: (t, s * np.nan, p), InvalidParameterError, "finite"),
        (lambda t, s, p: (t, -s, p), NonPositiveStressError, "not positive"),
        (lambda t, s, p: (t[::-1], s, p), InvalidParameterError, "increasing"),
        (lambda t, s, p: (t, s[1:], p), InvalidParameterError, "one length"),
        (lambda t, s, p: (t[1:], s[1:], p[1:]), InvalidParameterError, "begins at theta = 0"),
        (lambda t, s, p: (0.9 * t, s, p), InvalidParameterError, "must reach the walls"),
        (lambda t, s, p: (t, s, p + 3 * t * (t[-1] - t) / t[-1] ** 2), TangencyError, "beyond"),
    ],
)
def test_bad_profiles_are_refused(change, error, words):
    under = base("wedge", 38, 17, 0.12)
    with pytest.raises(error, match=words) as caught:
        require_admissible(under, profile(*change(*given(under))))
    assert "\n" not in str(caught.value)


def test_error_of_the_wall_law_names_the_right_angle():
    under = base(*CONE)
    top = Top("wrong", True, lambda _, x: (0 * x, 0.01 * x))
    wanted = degrees(under.solution.psi_wall)
    with pytest.raises(InvalidParameterError, match=f"must be {wanted:.6g} deg"):
        require_admissible(under, top)


def test_bad_amplitudes_and_factors():
    for factor in (0.0, -1.0):
        with pytest.raises(NonPositiveStressError, match="factor"):
            scaled(factor)
    for wrong in (np.nan, np.inf, "2"):
        with pytest.raises(InvalidParameterError, match="factor"):
            scaled(wrong)  # type: ignore[arg-type]
    for amplitude in (np.nan, np.inf, "1"):
        with pytest.raises(InvalidParameterError, match="amplitude"):
            bump_of_sigma(amplitude)  # type: ignore[arg-type]
    with pytest.raises(InvalidParameterError, match="finite everywhere"):
        require_admissible(base(*CONE), Top("nan", True, lambda _, x: (0 * x, np.nan * x)))


def test_a_cone_has_no_top_without_symmetry():
    with pytest.raises(InvalidParameterError, match="must be symmetric"):
        require_admissible(base(*CONE), one_sided_bump(0.1))


@pytest.mark.parametrize("case", [CONE, BEYOND])
def test_active_stress_is_beyond_the_tangency(case):
    """The major axis vertical: no smooth march starts there, in no time."""
    active = Top("active", True, lambda _, x: (0 * x, 4 * x * (1 - x**2)))
    with pytest.raises(TangencyError, match="no smooth march") as caught:
        march(base(*case), active, 1.0)
    assert 0 < caught.value.theta < base(*case).hopper.half_angle


@pytest.mark.parametrize("depth", [0.0, -1.0, np.nan, np.inf, 800.0, "1"])
def test_bad_depths(depth):
    with pytest.raises(InvalidParameterError, match="tau_end"):
        march(base(*CONE), scaled(1.0), depth)


def test_bases_that_cannot_be_marched():
    hopper = Hopper("cone", radians(35), radians(10), VON_MISES)
    with pytest.raises(InvalidParameterError, match="Mohr-Coulomb"):
        base_of(solve_radial(hopper, 0.0))
    with pytest.raises(TangencyError):
        base_of(base(*BEYOND).solution, tilted=False)
