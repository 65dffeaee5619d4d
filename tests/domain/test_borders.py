"""Borders of the stable domain, each found a second way."""

from math import atan, degrees, nan, pi, radians, tan

import numpy as np
import pytest

from hopper import Hopper, NeutralCurve, friction_limit, solve_radial
from hopper.domain.borders import (
    Borders,
    borders,
    friction_reaching,
    positive_stress_friction,
    singular_velocity_friction,
    stable_area,
    stable_outline,
    tangency_friction,
    traced_borders,
)
from hopper.errors import NonPositiveStressError
from tests.stability.witnesses import wall_tangency_friction


def make(geometry, delta, half_angle):
    return Hopper(geometry, radians(delta), radians(half_angle))


def reaching(hopper, level):
    """Friction angle at which psi reaches a level that it does reach."""
    found = friction_reaching(hopper, level)
    assert found is not None
    return found


# Where psi reaches a level.


@pytest.mark.parametrize(
    ("delta", "mu"), [(15, 0.234), (25, 0.325), (30, 0.346), (35, 0.354), (45, 0.333), (80, 0.087)]
)
@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_tangency_at_the_wall(geometry, delta, mu):
    hopper = make(geometry, delta, 10)
    found = reaching(hopper, pi / 4 - hopper.delta / 2)
    assert found == tangency_friction(hopper)
    assert tan(found) == pytest.approx(mu, abs=5e-4)
    assert found == pytest.approx(wall_tangency_friction(hopper.delta), rel=1e-12)


@pytest.mark.parametrize(("delta", "mu"), [(25, 0.3109606), (30, None), (50, None)])
def test_tangency_inside(delta, mu):
    hopper, level = make("cone", delta, 30), pi / 4 - radians(delta) / 2
    found = reaching(hopper, level)
    assert found == tangency_friction(hopper)
    if mu:
        assert tan(found) == pytest.approx(mu, abs=5e-8)
    assert found < wall_tangency_friction(hopper.delta) - radians(0.5)
    solution = solve_radial(hopper, found)
    theta, largest = solution.psi_maximum()
    assert largest == pytest.approx(level, abs=1e-10)
    assert radians(1) < theta < radians(29)
    # A maximum by other means: values of psi around it.
    around = solution.psi_at(np.linspace(0, hopper.half_angle, 20001))
    assert around.max() == pytest.approx(level, abs=1e-8)


@pytest.mark.parametrize(
    ("geometry", "delta"), [("wedge", 15), ("wedge", 30), ("wedge", 60), ("cone", 25)]
)
def test_singular_velocity_at_the_wall(geometry, delta):
    # psi_w = pi/4: tan(phi) = sin(delta).
    hopper = make(geometry, delta, 10)
    assert singular_velocity_friction(hopper) == pytest.approx(atan(hopper.s), rel=1e-12)


@pytest.mark.parametrize("level", [radians(20), radians(35), pi / 4])
def test_friction_reaching_a_level_inside(level):
    hopper = make("cone", 30, 30)
    found = reaching(hopper, level)
    assert solve_radial(hopper, found).psi_maximum()[1] == pytest.approx(level, abs=1e-10)
    assert found < friction_limit(hopper).friction_angle
    assert solve_radial(hopper, found * (1 - 1e-4)).psi_maximum()[1] < level


def test_levels_that_are_not_reached():
    # The fold comes first.
    hopper = make("cone", 40, 30)
    assert singular_velocity_friction(hopper) is None
    limit = friction_limit(hopper).friction_angle
    assert solve_radial(hopper, limit * (1 - 1e-9)).psi_maximum()[1] < radians(44)
    # The smooth wall is there already; no psi is as large; no solution at all.
    assert friction_reaching(hopper, -0.1) is None
    assert friction_reaching(hopper, 1.2) is None
    assert tangency_friction(make("cone", 40, 70)) is None
    # Stress is positive nowhere on the branch.
    assert tangency_friction(make("cone", 5, 30)) is None


