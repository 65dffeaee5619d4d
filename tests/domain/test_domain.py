"""Neutral points, tangency and other borders of the stable domain, each found a second way."""

from functools import lru_cache
from math import asin, atan, cos, degrees, inf, nan, pi, radians, sin, tan

import numpy as np
import pytest

from hopper import (
    Hopper,
    NeutralCurve,
    friction_limit,
    linear_stability,
    neutral_curve,
    neutral_delta,
    solve_radial,
)
from hopper.domain.borders import (
    borders,
    friction_reaching,
    singular_velocity_friction,
    stable_area,
    tangency_curve,
    tangency_friction,
)
from hopper.domain.neutral import NoNeutralPointError
from hopper.errors import InvalidParameterError, TangencyError
from tests.stability.witnesses import galerkin_modes, line_by_quadrature, wall_tangency_friction

MICRO = radians(1e-6)
CURVES = [("cone", 10), ("cone", 30), ("wedge", 10), ("wedge", 30)]


def make(geometry, delta, half_angle):
    return Hopper(geometry, radians(delta), radians(half_angle))


def abscissa(geometry, delta, half_angle, friction_angle):
    """Spectral abscissa; all angles in radians."""
    return linear_stability(
        solve_radial(Hopper(geometry, delta, half_angle), friction_angle)
    ).abscissa


def reaching(hopper, level):
    """Friction angle at which psi reaches a level that it does reach."""
    found = friction_reaching(hopper, level)
    assert found is not None
    return found


def tangent(hopper):
    return reaching(hopper, pi / 4 - hopper.delta / 2)


@lru_cache(maxsize=8)
def curve(geometry, half_angle, step=1.6):
    return neutral_curve(geometry, radians(half_angle), radians(step))


# Neutral points.


@pytest.mark.parametrize(("friction_angle", "delta"), [(0, 33.6739), (10, 26.1404)])
def test_known_neutral_points(friction_angle, delta):
    found = neutral_delta("cone", radians(10), radians(friction_angle))
    assert degrees(found) == pytest.approx(delta, abs=1e-4)


@pytest.mark.parametrize(
    ("geometry", "half_angle", "friction_angle"),
    [("cone", 10, 0), ("cone", 10, 10), ("cone", 30, 15), ("cone", 3, 12), ("wedge", 20, 7)],
)
def test_abscissa_changes_sign_at_the_neutral_point(geometry, half_angle, friction_angle):
    angles = radians(half_angle), radians(friction_angle)
    delta = neutral_delta(geometry, *angles)
    below, above = (
        solve_radial(Hopper(geometry, delta + shift, angles[0]), angles[1])
        for shift in (-MICRO, MICRO)
    )
    assert linear_stability(below).abscissa > 0 > linear_stability(above).abscissa
    # And so it does by quadrature and by a Galerkin method; rounding is 1e-4 of the change.
    signs = []
    for solution in (below, above):
        line, spacing = line_by_quadrature(solution)
        modes = galerkin_modes(solution, 40)
        modes = modes[np.abs(modes) < 6 * spacing]
        signs.append(max(line, modes.real.max()) > 0)
    assert signs == [True, False]


@pytest.mark.parametrize(("geometry", "s"), [("cone", 5 / 9), ("wedge", 2 / 3)])
def test_neutral_points_of_smooth_walls_tend_to_theory(geometry, s):
    wide, narrow = (degrees(neutral_delta(geometry, radians(angle), 0.0)) for angle in (1.0, 0.5))
    limit = (4 * narrow - wide) / 3
    assert abs(wide - narrow) > 1e-4
    # The next term is smaller by the square of the angle.
    assert abs(limit - degrees(asin(s))) < abs(wide - narrow) * radians(1) ** 2


def test_guesses_do_not_matter():
    exact = neutral_delta("cone", radians(10), radians(10))
    # Near, far, beyond the tangency, without a radial solution, out of range.
    for guess in (26.1, 33, 70, 11, 200):
        found = neutral_delta("cone", radians(10), radians(10), radians(guess))
        assert abs(found - exact) < 1e-9


@pytest.mark.parametrize(
    ("half_angle", "friction_angle"), [(10, 18.1), (10, 30), (30, 17.1), (2, 50)]
)
def test_no_neutral_point_beyond_the_tangency(half_angle, friction_angle):
    message = (
        rf"no neutral delta at phi = {friction_angle} deg, half_angle = {half_angle} deg: "
        "stability ends at the tangency before it is lost; lower the wall friction"
    )
    with pytest.raises(NoNeutralPointError, match=message) as told:
        neutral_delta("cone", radians(half_angle), radians(friction_angle))
    assert "\n" not in str(told.value)


