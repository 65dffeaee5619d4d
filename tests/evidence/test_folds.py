"""lambda = 0 at the folds of the family, on both sides of the corner of the stable domain."""

from math import degrees, radians

import pytest

from hopper.evidence.folds import fold_mode
from hopper.problem import Hopper
from tests.stability.tilted_data import read

FIRST = {
    (fold["delta_deg"], fold["half_angle_deg"]): fold
    for fold in reversed(read("tilted_reference", "folds"))
}
# Delta of the corner by half angle; below it a complex pair has crossed before the fold.
CORNERS = {
    known["half_angle_deg"]: known["delta_deg"] for known in read("tilted_reference", "corners")
}
MORE = [(28, 20), (29, 25), (33, 40), (29, 15), (36, 35), (32, 35), (45, 15), (31, 30), (38, 25)]
FOLDS = [*FIRST, *MORE]


def cone(delta, half_angle):
    return Hopper("cone", radians(delta), radians(half_angle))


def test_cones_lie_on_both_sides_of_the_corner():
    known = [(delta, angle) for delta, angle in FOLDS if angle in CORNERS]
    below = [delta < CORNERS[angle] for delta, angle in known]
    assert len(FOLDS) >= 20
    assert 4 < sum(below) < len(known) - 4


@pytest.mark.parametrize("hopper", FOLDS, ids=lambda hopper: f"{hopper[0]}-{hopper[1]}")
def test_a_mode_is_neutral_at_the_fold(hopper):
    found = fold_mode(cone(*hopper))
    assert found is not None
    assert found.modulus <= found.error < 1e-5
    # One real mode passes 0, so their number changes parity: even before it, odd behind.
    assert abs(found.before - found.behind) == 1
    assert found.before % 2 == 0
    if hopper in FIRST:
        assert degrees(found.friction_angle) == pytest.approx(FIRST[hopper]["phi_deg"], abs=1e-8)
    if hopper[1] in CORNERS:
        below = hopper[0] < CORNERS[hopper[1]]
        assert not (found.before and not below)


@pytest.mark.parametrize("hopper", [("wedge", 35, 10), ("cone", 25, 30), ("cone", 50, 5)])
def test_no_fold(hopper):
    """The wall, the interior and the axis end these families."""
    geometry, delta, half_angle = hopper
    assert fold_mode(Hopper(geometry, radians(delta), radians(half_angle))) is None
