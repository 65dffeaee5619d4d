"""Answers over a box against a fine grid of hoppers, exact borders and the normal distribution."""

from itertools import product
from math import atan, erf, nan, radians, sqrt, tan

import numpy as np
import pytest

from hopper.design.flow_pattern import flow_pattern
from hopper.design.material import Material
from hopper.errors import HopperError, InvalidParameterError
from hopper.radial.flow_factor import flow_factor
from hopper.radial.friction_limit import friction_limit
from hopper.radial.mass_flow import mass_flow_friction_angle, mass_flow_half_angle
from hopper.radial.solution import solve_radial
from hopper.radial.velocity import solve_velocity
from hopper.stability.modes import linear_stability
from hopper.uncertainty.box import Box, Range
from hopper.uncertainty.hoppers import BoxedHoppers
from hopper.uncertainty.ranged import radial_over, stability_over
from hopper.yield_conditions import VON_MISES


def angles(low, high=None):
    return Range(radians(low), radians(low if high is None else high))


def box(geometry, delta, wall, half_angle, **more):
    return Box(geometry, angles(*delta), angles(*wall), angles(*half_angle), **more)


CONE = box("cone", (36, 40), (14, 18), (20,))
WEDGE = box("wedge", (35, 50), (16,), (15, 25))
# Its corner of rough walls and wide cones has no radial solution.
PART = box("cone", (40,), (12, 20), (25, 38))


def solutions(of, count):
    """Solve on a grid of the box, independently of it."""
    for place in product(np.linspace(0, 1, count), repeat=len(of.ranged)):
        material, half_angle = of.hopper(np.array(place))
        try:
            yield material.solution(half_angle)
        except HopperError:
            yield None


def velocity(solution):
    try:
        return solve_velocity(solution).wall
    except HopperError:
        return nan


NUMBERS = {
    "sigma_axis": lambda one: one.sigma_axis,
    "sigma_wall": lambda one: one.sigma_wall,
    "psi_max": lambda one: one.psi_maximum()[1],
    "theta_psi_max": lambda one: one.psi_maximum()[0],
    "flow_factor": flow_factor,
    "u_wall": velocity,
}


@pytest.mark.parametrize(
    "of",
    [
        pytest.param(CONE, id="cone"),
        pytest.param(WEDGE, id="wedge", marks=pytest.mark.soak),
        pytest.param(PART, id="part", marks=pytest.mark.soak),
    ],
)
def test_radial_numbers_hold_a_fine_grid_and_are_attained(of):
    found = radial_over(of)
    grid = [one for one in solutions(of, 13) if one]
    for name, number in NUMBERS.items():
        values = np.array([number(one) for one in grid])
        low, high = np.nanmin(values), np.nanmax(values)
        interval = found.numbers[name]
        assert interval.low.value <= low + interval.low.error + 1e-12, name
        assert interval.high.value >= high - interval.high.error - 1e-12, name
        if of is not PART:  # no wider than a grid of twice as many cells would make believe
            room = (high - low) / 50 + 1e-9
            assert low - room < interval.low.value, name
            assert interval.high.value < high + room, name


def test_at_the_border_of_existence_numbers_are_those_of_the_fold():
    found = radial_over(PART)
    beside = []
    for half_angle in np.linspace(PART.half_angle.low, PART.half_angle.high, 41):
        hopper = Material("cone", radians(40), 0.2).hopper(half_angle)
        phi = friction_limit(hopper).friction_angle * (1 - 1e-8)
        if phi < PART.wall.high:
            beside.append(solve_radial(hopper, phi))
    for name in ("sigma_wall", "psi_max"):
        high = found.numbers[name].high
        largest = max(NUMBERS[name](one) for one in beside)
        # The square root of 1e-8, and the distance of 41 places.
        assert high.value == pytest.approx(largest, abs=high.error + 1e-3), name


@pytest.mark.parametrize("of", [CONE, WEDGE], ids=["cone", "wedge"])
def test_abscissae_hold_a_fine_grid_and_verdicts_their_shares(of):
    found = stability_over(of)
    judged = [linear_stability(one) for one in solutions(of, 15) if one]
    values = [one.abscissa for one in judged]
    interval = found.numbers["abscissa"]
    assert interval.low.value <= min(values) + 1e-9
    assert interval.high.value >= max(values) - 1e-9
    room = (max(values) - min(values)) / 30
    assert interval.low.value > min(values) - room
    assert interval.high.value < max(values) + room
    verdicts = [str(one.verdict) for one in judged]
    for name, share in found.shares.items():
        if name != "mass_flow":
            # A grid of 15 x 15 is off by less than a row of its cells.
            assert share.value == pytest.approx(verdicts.count(name) / 225, abs=1 / 14), name
    assert sum(share.value for name, share in found.shares.items() if name != "mass_flow") == 1


