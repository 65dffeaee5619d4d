"""The neutral curve: its points, its end on the fold in a corner, what is stable beside it."""

from functools import cache
from math import degrees, nan, radians

import numpy as np
import pytest

from hopper import (
    Hopper,
    HopperError,
    NeutralCurve,
    friction_limit,
    linear_stability,
    neutral_curve,
    neutral_delta,
    solve_radial,
)
from hopper.domain.borders import borders, stable_area, stable_outline
from hopper.domain.neutral_curve import corner
from hopper.errors import InvalidParameterError
from tests.stability.tilted_data import read

MICRO = radians(1e-6)
CORNERS = {known["half_angle_deg"]: known for known in read("tilted_reference", "corners")}
CURVES = [
    ("cone", 10),
    ("wedge", 10),
    pytest.param("cone", 30, marks=pytest.mark.soak),
    pytest.param("wedge", 30, marks=pytest.mark.soak),
]
EVERY = pytest.mark.parametrize(("geometry", "half_angle"), CURVES)


@cache
def curve(geometry, half_angle, step=3.2):
    return neutral_curve(geometry, radians(half_angle), radians(step))


def abscissa(geometry, delta, half_angle, friction_angle):
    """Spectral abscissa; all angles in radians."""
    hopper = Hopper(geometry, delta, half_angle)
    return linear_stability(solve_radial(hopper, friction_angle)).abscissa


@EVERY
def test_points_of_the_neutral_curve_are_roots(geometry, half_angle):
    found, angle = curve(geometry, half_angle), radians(half_angle)
    assert found.friction_angle[0] == 0
    guess = found.delta[0] + radians(0.1)
    assert found.delta[0] == pytest.approx(neutral_delta(geometry, angle, 0.0, guess), abs=1e-11)
    assert np.all(np.diff(found.friction_angle) <= radians(3.2) * (1 + 1e-12))
    # By phi: near the fold, where Re(lambda) goes with the root of the distance, by the corner.
    known = slice(1, None if found.end == "largest_delta" else 6, 2)
    for phi, delta in zip(found.friction_angle[known], found.delta[known], strict=True):
        value, beyond = (abscissa(geometry, delta + shift, angle, phi) for shift in (0, MICRO))
        assert abs(value) < abs(beyond - value)


