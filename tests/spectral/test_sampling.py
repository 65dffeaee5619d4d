"""Samples of a curve: between them lines are the curve, whatever its peaks and kinks."""

import numpy as np
import pytest

from hopper.spectral.sampling import closing_in, refined


def peaks(x):
    """Return two curves: a Lorentzian far narrower than the first spacing, and a kink."""
    return np.stack([1 + 40 / (1 + ((x - 0.3137) / 2e-3) ** 2), 0.5 + np.abs(x - 0.712)])


def test_peaks_and_kinks_are_drawn():
    x, y = refined(peaks, np.linspace(0, 1, 201), 0.01)
    dense = np.linspace(0, 1, 100_001)
    drawn = np.stack([np.interp(dense, x, row) for row in y])
    assert np.abs(drawn / peaks(dense) - 1).max() < 0.02
    assert y[0].max() == pytest.approx(41, rel=1e-2)
    assert y[1].min() == pytest.approx(0.5, rel=1e-2)
    assert x.size < 600
    assert np.all(np.diff(x) > 0)


def test_half_the_first_step_changes_no_extremum():
    coarse, fine = (refined(peaks, np.linspace(0, 1, n), 0.01)[1] for n in (201, 401))
    assert coarse.max(axis=1) == pytest.approx(fine.max(axis=1), rel=0.01)
    assert coarse.min(axis=1) == pytest.approx(fine.min(axis=1), rel=0.01)


def test_a_line_needs_no_more_samples_than_middles():
    x, y = refined(lambda x: 2 + x, np.linspace(0, 1, 5), 0.01)
    assert x == pytest.approx(np.linspace(0, 1, 9))
    assert y == pytest.approx(2 + x)


def test_an_axis_closes_in_on_places_and_leaves_them_out():
    axis = closing_in(np.linspace(-2, 2, 5), np.array([0.5, -7.0]))
    assert 0.5 not in axis
    assert np.abs(axis - 0.5).min() == pytest.approx(2**-5)
    assert np.all(np.diff(axis) > 0)
    assert axis[0] == -2
    assert axis[-1] == 2
