"""The interpolated ends of the physical branch against those of single hoppers."""

from math import radians

import numpy as np
import pytest

from hopper.radial.friction_limit import friction_limit
from hopper.radial.members import physical_member
from hopper.uncertainty.box import Box, Range
from hopper.uncertainty.friction_limits import FrictionLimits


def angles(low, high):
    return Range(radians(low), radians(high))


FOLDS = Box("cone", angles(36, 44), angles(14, 22), angles(28, 40))
# Half angles of wedges end the branch with a wall as rough as the material.
WALLS = Box("wedge", angles(30, 34), angles(20, 29), angles(10, 14))


@pytest.fixture(scope="module")
def folds():
    return FrictionLimits(FOLDS)


def test_what_is_claimed_holds_of_single_hoppers(folds):
    random, excluded, near = np.random.default_rng(7), 0, []
    for point in random.random((30, 3)):
        material, half_angle = FOLDS.hopper(point)
        limit = friction_limit(material.hopper(half_angle))
        assert folds.thickest(point) < limit.tau
        near.append(folds.thickest(point) / limit.tau)
        if folds.exclude(point):
            excluded += 1
            assert material.friction_angle > limit.friction_angle
    assert excluded > 10
    assert np.median(near) > 0.9


def test_members_with_thin_layers_are_those_of_the_whole_search(folds):
    found = 0
    for share in np.linspace(0, 1, 9):
        point = folds.border(np.array([share, 0.3]))
        material, half_angle = FOLDS.hopper(point)
        hopper, phi = material.hopper(half_angle), material.friction_angle
        quick = physical_member(hopper, phi, reached=folds.thickest(point))
        whole = physical_member(hopper, phi)
        assert quick
        assert whole
        assert abs(quick.tau - whole.tau) <= (quick.error + whole.error) * whole.tau
        found += quick.tau * half_angle > 20
    assert found


def test_nothing_is_claimed_beside_the_box_or_where_no_fold_ends_the_branch(folds):
    assert folds.thickest([0.5, 0.5, 1.1]) == 0
    assert not folds.exclude([0.5, 0.5, 1.1])
    assert FrictionLimits(WALLS).thickest([0.5, 0.5, 0.5]) == 0
