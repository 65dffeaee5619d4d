"""Neutral points and stable intervals of internal friction, each found a second way."""

from functools import cache
from math import asin, degrees, inf, nan, radians

import numpy as np
import pytest

from hopper import Hopper, friction_limit, linear_stability, neutral_delta, solve_radial
from hopper.domain.neutral_points import NoNeutralPointError, stable_deltas
from hopper.errors import InvalidParameterError, NoRadialSolutionError
from tests.stability.tilted_chebyshev import staggered_modes
from tests.stability.tilted_data import read
from tests.stability.tilted_line import line_by_quadrature

MICRO = radians(1e-6)
POINTS = read("neutral_points", "points")


def wall(point):
    return f"{point['geometry']}-{point['half_angle']}-{point['phi']}-{point['disturbance']}"


def disturbances(point):
    return "symmetric" if point["disturbance"] == "symmetric" else "any"


@pytest.mark.parametrize("point", POINTS, ids=wall)
def test_known_neutral_points(point):
    """From a guess, by the secant method; to the tolerance of the reference and of the root."""
    known = radians(point["delta_neutral_deg"])
    found = neutral_delta(
        point["geometry"],
        radians(point["half_angle"]),
        radians(point["phi"]),
        known + radians(0.1),
        disturbances(point),
    )
    assert degrees(found) == pytest.approx(degrees(known), abs=point["tolerance_deg"])


@cache
def stable(geometry, half_angle, friction_angle, disturbances=None):
    """By a scan in large steps; degrees."""
    angles = radians(half_angle), radians(friction_angle)
    return stable_deltas(geometry, *angles, disturbances, step=radians(4))


@pytest.mark.parametrize("point", [POINTS[2], POINTS[4]], ids=wall)
def test_neutral_points_by_scanning(point):
    found = stable(point["geometry"], point["half_angle"], point["phi"], disturbances(point))
    (delta,) = found.neutral
    assert degrees(delta) == pytest.approx(point["delta_neutral_deg"], abs=1e-8)
    assert found.intervals[0].lower == delta
    assert found.intervals[0].lower_end == "neutral"


@pytest.mark.parametrize(("friction_angle", "delta"), [(0, 33.6739), (10, 26.1404)])
def test_neutral_points_before_the_tangency(friction_angle, delta):
    found = neutral_delta("cone", radians(10), radians(friction_angle), radians(delta + 0.3))
    assert degrees(found) == pytest.approx(delta, abs=5e-5)


@pytest.mark.parametrize(
    ("geometry", "half_angle", "friction_angle", "guess"),
    [("cone", 10, 25, 27), ("cone", 3, 12, 25), ("wedge", 20, 7, 42), ("wedge", 10, 30, 38)],
)
def test_abscissa_changes_sign_at_the_neutral_point(geometry, half_angle, friction_angle, guess):
    angles = radians(half_angle), radians(friction_angle)
    delta = neutral_delta(geometry, *angles, radians(guess))
    below, above = (
        solve_radial(Hopper(geometry, delta + shift, angles[0]), angles[1])
        for shift in (-MICRO, MICRO)
    )
    assert linear_stability(below).abscissa > 0 > linear_stability(above).abscissa
    # And so it does by quadrature and by staggered points; rounding is 1e-4 of the change.
    signs = []
    for solution in (below, above):
        line, spacing = line_by_quadrature(solution)
        parities = ["symmetric", "asymmetric"] if geometry == "wedge" else ["symmetric"]
        modes = np.concatenate([staggered_modes(solution, 48, parity) for parity in parities])
        modes = modes[np.abs(modes) < 6 * spacing]
        signs.append(max(line, modes.real.max()) > 0)
    assert signs == [True, False]


@pytest.mark.parametrize(
    ("geometry", "disturbances", "s"),
    [("cone", "symmetric", 5 / 9), ("wedge", "symmetric", 2 / 3), ("wedge", "any", 2 / 3)],
)
def test_neutral_points_of_smooth_walls_tend_to_theory(geometry, disturbances, s):
    theory = asin(s)
    wide, narrow = (
        degrees(neutral_delta(geometry, radians(angle), 0.0, theory, disturbances))
        for angle in (1.0, 0.5)
    )
    limit = (4 * narrow - wide) / 3
    assert abs(wide - narrow) > 1e-4
    # The next term is smaller by the square of the angle.
    assert abs(limit - degrees(theory)) < abs(wide - narrow) * radians(1) ** 2