def test_bad_neutral_points():
    for half_angle in (0, -0.1, 2, nan):
        with pytest.raises(InvalidParameterError, match=r"half_angle = .* is out of range"):
            neutral_delta("cone", half_angle, 0.1)
    for friction_angle in (-0.1, 2, nan, inf):
        with pytest.raises(InvalidParameterError, match=r"friction_angle = .* is out of range"):
            neutral_delta("cone", 0.1, friction_angle)
    with pytest.raises(InvalidParameterError, match="geometry = 'pyramid' is unknown"):
        neutral_delta("pyramid", 0.1, 0.1)  # type: ignore[arg-type]


# The neutral curve.


@pytest.mark.parametrize(("geometry", "half_angle"), CURVES)
def test_points_of_the_neutral_curve_are_roots(geometry, half_angle):
    found, angle = curve(geometry, half_angle), radians(half_angle)
    assert found.friction_angle[0] == 0
    assert found.delta[0] == neutral_delta(geometry, angle, 0.0)
    steps = np.diff(found.friction_angle)
    assert np.all((steps > 0) & (steps <= radians(1.6) * (1 + 1e-12)))
    # Slopes need room for a difference: not the last points, crowded at the tangency.
    for phi, delta in zip(found.friction_angle, found.delta, strict=True):
        value = abscissa(geometry, delta, angle, phi)
        try:
            slope = (abscissa(geometry, delta + MICRO, angle, phi) - value) / MICRO
        except TangencyError:
            continue
        assert slope < 0
        assert abs(value) < abs(slope) * MICRO


@pytest.mark.parametrize(("geometry", "half_angle"), CURVES)
def test_neutral_curve_ends_at_the_tangency(geometry, half_angle):
    found = curve(geometry, half_angle)
    hopper = Hopper(geometry, float(found.delta[-1]), radians(half_angle))
    gap = tangent(hopper) - found.friction_angle[-1]
    assert 0 <= gap < radians(1e-6)
    # Beyond its end no delta is neutral.
    with pytest.raises(NoNeutralPointError):
        neutral_delta(geometry, radians(half_angle), found.friction_angle[-1] + radians(1e-3))


def test_neutral_curve_does_not_depend_on_the_step():
    coarse, fine = curve("cone", 10, 3.2), curve("cone", 10)
    shared = [np.abs(fine.friction_angle - phi).argmin() for phi in coarse.friction_angle[:5]]
    np.testing.assert_allclose(fine.friction_angle[shared], coarse.friction_angle[:5], atol=1e-15)
    np.testing.assert_allclose(fine.delta[shared], coarse.delta[:5], rtol=0, atol=1e-9)
    assert abs(coarse.delta[-1] - fine.delta[-1]) < radians(1e-4)


@pytest.mark.parametrize(("size", "index"), [(5, [0, 2, 4]), (6, [0, 2, 4, 5]), (2, [0, 1])])
def test_thinned_curve(size, index):
    thinned = NeutralCurve(np.arange(size) / 10, np.arange(size) + 1.0).thinned()
    assert thinned.delta.tolist() == [i + 1 for i in index]
    assert thinned.friction_angle.tolist() == [i / 10 for i in index]


@pytest.mark.parametrize(("geometry", "half_angle"), CURVES)
def test_curve_and_tangency_enclose_the_stable_hoppers(geometry, half_angle):
    neutral = curve(geometry, half_angle)
    random = np.random.default_rng(4)
    checked: list[bool] = []
    while len(checked) < 40:
        delta, phi = np.radians(random.uniform([15, 0], [60, 20]))
        hopper = Hopper(geometry, delta, radians(half_angle))
        tangency = tangent(hopper)
        border = np.interp(phi, neutral.friction_angle, neutral.delta)
        if phi < tangency and phi < neutral.friction_angle[-1] and abs(delta - border) > 0.01:
            checked.append(bool(delta > border))
            assert linear_stability(solve_radial(hopper, phi)).stable == checked[-1]
    assert 5 < sum(checked) < 35


# Where psi reaches a level.