@pytest.mark.parametrize(
    ("geometry", "delta", "half_angle"), [("cone", 7.09, 30), ("wedge", 6.541, 9.567)]
)
def test_tangency_just_where_stress_becomes_positive(geometry, delta, half_angle):
    hopper = make(geometry, delta, half_angle)
    expected = wall_tangency_friction(hopper.delta)
    assert 0 < 1 / solve_radial(hopper, expected).sigma_axis < 0.2
    assert tangency_friction(hopper) == pytest.approx(expected, rel=1e-12)


def test_tangency_of_random_hoppers():
    random = np.random.default_rng(8)
    inside = 0
    for geometry in 15 * ("wedge", "cone"):
        hopper = make(geometry, *random.uniform([15, 1], [60, 45]))
        found = tangency_friction(hopper)
        if found is None:
            continue
        theta, largest = solve_radial(hopper, found).psi_maximum()
        assert largest == pytest.approx(pi / 4 - hopper.delta / 2, abs=1e-9)
        assert found <= wall_tangency_friction(hopper.delta) + 1e-12
        inside += theta < 0.99 * hopper.half_angle
    assert inside > 3


@pytest.mark.parametrize(("delta", "half_angle"), [(12, 10), (16, 10), (13, 30), (17, 30)])
def test_stress_is_positive_above_its_border(delta, half_angle):
    """By the sign of 1 / sigma_0 on both sides."""
    wedge = make("wedge", delta, half_angle)
    least = positive_stress_friction(wedge)
    assert least is not None
    assert 0 < least < friction_limit(wedge).friction_angle
    assert solve_radial(wedge, least + 1e-6).sigma_axis > 1e3
    with pytest.raises(NonPositiveStressError, match=f"phi > {degrees(least):.6g} deg"):
        solve_radial(wedge, least - 1e-6)


def test_stress_that_no_wall_makes_positive():
    wedge = make("wedge", 12, 30)
    assert positive_stress_friction(wedge) is None
    with pytest.raises(NonPositiveStressError):
        solve_radial(wedge, 0.99 * friction_limit(wedge).friction_angle)


def test_stress_that_is_positive_from_the_smooth_wall_on():
    assert positive_stress_friction(make("cone", 35, 10)) == 0
    assert borders("wedge", radians(10), np.radians([15, 40])).positive_stress[1] == 0


# Borders over delta.


def test_borders_agree_with_what_they_are_made_of():
    deltas = [20, 25, 30, 40]
    found = borders("cone", radians(30), np.radians(deltas))
    for i, delta in enumerate(deltas):
        hopper = make("cone", delta, 30)
        limit = friction_limit(hopper)
        assert (found.limit[i], found.end[i]) == (limit.friction_angle, limit.end)
        assert found.limit_error[i] == limit.error_estimate
        assert found.tangency[i] == tangency_friction(hopper)
        singular = singular_velocity_friction(hopper)
        assert found.singular_velocity[i] == singular or (
            singular is None and np.isnan(found.singular_velocity[i])
        )
    np.testing.assert_array_equal(found.delta, np.radians(deltas))
    # tangency < singular velocity <= limit, as pi/4 - delta/2 < pi/4.
    known = np.isfinite(found.singular_velocity)
    assert np.all(found.tangency < found.limit)
    assert np.all(found.tangency[known] < found.singular_velocity[known])
    assert np.all(found.singular_velocity[known] <= found.limit[known])


@pytest.mark.parametrize(
    ("delta", "half_angle", "fold"),
    [(30, 10, 28.61), (30, 30, degrees(atan(0.3588))), (40, 30, 17.90)],
)
def test_known_folds(delta, half_angle, fold):
    found = borders("cone", radians(half_angle), [radians(delta)])
    assert found.end == ("fold",)
    # Two decimals, cut or rounded.
    assert degrees(found.limit[0]) == pytest.approx(fold, abs=0.01)


@pytest.mark.parametrize(
    ("geometry", "delta", "half_angle", "limit", "end"),
    [
        ("cone", 20, 10, 20, "wall"),
        ("cone", 25, 10, 25, "wall"),
        ("wedge", 35, 10, 35, "wall"),
        ("cone", 25, 30, None, "interior"),
        ("cone", 60, 10, None, "axis"),
    ],
)
def test_limits_told_apart(geometry, delta, half_angle, limit, end):
    found = borders(geometry, radians(half_angle), [radians(delta)])
    assert found.end == (end,)
    if limit:
        assert degrees(found.limit[0]) == pytest.approx(limit, rel=1e-12)