def test_guesses_do_not_matter():
    exact = neutral_delta("cone", radians(10), radians(10), radians(26.1))
    # Far, without a radial solution, out of range.
    for guess in (33, 200):
        found = neutral_delta("cone", radians(10), radians(10), radians(guess))
        assert abs(found - exact) < 1e-9


# Stable intervals.


def test_interval_between_a_neutral_point_and_a_fold():
    found = stable("cone", 30, 18.5, "symmetric")
    (interval,) = found.intervals
    assert (interval.lower_end, interval.upper_end) == ("neutral", "fold")
    # The fold of the last hopper is at this friction.
    limit = friction_limit(Hopper("cone", interval.upper, radians(30)))
    assert limit.end == "fold"
    assert limit.friction_angle == pytest.approx(radians(18.5), abs=1e-11)
    inside = np.linspace(interval.lower, interval.upper, 6)[1:-1]
    for delta in inside:
        assert linear_stability(
            solve_radial(Hopper("cone", delta, radians(30)), radians(18.5))
        ).stable


def test_stable_from_the_first_solution_on():
    found = stable("cone", 10, 30)
    assert found.neutral == ()
    (interval,) = found.intervals
    assert (interval.lower_end, interval.upper_end) == ("fold", "steepest_looked_at")
    limit = friction_limit(Hopper("cone", interval.lower, radians(10)))
    assert limit.friction_angle == pytest.approx(radians(30), abs=1e-11)
    assert interval.upper == radians(89)
    with pytest.raises(
        NoNeutralPointError, match=r"no neutral delta at phi = 30 deg.* stable from"
    ):
        neutral_delta("cone", radians(10), radians(30))


def test_unstable_strip_under_a_wall_as_rough_as_the_material():
    """In wedges Lambda rises to infinity there, so the interval begins at a neutral point."""
    found = stable("wedge", 10, 44)
    assert [interval.lower_end for interval in found.intervals] == ["neutral"]
    (delta,) = found.neutral
    for share in (0.05, 0.9):
        hopper = Hopper("wedge", radians(44) + share * (delta - radians(44)), radians(10))
        assert not linear_stability(solve_radial(hopper, radians(44))).stable


def test_no_hopper_with_a_solution():
    with pytest.raises(NoRadialSolutionError, match="at phi = 88 deg: lower the wall friction"):
        stable_deltas("cone", radians(60), radians(88))


def test_no_stable_interval():
    found = stable("cone", 50, 7)
    assert found.neutral == found.intervals == ()


@pytest.mark.soak
def test_no_stable_hopper():
    """Above the corner of so wide a cone the neutral curve has ended."""
    with pytest.raises(NoNeutralPointError, match="no hopper is stable; change the wall friction"):
        neutral_delta("cone", radians(50), radians(7))


def test_bad_neutral_points():
    for half_angle in (0, -0.1, 2, nan):
        with pytest.raises(InvalidParameterError, match=r"half_angle = .* is out of range"):
            neutral_delta("cone", half_angle, 0.1)
    for friction_angle in (-0.1, 2, nan, inf):
        with pytest.raises(InvalidParameterError, match=r"friction_angle = .* is out of range"):
            neutral_delta("cone", 0.1, friction_angle)
        with pytest.raises(InvalidParameterError, match=r"friction_angle = .* is out of range"):
            stable_deltas("cone", 0.1, friction_angle)
    with pytest.raises(InvalidParameterError, match="geometry = 'pyramid' is unknown"):
        neutral_delta("pyramid", 0.1, 0.1)  # type: ignore[arg-type]
    with pytest.raises(InvalidParameterError, match="singular at the apex of a cone"):
        neutral_delta("cone", 0.1, 0.1, disturbances="any")
