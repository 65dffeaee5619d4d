"""Neutral points against the reference, and the curve."""

from math import degrees, inf, isnan, nan, radians

import numpy as np
import pytest

from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.radial.solution import solve_radial
from hopper.von_mises import neutral_curve as module
from hopper.von_mises.growth import resolved_growth
from hopper.von_mises.neutral import neutral_point
from hopper.von_mises.neutral_curve import neutral_curve
from tests.von_mises.witnesses import REFERENCE, Shooting, cone


@pytest.mark.parametrize(
    "known", REFERENCE["neutral_points"], ids=lambda p: f"{p['half_angle']}-{p['delta']}"
)
def test_neutral_points_of_the_reference(known):
    found = point(known["half_angle"], known["phi"])
    error = abs(degrees(found.delta) - known["delta"])
    # The reference is a phi for a given delta, to 1e-10 deg; d delta/d phi is below 15.
    assert error < degrees(found.error_estimate) + 2e-9
    assert error < 1e-8
    assert found.error_estimate < radians(2e-8)
    assert found.frequency == pytest.approx(known["im"], abs=1e-7)
    assert found.settled


@pytest.mark.parametrize(
    ("half_angle", "delta"), [(5, 35.3004), (10, 35.4211), (20, 36.1929), (30, 41.7469)]
)
def test_neutral_points_of_smooth_walls(half_angle, delta):
    found = point(half_angle, 0.0)
    assert degrees(found.delta) == pytest.approx(delta, abs=5e-5)
    assert found.settled


def test_the_neutral_mode_by_shooting():
    found = point(10, 12.2)
    # Below the tangency delta is largest there.
    assert degrees(found.delta) == pytest.approx(43.359, abs=5e-4)
    solution = solve_radial(cone(degrees(found.delta), 10), radians(12.2))
    (root,) = Shooting(solution).roots([1j * found.frequency * (1 + 1e-7)])
    assert abs(root.real) < 1e-9


def test_stable_above_and_unstable_below():
    found = point(20, 5)
    growths = [
        resolved_growth(solve_radial(cone(degrees(found.delta) + step, 20), radians(5))).abscissa
        for step in (-1e-6, 1e-6)
    ]
    assert growths[0] > 0 > growths[1]


def test_a_mode_of_a_finer_mesh_is_neutral():
    # At rough walls the highest mode lies far up: Im = 179.06 against 2 pi / Phi = 11.7.
    found = point(10, 27, radians(40.1783))
    assert found.frequency == pytest.approx(179.055, abs=1e-3)
    assert found.settled


def test_a_neutral_strip_is_not_settled():
    found = point(10, 22, radians(42.48))
    assert isnan(found.frequency)
    assert not found.settled


def test_guesses_change_nothing():
    plain = point(10, 5)
    near = point(10, 4.9)
    for guess in (near.delta, plain.delta - 1e-2, radians(70)):
        again = point(10, 5, guess)
        assert again.delta == pytest.approx(
            plain.delta, abs=plain.error_estimate + again.error_estimate
        )


def test_curve_of_30_degrees_ends_at_tension():
    # Only phi up to about 1.3 deg has stable flows.
    curve = neutral_curve(radians(30), radians(0.65))
    assert np.all(np.diff(curve.delta) > 0)
    assert degrees(curve.delta[0]) == pytest.approx(41.7469, abs=5e-5)
    assert 57 < degrees(curve.delta[-1]) < 60
    assert 1.3 < degrees(curve.friction_angle[-1]) < 1.36
    assert np.all(curve.settled)
    assert np.all(curve.error_estimate < radians(1e-6))
    assert neutral_point(radians(30), radians(1.4)) is None


def test_curve_goes_through_the_points():
    curve = neutral_curve(radians(10), radians(2), highest=radians(6))
    np.testing.assert_allclose(np.degrees(curve.friction_angle), [0, 2, 4, 6])
    alone = point(10, 4)
    assert curve.delta[2] == pytest.approx(alone.delta, abs=2 * alone.error_estimate)
    assert curve.frequency[2] == pytest.approx(alone.frequency, abs=1e-7)


def test_corners_are_roots_of_two_modes():
    # From 14 to 15 deg the second complex mode takes over from the first.
    curve = neutral_curve(radians(10), radians(1), highest=radians(15))
    (corner,) = np.flatnonzero(np.abs(np.degrees(curve.friction_angle) % 1 - 0.5) < 0.499)
    delta, phi = curve.delta[corner], curve.friction_angle[corner]
    solution = solve_radial(cone(degrees(delta), 10), phi)
    roots = Shooting(solution).roots([21.77j, 58.195j])
    assert np.all(np.abs(roots.real) < 1e-6)
    # It does not depend on the steps.
    other = neutral_curve(radians(10), radians(2.1), highest=radians(16.8))
    assert np.min(np.abs(other.friction_angle - phi)) < 1e-7


def point(half_angle, phi, guess=None):
    """A neutral point that exists, angles in degrees."""
    found = neutral_point(radians(half_angle), radians(phi), guess)
    assert found is not None
    return found


def test_bad_input():
    with pytest.raises(InvalidParameterError, match="half_angle"):
        neutral_point(0.0, 0.1)
    with pytest.raises(InvalidParameterError, match="friction_angle"):
        neutral_point(radians(10), -0.1)
    for step in (0, -1, nan, inf):
        with pytest.raises(InvalidParameterError, match="must be a positive number"):
            neutral_curve(radians(10), step)


def test_cones_without_a_neutral_smooth_wall(monkeypatch):
    monkeypatch.setattr(module, "neutral_flow", lambda half_angle, phi: None)
    with pytest.raises(ConvergenceError, match="even for a smooth wall: lower half_angle"):
        neutral_curve(radians(80), 0.1)
