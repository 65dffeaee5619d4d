"""How wide a hopper may be and its outlet must be, against formulas and worked examples."""

from functools import lru_cache
from math import acos, asin, degrees, pi, radians, sin

import numpy as np
import pytest

from hopper.design.design import Demand, design
from hopper.design.half_angles import half_angles
from hopper.design.material import Material
from hopper.design.outlet import (
    critical_stress,
    flow_function,
    linear_flow_function,
    smallest_outlet,
)
from hopper.errors import HopperError, InvalidParameterError, NoRadialSolutionError
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.flow_factor import flow_factor
from hopper.radial.friction_limit import friction_limit
from hopper.radial.solution import solve_radial
from hopper.stability.modes import linear_stability
from hopper.yield_conditions import VON_MISES

MARGIN = radians(3)


def material(geometry, delta, phi):
    return Material(geometry, radians(delta), radians(phi))


def known(found):
    """Return a quantity that exists."""
    assert found is not None
    return found


@lru_cache
def angles_of(geometry, delta, phi):
    return half_angles(material(geometry, delta, phi))


def arnold(delta, phi):
    """Half angle (radians) of mass flow in cones [Arnold, McLean, Roberts, Bulk Solids, 1980]."""
    s = sin(delta)
    return pi / 2 - acos((1 - s) / (2 * s)) / 2 - (phi + asin(sin(phi) / s)) / 2


@pytest.mark.parametrize(("delta", "phi"), [(38, 14), (40, 16), (60, 20), (30, 5), (50, 30)])
def test_classical_limit_of_cones_against_the_published_formula(delta, phi):
    found = known(angles_of("cone", delta, phi).classical)
    expected = arnold(radians(delta), radians(phi))
    assert abs(found.value - expected) <= found.error + 1e-15


def test_the_published_example_of_the_classical_limit():
    assert degrees(arnold(radians(38), radians(14))) == pytest.approx(35.52, abs=0.005)


@pytest.mark.parametrize(
    ("delta", "phi"), [(38, 14), (40, 16), (32, 5), pytest.param(25, 20, marks=pytest.mark.soak)]
)
def test_limit_of_friction_is_that_of_the_hopper_as_wide(delta, phi):
    """The other way round: at that half angle the largest wall friction is the wall's."""
    found = known(angles_of("cone", delta, phi).limit)
    hopper = Hopper("cone", radians(delta), found.value)
    assert abs(friction_limit(hopper).friction_angle - radians(phi)) < 1e-8
    with pytest.raises(NoRadialSolutionError):
        solve_radial(Hopper("cone", radians(delta), found.value + 1e-6), radians(phi))


@pytest.mark.parametrize(("delta", "phi"), [(45, 20), (60, 0), (50, 10)])
def test_stability_of_wedges_changes_at_the_limit(delta, phi):
    found = angles_of("wedge", delta, phi)
    around = [
        linear_stability(
            solve_radial(Hopper("wedge", radians(delta), angle), radians(phi))
        ).abscissa
        for angle in (known(found.stability).value + side for side in (-1e-6, 1e-6))
    ]
    assert around[0] < 0 < around[1]
    assert found.limit is None
    assert "limit: radial solutions exist at every half angle" in found.notes


def test_velocity_limit_of_wedges_is_where_psi_reaches_45_degrees():
    found = known(angles_of("wedge", 45, 20).velocity)
    solution = solve_radial(Hopper("wedge", radians(45), found.value), radians(20))
    assert abs(solution.psi_maximum()[1] - pi / 4) < 1e-9


def test_stable_interval_of_half_angles_begins_where_narrower_cones_are_not():
    # At delta = 33 deg smooth cones of 10 deg are not stable (33.674 deg), those of 45 deg are.
    smooth = angles_of("cone", 33, 0)
    least, largest = known(smooth.stable_from).value, known(smooth.stability).value
    assert radians(10) < least < radians(45) < largest


