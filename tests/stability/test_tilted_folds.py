"""Folds, corners and neutral points by shooting, against the package's folds and known values."""

from dataclasses import replace
from functools import lru_cache
from math import degrees, exp, log, radians

import pytest
from scipy.optimize import brentq

from hopper.problem import Hopper
from hopper.radial.friction_limit import friction_limit
from hopper.radial.mass_flow import mass_flow_friction_angle
from hopper.radial.solution import solve_radial_family
from tests.stability.tilted_chebyshev import staggered_modes
from tests.stability.tilted_data import radial, read
from tests.stability.tilted_folds import (
    at_zero,
    corner,
    fold,
    neutral,
    positive_real_modes,
    psi_wall_slope,
    wall_friction,
)
from tests.stability.tilted_line import line_along
from tests.stability.tilted_witnesses import Base, contour, to_wall

# delta, half angle: folds of stable hoppers and of unstable ones, thin layers at the axis.
SOME = [(28, 30), (45, 20)]
MORE = [(35, 30), (35, 10), (30, 10), (40, 5)]
FOLDS = SOME + [pytest.param(*hopper, marks=pytest.mark.soak) for hopper in MORE]


def cone(delta, half_angle):
    return Hopper("cone", radians(delta), radians(half_angle))


# The first fold of each family of the file: the one that limits the friction.
FIRST = {
    (f["delta_deg"], f["half_angle_deg"]): f for f in reversed(read("tilted_reference", "folds"))
}
KNOWN = list(FIRST.values())


def label(known):
    return f"{known['delta_deg']}-{known['half_angle_deg']}"


@pytest.mark.parametrize("known", KNOWN, ids=label)
def test_lambda_is_zero_at_the_folds_of_the_package(known):
    limit = friction_limit(cone(known["delta_deg"], known["half_angle_deg"]))
    assert limit.end == "fold"
    # phi is stationary in sigma_0, which has half of its digits.
    phi = radians(known["phi_deg"])
    assert limit.friction_angle == pytest.approx(phi, abs=1e-13 + 10 * limit.error_estimate)
    assert known["sigma_axis"] * limit.tau == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize(
    "known", KNOWN[::6], ids=lambda f: f"{f['delta_deg']}-{f['half_angle_deg']}"
)
def test_folds_of_the_file_are_reproduced(known):
    hopper = cone(known["delta_deg"], known["half_angle_deg"])
    found = fold(hopper, 1.02 * known["sigma_axis"])
    assert found.sigma_axis == pytest.approx(known["sigma_axis"], rel=1e-8)
    assert degrees(wall_friction(found)) == pytest.approx(known["phi_deg"], abs=1e-9)


@pytest.mark.parametrize(("delta", "half_angle"), FOLDS)
@pytest.mark.parametrize("factor", [0.8, pytest.param(1.5, marks=pytest.mark.soak)])
def test_residual_at_zero_is_the_slope_of_the_family(delta, half_angle, factor):
    """On both sides of the fold: d psi_w / d log sigma_0 = sigma_0 D(0), as sigma1(0) = 1."""
    hopper = cone(delta, half_angle)
    member = Base(hopper, factor / friction_limit(hopper).tau)
    assert psi_wall_slope(member) == pytest.approx(
        member.sigma_axis * at_zero(member)[0], abs=1e-11
    )


@pytest.mark.parametrize(("delta", "half_angle"), FOLDS)
def test_a_real_mode_changes_sign_at_the_fold(delta, half_angle):
    """Before it the number of positive ones is even, beyond it odd."""
    hopper = cone(delta, half_angle)
    limit = friction_limit(hopper)
    before, beyond = (Base(hopper, exp(shift) / limit.tau) for shift in (0.02, -0.02))
    assert wall_friction(before) < limit.friction_angle > wall_friction(beyond)
    assert positive_real_modes(before).size % 2 == 0
    assert positive_real_modes(beyond).size % 2 == 1


@pytest.mark.soak
def test_a_family_that_folds_twice():
    """Cone 30/45: three solutions between the second fold and the mass-flow limit."""
    second = fold(cone(30, 45), 0.0135)
    around = [solve_radial_family(second.hopper, second.sigma_axis * f) for f in (0.99, 1, 1.01)]
    below, at, above = (solution.friction_angle for solution in around)
    assert below > at < above
    assert wall_friction(second) == pytest.approx(at, abs=1e-11)
    # The smallest of a parabola through three points, of the package alone.
    smallest = at - (above - below) ** 2 / 8 / (above - 2 * at + below)
    assert at == pytest.approx(smallest, abs=1e-11)
    assert at < mass_flow_friction_angle(second.hopper)
    before, beyond = (Base(second.hopper, second.sigma_axis * f) for f in (1.05, 0.95))
    assert positive_real_modes(before).size == 1
    assert positive_real_modes(beyond).size == 2