def test_the_share_of_mass_flow_is_what_the_closed_limit_says():
    of = box("cone", (34, 42), (12, 20), (30,))
    hopper = Material("cone", radians(38), radians(15)).hopper(radians(30))

    def slips(delta, phi):
        own = Material("cone", delta, phi).hopper(hopper.half_angle)
        return mass_flow_half_angle(own, phi) > hopper.half_angle

    fine = np.linspace(0, 1, 201)[:-1] + 1 / 400
    deltas, phis = radians(34) + fine * radians(8), radians(12) + fine * radians(8)
    truth = np.mean([[slips(delta, phi) for phi in phis.tolist()] for delta in deltas.tolist()])
    found = radial_over(of).shares["mass_flow"]
    assert abs(found.value - truth) <= found.error + 1 / 400
    assert found.error < 0.01


def test_probability_of_mass_flow_is_that_of_a_normal_wall():
    """mu = 0.25 +- 0.02 against the friction at which the wall of this cone slips no more."""
    of = Box("cone", angles(40), Range(0.23, 0.27), angles(34), coefficient=True)
    limit = tan(mass_flow_friction_angle(Material("cone", radians(40), 0.1).hopper(radians(34))))
    found = radial_over(of, normal=True)
    assert found.probabilities is not None
    chance = found.probabilities["mass_flow"]
    truth = (1 + erf((limit - 0.25) / 0.02 / sqrt(2))) / 2
    assert abs(chance.value - truth) <= chance.error < 0.01
    share = found.shares["mass_flow"]
    assert abs(share.value - (limit - 0.23) / 0.04) <= share.error


def test_a_part_without_solution_is_a_share():
    found = radial_over(PART)
    exist = [one is not None for one in solutions(PART, 21)]
    share = found.shares["radial_solution"]
    assert abs(share.value - np.mean(exist)) <= share.error + 1 / 20
    assert share.value + found.shares["no_radial_solution"].value == 1


def test_smooth_walls_are_stable_and_flow():
    found = stability_over(box("cone", (35, 45), (0,), (10, 15)))
    assert found.shares["mass_flow"].value == 1
    assert found.shares["mass_flow"].error == 0
    assert found.numbers["abscissa"].high.value == pytest.approx(
        linear_stability(Material("cone", radians(35), 0.0).solution(radians(15))).abscissa, abs=0.5
    )


@pytest.mark.parametrize("geometry", ["cone", "wedge"])
def test_mass_flow_at_a_point_is_that_of_the_flow_pattern(geometry):
    of = Box(geometry, angles(25, 60), Range(0.05, 0.45), angles(8, 50), coefficient=True)
    hoppers, random = BoxedHoppers(of), np.random.default_rng(5)
    for point in random.random((25, 3)):
        assert hoppers.mass_flow(point) == flow_pattern(*of.hopper(point)).mass_flow, point


def test_limits_do_not_depend_on_the_wall():
    found = radial_over(box("cone", (40,), (14, 18), (20,)))
    assert found.numbers["coefficient"].low == found.numbers["coefficient"].high


def test_boxes_that_are_refused():
    with pytest.raises(InvalidParameterError, match="above high"):
        angles(40, 30)
    with pytest.raises(InvalidParameterError, match="delta = 90 deg"):
        box("cone", (80, 90), (10,), (20,))
    with pytest.raises(InvalidParameterError, match="half_angle = 0 deg"):
        box("cone", (80,), (10,), (0, 20))
    with pytest.raises(InvalidParameterError, match="single hopper"):
        radial_over(box("cone", (40,), (10,), (20,)))
    with pytest.raises(InvalidParameterError, match="Mohr-Coulomb"):
        stability_over(box("cone", (40, 50), (10,), (20,), condition=VON_MISES))
    with pytest.raises(InvalidParameterError, match="asymmetric disturbances"):
        stability_over(CONE, "any")
    with pytest.raises(InvalidParameterError, match="point has 1 coordinates"):
        CONE.hopper(np.array([0.5]))


def test_a_wall_in_mu_is_a_wall_in_phi():
    of = Box("cone", angles(40), Range(0.2, 0.4), angles(20), coefficient=True)
    material, _ = of.hopper(np.array([0.25]))
    assert material.friction_angle == pytest.approx(atan(0.25), abs=1e-15)
