"""Shooting, the witness of all else about the tilted problem, against what it can be held against.

Radial solutions of the package, spectra computed elsewhere, an exact mode, and itself: Newton from
elsewhere, the argument principle, other tolerances.
"""

import numpy as np
import pytest

from tests.stability.tilted_data import ELSEWHERE, ELSEWHERE_NAMES, as_complex, name, radial, read
from tests.stability.tilted_equations import compiled
from tests.stability.tilted_reference import all_modes
from tests.stability.tilted_witnesses import (
    ASYMMETRIC,
    SYMMETRIC,
    Base,
    contour,
    shoot_all,
    to_wall,
)

REFERENCE = read("tilted_reference")
EVERY = pytest.mark.parametrize("case", REFERENCE, ids=name)


@EVERY
def test_radial_solution_ends_at_the_wall_of_the_package(case):
    solution = radial(case)
    wall = to_wall(solution, 0)
    # Rounding of 1e-13 in sigma_0 besides the package's own estimate.
    tolerance = 1e-12 + 10 * solution.error_estimate
    assert wall.psi == pytest.approx(solution.psi_wall, abs=tolerance)
    assert wall.sigma == pytest.approx(solution.sigma_wall, rel=tolerance)
    assert solution.sigma_axis == pytest.approx(case["sigma_axis"], rel=tolerance)


@pytest.mark.parametrize(("case", "parity", "modes"), ELSEWHERE, ids=ELSEWHERE_NAMES)
def test_spectra_computed_elsewhere(case, parity, modes):
    solution = radial(case)
    found = shoot_all(solution, modes * (1 + 1e-4) + 1e-4, parity)
    np.testing.assert_allclose(found, modes, rtol=case["tolerance_relative"])


@pytest.mark.parametrize(("case", "parity", "modes"), ELSEWHERE[::3], ids=ELSEWHERE_NAMES[::3])
def test_no_mode_is_missing(case, parity, modes):
    """By the argument principle, in a rectangle around all of them and their conjugates."""
    low = complex(modes.real.min() - 1.1, -modes.imag.max() - 1.1)
    conjugates = modes[modes.imag > 0].conj()
    number, total = contour(radial(case), low, 20 - low.imag * 1j, parity)
    assert number == modes.size + conjugates.size
    assert total == pytest.approx(modes.sum() + conjugates.sum(), abs=0.1)


def moved_apex(member, theta, sigma, psi, parity):
    """The change of a radial solution when its apex moves by a constant vector, over r."""
    d_sigma, d_psi = compiled(member.hopper.curvature)(member.hopper.s, theta, sigma, psi)[:2]
    if parity == SYMMETRIC:
        along = np.cos(theta) * sigma - np.sin(theta) * d_sigma
        return np.array([along, -np.sin(theta) * (1 + d_psi)])
    return np.array([np.sin(theta) * sigma + np.cos(theta) * d_sigma, np.cos(theta) * (1 + d_psi)])


@EVERY
def test_moving_the_apex_is_the_regular_disturbance_of_lambda_one(case):
    """An exact solution, whatever the wall: upwards in all hoppers, sideways in wedges."""
    hopper = radial(case).hopper
    member = Base(hopper, case["sigma_axis"])
    for parity in [SYMMETRIC, ASYMMETRIC] if hopper.geometry == "wedge" else [SYMMETRIC]:
        wall = to_wall(member, 1, parity)
        expected = moved_apex(member, hopper.half_angle, wall.sigma, wall.psi, parity)
        if parity == SYMMETRIC:
            expected /= member.sigma_axis
        else:
            expected /= moved_apex(member, 0.0, member.sigma_axis, 0.0, parity)[1]
        found = np.array([wall.sigma1[0], wall.psi1[0]])
        assert np.abs(found - expected).max() < 2e-11 * np.abs(expected).max()


def assert_reproduced(case):
    member = Base(radial(case).hopper, case["sigma_axis"])
    for parity in {SYMMETRIC, ASYMMETRIC} & case.keys():
        found = all_modes(member, parity, case["lowest_re"], case["highest_im"])
        modes = as_complex(case[parity])
        assert found.size == modes.size
        # Order of the entries is that of the search, but for ties in the last digits.
        distance = np.abs(found[:, None] - modes).min(axis=0)
        assert np.all(distance <= 2 * np.array(case[f"{parity}_errors"]))


@pytest.mark.parametrize("case", [REFERENCE[15]], ids=name)
def test_reference_file_is_reproduced(case):
    assert_reproduced(case)


@pytest.mark.soak
@EVERY
def test_whole_reference_file_is_reproduced(case):
    assert_reproduced(case)
