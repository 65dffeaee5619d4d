"""The field in which psi just reaches pi/4, against radial solutions of hoppers beside it."""

from math import pi, radians

import numpy as np
import pytest

from hopper.design.half_angles import half_angles
from hopper.design.material import Material
from hopper.errors import HopperError
from hopper.problem import Geometry, Hopper
from hopper.radial.collocation import largest_psi
from hopper.radial.flow_curve import WIDEST, flow_curve
from hopper.radial.members import physical_member
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES, YieldCondition

KINDS: dict[str, tuple[Geometry, YieldCondition]] = {
    "wedge": ("wedge", MOHR_COULOMB),
    "von-mises": ("cone", VON_MISES),
}


def random_walls(kind, number, least, most, seed):
    print(f"seed {seed}")
    rng = np.random.default_rng(seed)
    geometry, law = KINDS[kind]
    for delta in np.radians(rng.uniform(least, most, number)):
        hopper = Hopper(geometry, float(delta), WIDEST, law)
        highest = min(law.wall_angle(delta, law.largest_friction_angle(delta)), pi / 4)
        yield hopper, float(rng.uniform(0, 1) * highest)


@pytest.mark.parametrize(("kind", "least"), [("wedge", 36), ("von-mises", 28)])
def test_the_widest_hopper_has_its_largest_psi_at_45_degrees(kind, least):
    found = 0
    for hopper, psi_wall in random_walls(kind, 12, least, 88, seed=2107):
        curve = flow_curve(hopper)
        assert curve
        angle = curve.half_angle(psi_wall)
        if angle is None:
            assert psi_wall < curve.member.psi_wall + curve.member.error
            continue
        found += 1
        phi = hopper.material.friction_angle(hopper.delta, psi_wall)
        for at, sign in ((angle.value, 0), (angle.value - 1e-3, -1), (angle.value + 1e-3, 1)):
            beside = Hopper(hopper.geometry, hopper.delta, at, hopper.material)
            member = physical_member(beside, phi)
            assert member
            excess = largest_psi(member) - pi / 4
            assert abs(excess) < 1e-10 if sign == 0 else sign * excess > 1e-7
        assert angle.error < 1e-10
    assert found >= 8


@pytest.mark.parametrize(("kind", "most"), [("wedge", 33.5), ("von-mises", 25.5)])
def test_without_such_a_field_psi_stays_below(kind, most):
    for hopper, psi_wall in random_walls(kind, 6, 15, most, seed=2108):
        assert flow_curve(hopper) is None
        phi = hopper.material.friction_angle(hopper.delta, psi_wall)
        for angle in np.radians((10, 30, 50, 70, 85)):
            beside = Hopper(hopper.geometry, hopper.delta, float(angle), hopper.material)
            try:
                member = physical_member(beside, phi)
            except HopperError:
                continue
            assert member is None or largest_psi(member) < pi / 4


def test_errors_near_the_top_go_as_the_square_root():
    curve = flow_curve(Hopper("wedge", radians(50), 0.1))
    assert curve
    far, near = (curve.half_angle(pi / 4 - gap) for gap in (0.1, 1e-12))
    assert far
    assert near
    assert near.error > 1e3 * far.error
    assert curve.half_angle(pi / 4) is None


def test_limits_of_cones_are_of_the_physical_branch():
    """Of wider ones the field lies beyond the fold; a walk along half angles missed the first."""
    limit = velocity_limit(41.94, 26.172)
    assert limit
    member = physical_member(Hopper("cone", radians(41.94), limit.value - 1e-5), radians(26.172))
    assert member
    assert abs(largest_psi(member) - pi / 4) < 0.01
    assert velocity_limit(45, 20) is None


def velocity_limit(delta, phi):
    return half_angles(Material("cone", radians(delta), radians(phi))).velocity