@pytest.mark.parametrize(
    ("delta", "mu"), [(15, 0.234), (25, 0.325), (30, 0.346), (35, 0.354), (45, 0.333), (80, 0.087)]
)
@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_tangency_at_the_wall(geometry, delta, mu):
    s, c = sin(radians(delta)), cos(radians(delta))
    hopper = make(geometry, delta, 10)
    found = tangent(hopper)
    assert found == tangency_friction(hopper)
    assert tan(found) == pytest.approx(mu, abs=5e-4)
    assert tan(found) == pytest.approx(s * c / (1 + s**2), rel=1e-12)
    assert wall_tangency_friction(hopper.delta) == pytest.approx(found, rel=1e-12)
    linear_stability(solve_radial(hopper, found * (1 - 1e-5)))
    with pytest.raises(TangencyError):
        linear_stability(solve_radial(hopper, found * (1 + 1e-9)))


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
    linear_stability(solve_radial(hopper, found * (1 - 1e-5)))
    with pytest.raises(TangencyError):
        linear_stability(solve_radial(hopper, found * (1 + 1e-7)))


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
    for geometry in 25 * ("wedge", "cone"):
        hopper = make(geometry, *random.uniform([15, 1], [60, 45]))
        found = tangency_friction(hopper)
        if found is None:
            continue
        theta, largest = solve_radial(hopper, found).psi_maximum()
        assert largest == pytest.approx(pi / 4 - hopper.delta / 2, abs=1e-9)
        assert found <= wall_tangency_friction(hopper.delta) + 1e-12
        inside += theta < 0.99 * hopper.half_angle
    assert inside > 5


def test_tangency_curve_marks_what_does_not_exist():
    deltas = np.radians([30, 40, 60])
    found = tangency_curve("cone", radians(70), deltas)
    assert found.shape == (3,)
    assert np.isnan(found).all()
    found = tangency_curve("wedge", radians(10), deltas)
    np.testing.assert_allclose(found, [wall_tangency_friction(d) for d in deltas], rtol=1e-12)


# Borders.


def test_borders_agree_with_what_they_are_made_of():
    deltas = [12, 20, 25, 30, 40, 55]
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


@pytest.mark.parametrize(("geometry", "delta"), [("cone", 20), ("wedge", 35)])
def test_branches_that_end_at_a_wall_as_rough_as_the_material(geometry, delta):
    found = borders(geometry, radians(10), [radians(delta)])
    assert found.end == ("wall",)
    assert degrees(found.limit[0]) == pytest.approx(delta, rel=1e-12)


def test_no_solution_even_for_a_smooth_wall():
    found = borders("cone", radians(70), np.radians([40, 15]))
    assert found.end == ("none", "wall")
    for values in (found.limit, found.limit_error, found.tangency, found.singular_velocity):
        assert np.isnan(values[0])
        assert np.isfinite(values[1])


# The area.


def test_area_of_a_polygon():
    # A trapezoid and a rectangle: (0.4, 0) (0.3, 0.1) (0.5, 0.2) (0.6, 0.2) (0.6, 0).
    neutral = NeutralCurve(np.array([0.0, 0.1]), np.array([0.4, 0.3]))
    deltas, tangency = [0.3, 0.5, 0.6], [0.1, 0.2, 0.2]
    expected = 0.5 * 0.2 * (0.1 + 0.2) + 0.1 * 0.2 - 0.5 * 0.1 * 0.1
    assert stable_area(neutral, deltas, tangency) == pytest.approx(expected, rel=1e-14)
    # Unknown beyond 0.5: closed there.
    assert stable_area(neutral, deltas, [0.1, 0.2, nan]) == pytest.approx(
        expected - 0.02, rel=1e-14
    )


def test_area_by_counting_stable_hoppers():
    neutral = curve("cone", 10)
    deltas = np.linspace(neutral.delta[-1], radians(60), 30)
    area = stable_area(neutral, deltas, tangency_curve("cone", radians(10), deltas))
    # Midpoints of strips in phi, from the neutral delta to that of the tangency or the edge.
    edges = np.linspace(0, radians(21), 2001)
    phi = (edges[1:] + edges[:-1]) / 2
    fine = np.linspace(radians(20), radians(60), 4001)
    wall = np.array([wall_tangency_friction(delta) for delta in fine])
    left = np.interp(phi, neutral.friction_angle, neutral.delta)
    inside = (fine > left[:, None]) & (wall > phi[:, None])
    end = neutral.friction_angle[-1]
    inside[phi > end] &= fine > neutral.delta[-1]
    counted = inside.sum() * (fine[1] - fine[0]) * (edges[1] - edges[0])
    # Chords of the curves: second order in 1.3 deg of delta.
    assert area == pytest.approx(counted, rel=2e-3)


@pytest.mark.parametrize("step", [0, -0.1, nan])
def test_bad_steps(step):
    with pytest.raises(InvalidParameterError, match="step = "):
        neutral_curve("cone", radians(10), step)
