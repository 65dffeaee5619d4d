"""Mass flow, yes or no, against the fields of the hopper itself."""

from math import degrees, pi, radians

import numpy as np
import pytest

from hopper.design.flow_pattern import flow_pattern
from hopper.design.material import Material
from hopper.errors import HopperError
from hopper.problem import Geometry, Hopper
from hopper.radial.solution import solve_radial
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES


@pytest.mark.parametrize(
    ("geometry", "delta", "phi", "half_angle", "expected"),
    [
        ("cone", 38, 14, 30, True),
        ("cone", 38, 14, 36, False),
        ("cone", 15, 5, 30, True),  # no limit below 19.47 deg
        ("cone", 50, 45, 5, False),  # at no half angle
        ("wedge", 45, 20, 30, True),
        ("wedge", 45, 20, 80, False),
        ("wedge", 30, 12, 20, True),  # no limit
        ("wedge", 45, 44.9, 10, False),  # at no half angle
        ("wedge", 12, 6, 5, True),  # narrower ones have no positive stress
        ("wedge", 15, 7.5, 20, True),
    ],
)
def test_mass_flow(geometry, delta, phi, half_angle, expected):
    found = flow_pattern(Material(geometry, radians(delta), radians(phi)), radians(half_angle))
    assert found.mass_flow is expected
    if found.spare:
        assert (found.spare.value > 0) is expected
    else:
        assert found.reason


def random_walls(number):
    print("seed 2101")
    rng = np.random.default_rng(2101)
    for _ in range(number):
        kind = rng.choice(["wedge", "cone", "von-mises"])
        material = VON_MISES if kind == "von-mises" else MOHR_COULOMB
        geometry: Geometry = "wedge" if kind == "wedge" else "cone"
        delta, half_angle = rng.uniform(20, 60), rng.uniform(3, 70)
        hopper = Hopper(geometry, radians(delta), radians(half_angle), material)
        phi = material.largest_friction_angle(hopper.delta) * rng.uniform(0, 1)
        yield hopper, float(phi)


@pytest.mark.parametrize("number", [12, pytest.param(200, marks=pytest.mark.soak)])
def test_mass_flow_against_the_fields(number):
    """Wedges and von Mises cones: psi below pi/4. Cones: a solution within the limit of sigma_0."""
    seen = {True: 0, False: 0}
    for hopper, phi in random_walls(number):
        made = Material(hopper.geometry, hopper.delta, phi, hopper.material)
        found = flow_pattern(made, hopper.half_angle)
        if found.mass_flow is None:
            continue
        if found.spare and abs(degrees(found.spare.value)) < 0.01:
            continue
        seen[found.mass_flow] += 1
        try:
            largest = solve_radial(hopper, phi).psi_maximum()[1]
        except HopperError:
            assert not found.mass_flow, (hopper, degrees(phi))
        else:
            slips = hopper.geometry == "cone" and hopper.material == MOHR_COULOMB
            assert found.mass_flow == (largest < pi / 4) or slips, (hopper, degrees(phi))
    assert min(seen.values()) >= number / 6