def test_modes_on_arrival_at_the_fold():
    """A complex pair has crossed before (28/30), or becomes two real modes on its way (35/30)."""
    assert positive_real_modes(fold(cone(28, 30), 0.064)) == pytest.approx([1.658], abs=5e-4)
    stable = fold(cone(35, 30), 0.037)
    assert degrees(wall_friction(stable)) == pytest.approx(18.684202, abs=6e-7)
    assert positive_real_modes(stable).size == 0


CORNERS = {corner["half_angle_deg"]: corner for corner in read("tilted_reference", "corners")}
SOME_CORNERS = [
    pytest.param(angle, marks=[] if angle == 30 else pytest.mark.soak) for angle in CORNERS
]


@lru_cache(maxsize=8)
def found_corner(half_angle):
    known = CORNERS[half_angle]
    return corner(half_angle, known["delta_deg"] + 0.05, 1.01 * known["sigma_axis"])


def test_corners_found_elsewhere():
    """At 10 degrees with six digits, by collocation."""
    known = CORNERS[10]
    assert (known["delta_deg"], known["phi_deg"]) == pytest.approx((29.5579, 28.4171), abs=6e-5)


@pytest.mark.parametrize("half_angle", SOME_CORNERS)
def test_corner_of_the_stable_domain(half_angle):
    """Two equations by shooting; again as a root of D'(0) along the folds of the package."""
    known, (delta, phi, member) = CORNERS[half_angle], found_corner(half_angle)
    assert (delta, phi) == pytest.approx((known["delta_deg"], known["phi_deg"]), abs=1e-9)
    radial_solution = solve_radial_family(member.hopper, member.sigma_axis)
    assert degrees(radial_solution.friction_angle) == pytest.approx(phi, abs=1e-9)

    def derivative(delta):
        hopper = cone(delta, half_angle)
        return at_zero(Base(hopper, 1 / friction_limit(hopper).tau))[1]

    again = brentq(derivative, delta - 0.02, delta + 0.02, xtol=1e-9)
    # The package locates folds to about 1e-7 in log sigma_0, which D'(0) depends on.
    assert again == pytest.approx(delta, abs=5e-6)
    limit = friction_limit(cone(again, half_angle))
    assert degrees(limit.friction_angle) == pytest.approx(phi, abs=5e-6)


@pytest.mark.parametrize("half_angle", SOME_CORNERS)
def test_corner_is_a_double_zero_and_all_else_is_stable(half_angle):
    member = found_corner(half_angle)[2]
    line, spacing = line_along(member)
    assert line < 0
    # A double zero splits by the root of rounding; nothing else right of Re = -0.5.
    top = 4.3 * spacing
    assert contour(member, complex(-0.5, -top), complex(40, top))[0] == 2
    small = to_wall(member, [1e-3, 2e-3]).psi1
    assert log(abs(small[1] / small[0])) / log(2) == pytest.approx(2, abs=0.01)


def wall(point):
    return f"{point['geometry']}-{point['half_angle']}-phi={point['phi']}"


POINTS = read("neutral_points", "points")
SOAKED = [pytest.param(point, marks=pytest.mark.soak) for point in POINTS[:4]]


@pytest.mark.parametrize("point", [*POINTS[4:], *SOAKED], ids=wall)
def test_neutral_points(point):
    """From 0.05 degrees off; and no other mode of this parity is to the right, nor is the line."""
    parity, known, half_angle = (
        point["disturbance"],
        point["delta_neutral_deg"],
        point["half_angle"],
    )
    off = {"delta_deg": known + 0.05, "half_angle_deg": half_angle, "phi_deg": point["phi"]}
    start = radial({"geometry": point["geometry"], **off})
    leading = max(staggered_modes(start, 32, parity)[:4], key=lambda mode: mode.real)
    begin = known + 0.05, start.sigma_axis, leading.imag
    delta, _, sigma_axis = neutral(point["geometry"], half_angle, point["phi"], begin, parity)
    assert delta == pytest.approx(known, abs=point["tolerance_deg"])
    assert line_along(Base(replace(start.hopper, delta=radians(delta)), sigma_axis))[0] < 0
    lowest = staggered_modes(
        radial({"geometry": point["geometry"], **off, "delta_deg": delta}), 48, parity
    )[:5]
    assert lowest.real.max() == pytest.approx(0, abs=1e-8)
