"""Designs over a box against designs on a fine grid."""

from functools import lru_cache
from math import radians

import numpy as np
import pytest

from hopper.design.design import design
from hopper.errors import InvalidParameterError
from hopper.uncertainty.box import Box, Range
from hopper.uncertainty.designs import design_over
from hopper.yield_conditions import VON_MISES


def angles(low, high=None):
    return Range(radians(low), radians(low if high is None else high))


CONE = Box("cone", angles(32, 60), angles(25), angles(1))
MARGIN = radians(3)


@lru_cache
def over():
    return design_over(CONE, MARGIN, normal=True)


def test_limits_hold_a_fine_grid_and_an_extreme_inside():
    """The classical limit is widest inside: at neither end of delta."""
    found = over()
    grid = [design(CONE.hopper(np.array([x]))[0], MARGIN) for x in np.linspace(0, 1, 8)]
    for name in ("classical", "limit"):
        values = [getattr(one.half_angles, name).value for one in grid]
        interval = found.numbers[f"half_angles.{name}"]
        assert interval.low.value <= min(values) + interval.low.error
        assert interval.high.value >= max(values) - interval.high.error
        assert interval.high.value - max(values) < radians(0.1)
        assert interval.low.value > min(values) - radians(0.1)
    classical = found.numbers["half_angles.classical"]
    ends = [grid[place].half_angles.classical for place in (0, -1)]
    assert all(end and classical.high.value > end.value + radians(0.02) for end in ends)


def test_what_is_recommended_keeps_the_margin_everywhere():
    found = over()
    assert found.recommended is not None
    least = found.numbers["half_angles.classical"].low
    assert found.recommended.value == pytest.approx(least.value - MARGIN, abs=1e-15)
    assert found.numbers["recommended"].low.value == pytest.approx(found.recommended.value)


def test_what_governs_has_shares_that_add_up():
    found = over()
    assert found.probabilities is not None
    for shares in (found.shares, found.probabilities):
        assert sum(share.value for share in shares.values()) == pytest.approx(1, abs=1e-15)


def test_boxes_that_are_refused():
    with pytest.raises(InvalidParameterError, match="no range of delta or wall"):
        design_over(Box("cone", angles(40), angles(16), angles(1)), MARGIN)
    with pytest.raises(InvalidParameterError, match="half angles"):
        design_over(Box("cone", angles(38, 40), angles(16), angles(1, 2)), MARGIN)


@pytest.mark.soak
def test_von_mises_cones_have_the_limit_of_velocity():
    found = design_over(Box("cone", angles(38, 40), angles(10), angles(1), VON_MISES), MARGIN)
    assert "half_angles.velocity" in found.numbers
    assert "half_angles.stability" not in found.numbers
