"""Shares and probabilities against areas and the normal distribution in closed form."""

from math import erf, pi, sqrt

import numpy as np
import pytest

from hopper.errors import InvalidParameterError
from hopper.uncertainty.sampling import SHIFTS, Share, cut_off, normal_points, points_in_box, shares


def normal(z):
    return (1 + erf(z / sqrt(2))) / 2


def test_points_are_the_same_each_time_and_fill_each_part_of_a_range_alike():
    points = points_in_box(3, 5)
    assert points.shape == (SHIFTS, 32, 3)
    np.testing.assert_array_equal(points, points_in_box(3, 5))
    # A net: each of 32 equal parts has one point, in every coordinate of every shift.
    parts = np.sort((points * 32).astype(int), axis=1)
    assert (parts == np.arange(32)[None, :, None]).all()


@pytest.mark.parametrize("radius", [0.2, 0.5, 0.9])
def test_the_share_of_a_quarter_of_a_disk(radius):
    points = points_in_box(2, 6)
    found = shares(lambda x: ["in"] if np.hypot(*x) < radius else ["out"], points)
    truth = pi * radius**2 / 4
    # Within the error in 95 of 100 cases, within twice the error in 998 of 1000.
    assert abs(found["in"].value - truth) <= 2 * found["in"].error < 0.06
    assert found["in"].value + found["out"].value == pytest.approx(1, abs=1e-15)


def test_errors_hold_as_often_as_they_say():
    """Half planes of known share, 200 of them: 95 in 100 within the error."""
    points, random = points_in_box(2, 5), np.random.default_rng(3)
    held = []
    for slope, level in random.random((200, 2)):

        def below(x, slope=slope, level=level):
            return ["in"] * bool(x[1] < level + slope * (x[0] - level))

        found = shares(below, points)
        edge = np.clip(level + slope * (np.linspace(0, 1, 20_001) - level), 0, 1)
        share = found.get("in", Share(0.0, 1 / 256))
        held.append(abs(share.value - edge.mean()) <= share.error)
    assert np.mean(held) > 0.9


@pytest.mark.parametrize("level", [-0.7, 0.2, 1.3])
def test_probability_of_a_half_space(level):
    """0.5 + z / 2 <= level has probability Phi(2 level - 1), also for a sum of two."""
    for dimensions, scale in ((1, 1.0), (2, sqrt(2))):
        free = np.tile([-9.0, 9.0], (dimensions, 1))
        points = normal_points(points_in_box(dimensions, 8), free)
        found = shares(lambda x: ["in"] * bool((2 * x - 1).sum() <= 2 * level - 1), points)
        truth = normal((2 * level - 1) / scale)
        assert abs(found["in"].value - truth) <= found["in"].error < 0.02


def test_impossible_values_are_cut_off():
    possible = np.array([[0.2, 9.0], [-9.0, 9.0]])
    points = normal_points(points_in_box(2, 8), possible)
    assert points[..., 0].min() >= 0.2
    assert cut_off(possible) == pytest.approx(normal(2 * 0.2 - 1), abs=1e-15)
    found = shares(lambda x: ["in"] * bool(x[0] < 0.6), points)
    truth = (normal(0.2) - normal(-0.6)) / (1 - normal(-0.6))
    assert abs(found["in"].value - truth) <= found["in"].error


@pytest.mark.parametrize(("dimensions", "power"), [(0, 3), (17, 3), (2, -1), (2, 17)])
def test_what_is_out_of_range(dimensions, power):
    with pytest.raises(InvalidParameterError, match="out of range"):
        points_in_box(dimensions, power)