@EVERY
def test_what_is_neutral_along_the_curve(geometry, half_angle):
    found = curve(geometry, half_angle)
    assert len(found.governed_by) == len(found.parity) == found.delta.size
    for i in (0, found.delta.size // 3):
        hopper = Hopper(geometry, float(found.delta[i]), radians(half_angle))
        result = linear_stability(solve_radial(hopper, float(found.friction_angle[i])))
        assert (result.governed_by, result.parity) == (found.governed_by[i], found.parity[i])
    for governor, parity in zip(found.governed_by, found.parity, strict=True):
        assert (parity is None) == (governor == "line")
    if geometry == "wedge":
        assert "asymmetric" in found.parity


@pytest.mark.parametrize(
    "half_angle", [10, *(pytest.param(a, marks=pytest.mark.soak) for a in CORNERS if a != 10)]
)
def test_curve_of_a_cone_ends_on_the_fold_in_the_corner(half_angle):
    found, known = curve("cone", half_angle), CORNERS[half_angle]
    at = corner(found)
    assert at is not None
    assert found.end == "fold"
    assert at == (found.delta[-1], found.friction_angle[-1])
    # By two equations of shooting; 1e-6 degrees.
    assert degrees(at[0]) == pytest.approx(known["delta_deg"], abs=1e-6)
    assert degrees(at[1]) == pytest.approx(known["phi_deg"], abs=1e-6)
    limit = friction_limit(Hopper("cone", at[0], radians(half_angle)))
    assert limit.end == "fold"
    assert at[1] == pytest.approx(limit.friction_angle, abs=1e-11)


@pytest.mark.parametrize("half_angle", [10, 30])
def test_curve_of_a_wedge_goes_on_as_far_as_one_looks(half_angle):
    found = curve("wedge", half_angle)
    assert found.end == "largest_delta"
    assert corner(found) is None
    assert found.delta[-1] == pytest.approx(radians(60), abs=1e-12)
    # Below the limit phi = delta there is always an unstable strip.
    assert np.all(found.friction_angle < found.delta)


def test_curve_does_not_depend_on_the_step():
    coarse, fine = curve("wedge", 10, 6.4), curve("wedge", 10)
    for phi, delta in zip(coarse.friction_angle[:5], coarse.delta[:5], strict=True):
        nearest = np.abs(fine.friction_angle - phi).argmin()
        assert fine.friction_angle[nearest] == pytest.approx(phi, abs=1e-12)
        assert fine.delta[nearest] == pytest.approx(delta, abs=1e-9)


def test_curve_up_to_a_given_delta():
    found = neutral_curve("wedge", radians(10), radians(6), largest_delta=radians(43))
    assert found.end == "largest_delta"
    assert found.delta[-1] == pytest.approx(radians(43), abs=1e-12)
    assert abs(abscissa("wedge", radians(43), radians(10), found.friction_angle[-1])) < 1e-8


def test_symmetric_disturbances_only():
    found = neutral_curve("wedge", radians(10), radians(8), radians(45), "symmetric")
    assert set(found.parity) <= {"symmetric", None}
    # phi = 25: the published neutral point of symmetric disturbances.
    guess = float(found.first_delta(radians(25)))
    assert degrees(guess) == pytest.approx(37.2735, abs=0.2)
    assert np.all(found.delta[:1] < curve("wedge", 10).delta[0])


def by_hand(size):
    points = np.arange(size) / 10, np.arange(size) + 1.0
    governed = tuple("line" if i % 2 else "complex mode" for i in range(size))
    parity = tuple(None if i % 2 else "symmetric" for i in range(size))
    return NeutralCurve(*points, governed, parity, "fold")  # type: ignore[arg-type]


@pytest.mark.parametrize(("size", "index"), [(5, [0, 2, 4]), (6, [0, 2, 4, 5]), (2, [0, 1])])
def test_thinned_curve(size, index):
    whole = by_hand(size)
    thinned = whole.thinned()
    assert thinned.delta.tolist() == [i + 1 for i in index]
    assert thinned.friction_angle.tolist() == [i / 10 for i in index]
    assert thinned.governed_by == tuple(whole.governed_by[i] for i in index)
    assert thinned.parity == tuple(whole.parity[i] for i in index)
    assert thinned.end == "fold"


def test_first_delta_at_a_friction():
    # Near the corner phi turns back: only what rises is a function of phi.
    curve = NeutralCurve(
        np.array([0, 0.1, 0.3, 0.25]), np.array([4.0, 3, 2, 5]), 4 * ("line",), 4 * (None,), "fold"
    )
    found = curve.first_delta([0, 0.05, 0.2, 0.3, 0.31])
    np.testing.assert_allclose(found, [4, 3.5, 2.5, 2, np.nan])


# The stable domain.


@pytest.mark.parametrize(("geometry", "half_angle"), CURVES[:3])
def test_outline_encloses_the_stable_hoppers(geometry, half_angle):
    """Single hoppers on either side of the polygon, not too close to its chords."""
    delta, phi = stable_outline(curve(geometry, half_angle), found_borders(geometry, half_angle))
    random = np.random.default_rng(4)
    checked: list[bool] = []
    while len(checked) < 25:
        place = np.radians(random.uniform([20, 0], [60, 35]))
        inside = [winds(delta, phi, place + shift) for shift in 0.01 * np.array(AROUND)]
        if any(inside) != all(inside):
            continue
        try:
            hopper = Hopper(geometry, place[0], radians(half_angle))
            stable = linear_stability(solve_radial(hopper, place[1])).stable
        except HopperError:
            stable = False
        assert stable == inside[0], np.degrees(place)
        checked.append(stable)
    assert 5 < sum(checked) < 24


AROUND = [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)]


def winds(x, y, place):
    """Whether a polygon encloses a place, by its winding number."""
    z = (x - place[0]) + 1j * (y - place[1])
    turn = np.angle(np.roll(z, -1) / np.where(z == 0, 1, z)).sum()
    return abs(turn) > np.pi


@cache
def found_borders(geometry, half_angle):
    start = curve(geometry, half_angle).delta[-1]
    return borders(geometry, radians(half_angle), np.linspace(start, radians(60), 12))


def test_area_by_counting_stable_hoppers():
    neutral, found = curve("cone", 10), found_borders("cone", 10)
    area, reached = stable_area(neutral, found)
    # Strips of phi from the curve or the fold to the fold or the edge, by the polygon's winding.
    grid = np.array([(x, y) for x in np.linspace(0.4, 1.05, 60) for y in np.linspace(0, 0.65, 60)])
    delta, phi = stable_outline(neutral, found)
    counted = sum(winds(delta, phi, place) for place in grid) * (0.65 / 59) * (0.65 / 59)
    assert area == pytest.approx(counted, rel=0.02)
    assert 0 < reached <= area


@pytest.mark.parametrize("step", [0, -0.1, nan])
def test_bad_steps(step):
    with pytest.raises(InvalidParameterError, match="step = "):
        neutral_curve("cone", radians(10), step)


def test_cones_know_symmetric_disturbances_only():
    with pytest.raises(InvalidParameterError, match="singular at the apex of a cone"):
        neutral_curve("cone", radians(10), 0.1, disturbances="any")