def test_recommended_half_angle_keeps_the_margin_and_is_solved():
    found = design(material("cone", 38, 14), MARGIN)
    assert found.half_angles.governed_by == "classical"
    recommended = known(found.recommended).value
    assert recommended == known(found.half_angles.classical).value - MARGIN
    factor = flow_factor(solve_radial(Hopper("cone", radians(38), recommended), radians(14)))
    assert abs(known(found.flow_factor).value - factor) <= known(found.flow_factor).error
    assert 0 < known(found.velocity_ratio).value < 1


def test_nothing_to_recommend():
    nothing = design(material("wedge", 30, 12), MARGIN)
    assert nothing.recommended is None
    assert nothing.notes[-1] == "recommended: there is no limit to keep the margin from"
    narrow = design(material("cone", 38, 14), radians(40))
    assert narrow.recommended is None
    assert "margin" in narrow.notes[-1]


def test_von_mises_is_limited_by_solutions_and_velocity():
    found = half_angles(Material("cone", radians(40), radians(30), VON_MISES))
    assert found.classical is None
    assert found.stability is None
    assert found.mass_flow == found.velocity


def test_outlet_of_the_textbook():
    """Rhodes, Introduction to Particle Technology (2008), exercise 10.1: 0.355 m for ff = 1.5."""
    stress = np.linspace(0.01, 10, 4000)
    strength = flow_function(stress, stress**0.45)
    hopper = Hopper("cone", radians(40), radians(30))
    found = smallest_outlet(hopper, Quantity(1.5, 0.0), strength, 1000.0)
    assert found.width.value == pytest.approx(0.355, abs=5e-4)
    # The chart's flow factor is read to a tenth.
    computed = flow_factor(solve_radial(hopper, radians(16)))
    assert computed == pytest.approx(1.5, abs=0.05)


@pytest.mark.parametrize(("intercept", "slope", "factor"), [(0.5, 0.3, 1.6), (2.0, 0.0, 1.2)])
def test_critical_stress_of_a_straight_flow_function(intercept, slope, factor):
    expected = intercept / (1 / factor - slope) / factor
    assert critical_stress(linear_flow_function(intercept, slope), factor) == pytest.approx(
        expected, rel=1e-14
    )


def test_the_last_crossing_counts():
    wavy = flow_function([0.0, 1.0, 2.0, 3.0, 4.0], [0.5, 0.4, 1.6, 1.4, 1.0])
    at = critical_stress(wavy, 1.5) * 1.5
    assert 2 < at < 3
    assert np.interp(at, wavy.major, wavy.strength) == pytest.approx(at / 1.5, rel=1e-14)


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (linear_flow_function(1.0, 0.8), "no outlet"),
        (flow_function([1.0, 2.0], [0.1, 0.1]), "smaller sigma_1"),
        (flow_function([1.0, 2.0], [2.0, 3.0]), "no outlet"),
    ],
)
def test_flow_functions_that_never_cross(function, words):
    with pytest.raises(InvalidParameterError, match=words):
        critical_stress(function, 1.5)
    with pytest.raises(HopperError):
        design(material("cone", 38, 14), MARGIN, Demand(function, 900.0))


@pytest.mark.parametrize(
    ("major", "strength"),
    [([2.0, 1.0], [1.0, 1.0]), ([1.0], [-1.0]), ([], []), ([1.0], [1.0, 2.0])],
)
def test_flow_functions_that_are_none(major, strength):
    with pytest.raises(InvalidParameterError):
        flow_function(major, strength)


def test_error_of_the_outlet_covers_that_of_the_flow_factor():
    hopper = Hopper("cone", radians(40), radians(30))
    strength = linear_flow_function(0.5, 0.3)
    sure = smallest_outlet(hopper, Quantity(1.5, 0.0), strength, 900.0)
    about = smallest_outlet(hopper, Quantity(1.49, 0.01), strength, 900.0)
    assert abs(about.width.value - sure.width.value) <= about.width.error * (1 + 1e-9)