def test_no_solution_even_for_a_smooth_wall():
    found = borders("cone", radians(70), np.radians([40, 15]))
    assert found.end == ("none", "wall")
    for values in (found.limit, found.limit_error, found.tangency, found.singular_velocity):
        assert np.isnan(values[0])
        assert np.isfinite(values[1])


def test_folds_rise_or_fall_with_delta():
    """At 10 degrees the fold rises with delta, at 30 it falls."""
    deltas = np.radians([35, 45, 55])
    for half_angle, sign in ((10, 1), (30, -1)):
        assert np.all(sign * np.diff(borders("cone", radians(half_angle), deltas).limit) > 0)


@pytest.mark.parametrize(("size", "index"), [(5, [0, 2, 4]), (6, [1, 3, 5]), (2, [1]), (1, [0])])
def test_thinned_borders(size, index):
    arrays = [np.arange(size) + i / 10 for i in range(6)]
    ends = tuple(f"end {i}" for i in range(size))
    delta, limit, error, *levels = arrays
    thinned = Borders(delta, limit, error, ends, *levels).thinned()
    kept = [thinned.delta, thinned.limit, thinned.limit_error, thinned.tangency]
    kept += [thinned.singular_velocity, thinned.positive_stress]
    for array, found in zip(arrays, kept, strict=True):
        np.testing.assert_array_equal(found, array[index])
    assert thinned.end == tuple(ends[i] for i in index)


# The area.


def by_hand(singular):
    """A neutral curve and borders of straight lines."""
    curve = NeutralCurve(
        np.array([0.0, 0.1]), np.array([0.4, 0.3]), ("line", "line"), (None, None), "fold"
    )
    deltas, limit = np.array([0.2, 0.5, 0.6]), np.array([0.1, 0.2, 0.2])
    return curve, Borders(
        deltas, limit, 0 * limit, 3 * ("fold",), limit / 2, np.array(singular), 0 * limit
    )


def test_outline_and_area_of_a_polygon():
    curve, found = by_hand([nan, nan, nan])
    delta, phi = stable_outline(curve, found)
    np.testing.assert_array_equal(delta, [0.4, 0.3, 0.5, 0.6, 0.6, 0.4])
    np.testing.assert_array_equal(phi, [0, 0.1, 0.2, 0.2, 0, 0])
    expected = 0.5 * 0.2 * (0.1 + 0.2) + 0.1 * 0.2 - 0.5 * 0.1 * 0.1
    area, reached = stable_area(curve, found)
    assert area == pytest.approx(expected, rel=1e-14)
    assert reached == pytest.approx(expected, rel=1e-14)


def test_area_that_radial_flow_reaches():
    # psi reaches pi/4 at phi = 0.15 everywhere: the strip above is left out at its corners.
    curve, found = by_hand([0.15, 0.15, 0.15])
    area, reached = stable_area(curve, found)
    assert area == stable_area(*by_hand([nan, nan, nan]))[0]
    # Corners at delta = 0.5 and 0.6 lie at the level: chord from (0.3, 0.1) to (0.5, 0.15).
    expected = 0.5 * 0.2 * (0.1 + 0.15) + 0.1 * 0.15 - 0.5 * 0.1 * 0.1
    assert reached == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("geometry", ["cone"])
def test_traced_borders_have_no_corner_between_their_points(geometry):
    """A limit over an even grid is off by degrees where a fold takes over, traced by 0.05."""
    even = np.radians(np.linspace(23, 29, 7))
    traced = traced_borders(geometry, radians(30), even, radians(0.03))
    assert set(even) <= set(traced.delta)
    assert np.all(np.diff(traced.delta) > 0)
    assert len(traced.end) == traced.delta.size
    between = np.radians([24.6, 24.9, 25.3, 26.6])
    exact = borders(geometry, radians(30), between).limit
    drawn = np.interp(between, traced.delta, traced.limit)
    assert np.degrees(np.abs(drawn - exact)).max() < 0.05


def test_traced_borders_of_no_delta_are_empty():
    assert traced_borders("cone", radians(30), [], radians(0.03)).limit.size == 0
