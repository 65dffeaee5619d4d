"""Extremes over a box: corners, interiors, kinks and borders of existence, against the truth."""

import numpy as np
import pytest

from hopper.uncertainty.extremes import extremes
from hopper.uncertainty.interpolation import interpolated, interpolation_nodes
from hopper.uncertainty.sampling import points_in_box


def samples(dimensions):
    lattice = np.stack(np.meshgrid(*[[0, 0.5, 1]] * dimensions), axis=-1).reshape(-1, dimensions)
    return np.concatenate([lattice, points_in_box(dimensions, 4)[0]])


def found(number, dimensions):
    ends = extremes(number, samples(dimensions))
    assert ends is not None
    return ends


@pytest.mark.parametrize("dimensions", [1, 2, 3])
def test_corners_are_exact(dimensions):
    low, high = found(lambda x: float(np.exp(x).sum() - 3 * x[0]), dimensions)
    assert low.value == pytest.approx(dimensions + np.e - 4, abs=1e-15)
    assert high.value == pytest.approx((dimensions - 1) * np.e + 1, abs=1e-15)
    assert low.error == high.error == 0


@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("at", [0.3, 0.71])
def test_extremes_inside_are_found_within_their_error(dimensions, at):
    low, high = found(lambda x: float(np.cos(3 * (x - at)).sum()), dimensions)
    assert high.value == pytest.approx(dimensions, abs=high.error + 1e-12)
    assert high.error < 1e-6
    far = max(at, 1 - at)
    assert low.value == pytest.approx(dimensions * np.cos(3 * far), abs=1e-12)


def test_two_basins():
    low, _ = found(lambda x: float(np.cos(11 * x[0]) + 0.3 * x[0]), 1)
    grid = np.linspace(0, 1, 100_001)
    assert low.value == pytest.approx(np.min(np.cos(11 * grid) + 0.3 * grid), abs=1e-8)


@pytest.mark.parametrize("dimensions", [1, 2])
def test_kinks(dimensions):
    low, high = found(lambda x: float(np.abs(x - 0.37).max()), dimensions)
    assert 0 <= low.value <= low.error + 1e-15
    assert high.value == pytest.approx(0.63, abs=1e-15)


@pytest.mark.parametrize("border", [0.3, 0.618])
def test_a_border_of_existence_with_a_square_root(border):
    """As at a fold: the number ends there with an infinite slope."""
    low, high = found(lambda x: float(np.sqrt(border - x[0])) if x[0] <= border else np.nan, 1)
    # What is left halves where a step is a quarter; the start of the steps is one of the samples.
    assert 0 <= low.value <= 2 * low.error < 0.3
    assert high.value == pytest.approx(np.sqrt(border), abs=1e-12)


def test_what_does_not_exist_has_no_extremes_and_a_constant_is_one():
    assert extremes(lambda x: np.nan, samples(2)) is None
    low, high = found(lambda x: 2.5, 2)
    assert low.value == high.value == 2.5
    assert low.error == 0


def test_no_range_is_one_number():
    ends = extremes(lambda x: 4.0, np.empty((1, 0)))
    assert ends is not None
    assert [end.value for end in ends] == [4, 4]


@pytest.mark.parametrize("dimensions", [0, 1, 2])
def test_interpolation_of_a_polynomial_is_exact(dimensions):
    nodes = interpolation_nodes(4)
    grids = np.meshgrid(*[nodes] * dimensions, indexing="ij")
    table = np.array(sum((i + 1) * grid**3 - grid for i, grid in enumerate(grids)) + np.float64(2))
    points = np.random.default_rng(1).random((9, dimensions))
    expected = 2 + sum((i + 1) * points[:, i] ** 3 - points[:, i] for i in range(dimensions))
    np.testing.assert_allclose(interpolated(table, points), expected, atol=1e-13)
