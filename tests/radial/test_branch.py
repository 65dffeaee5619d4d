"""Members of the physical branch solved together, against those solved one by one."""

from math import radians

import numpy as np
import pytest

from hopper import Hopper, friction_limit
from hopper.errors import NoRadialSolutionError
from hopper.radial.branch import branch_up_to, members_on
from hopper.radial.members import physical_member

# Folds close and far, walls as rough as the material, a singular angle inside.
HOPPERS = [
    ("cone", 35, 10), ("cone", 35, 30), ("cone", 50, 30), ("cone", 20, 10), ("cone", 25, 30),
    ("wedge", 35, 10), ("wedge", 50, 30), ("wedge", 14, 20),
]  # fmt: skip


def make(geometry, delta, half_angle):
    return Hopper(geometry, radians(delta), radians(half_angle))


def walls(hopper, number):
    """Return wall frictions up to just below the largest of the material, and their psi_w."""
    largest = hopper.material.largest_friction_angle(hopper.delta)
    angles = np.linspace(0, 0.999 * largest, number)
    return angles, np.array([hopper.material.wall_angle(hopper.delta, phi) for phi in angles])


@pytest.mark.parametrize("case", HOPPERS)
def test_members_together_are_those_one_by_one(case):
    hopper = make(*case)
    angles, psi_walls = walls(hopper, 40)
    branch = branch_up_to(hopper, float(psi_walls[-1]))
    members = members_on(branch, psi_walls)
    below = angles <= friction_limit(hopper).friction_angle
    solved = np.array([member is not None for member in members])
    assert not np.any(solved & ~below)
    # What is left is close to the largest friction.
    assert solved[below].mean() > 0.8
    assert solved[: int(0.7 * below.sum())].all()
    for angle, member in zip(angles[solved][::3], [m for m in members if m][::3], strict=True):
        single = physical_member(hopper, float(angle))
        assert single
        difference = np.abs(member.on(single.grid) - single.u)
        difference[-1] /= max(1.0, abs(single.tau))
        assert difference.max() <= member.error + single.error
        slope = abs(member.psi_wall_by_tau / single.psi_wall_by_tau - 1)
        assert slope < 1e-5 * single.steepness


@pytest.mark.parametrize("case", [("cone", 35, 30), ("cone", 50, 30), ("cone", 45, 10)])
def test_fold_of_the_branch_excludes_what_lies_beyond(case):
    hopper = make(*case)
    limit = friction_limit(hopper)
    branch = branch_up_to(hopper, hopper.material.singular_angle(hopper.delta))
    assert limit.end == "fold"
    assert branch.fold
    assert abs(branch.fold - limit.psi_wall) < 1e-7
    assert limit.psi_wall < branch.reach < limit.psi_wall + 2e-6
    inside = limit.psi_wall - np.array([1e-3, 1e-5, 1e-7])
    for psi_wall, member in zip(inside, members_on(branch, inside), strict=True):
        if member is not None:
            single = physical_member(hopper, hopper.material.friction_angle(hopper.delta, psi_wall))
            assert single
            assert abs(member.tau / single.tau - 1) <= member.error + single.error


def test_tolerance_is_kept_and_a_looser_one_covers():
    hopper = make("cone", 40, 30)
    _, psi_walls = walls(hopper, 30)
    branch = branch_up_to(hopper, float(psi_walls[-1]))
    fine, loose = (members_on(branch, psi_walls, tolerance) for tolerance in (1e-12, 1e-8))
    known = [(a, b) for a, b in zip(fine, loose, strict=True) if a and b]
    assert len(known) > 10
    assert sum(b.grid.size < a.grid.size for a, b in known) > 3
    for a, b in known:
        assert b.error <= 1e-8 * (1 + 1e-3)
        assert np.abs(b.on(a.grid) - a.u)[:-1].max() <= a.error + b.error


def test_a_branch_stands_for_every_wall():
    hopper = make("wedge", 35, 10)
    assert members_on(branch_up_to(hopper, 0.3), np.array([])) == []
    assert branch_up_to(hopper, 0.3).fold is None
    assert members_on(branch_up_to(hopper, 0.3), np.array([1.0])) == [None]
    with pytest.raises(NoRadialSolutionError, match="lower half_angle"):
        branch_up_to(make("cone", 40, 70), 0.3)
