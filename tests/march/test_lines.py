"""Characteristics to look at, and what lets nets end early."""

from math import sin

import numpy as np
import pytest

from hopper.errors import InvalidParameterError
from hopper.march.base import base_state
from hopper.march.crossing import _steepest
from hopper.march.lines import characteristics
from hopper.march.net import make_net, rows
from hopper.march.optics import calm_slope
from hopper.march.outcome import first_crossing, march
from hopper.march.tops import bump_of_sigma, one_sided_bump, riemann_deviation, scaled
from hopper.stability.asymptotic_line import asymptotic_line
from tests.march.witnesses import BEYOND, base


@pytest.mark.parametrize("case", [("wedge", 45, 15, 0.2), ("cone", 38, 17, 0.12), BEYOND])
def test_lines_of_the_radial_field_have_its_slopes(case):
    under = base(*case)
    lines = characteristics(under, scaled(1.0), 64, 0.1)
    middle = lines.theta.mean(axis=1)
    inside = np.abs(middle) > 0.05 * under.hopper.half_angle
    # C- is C+ of the hopper in the mirror.
    state = base_state(under, np.where(lines.forward, middle, -middle)[inside])
    rise, run = (np.diff(ends, axis=1)[inside, 0] for ends in (lines.tau, lines.theta))
    np.testing.assert_allclose(rise, np.abs(run) * state.d / state.a, atol=1e-4)
    assert np.all(np.sign(run) == np.where(lines.forward, 1, -1)[inside])
    assert lines.tau.max() <= 0.1


def test_lines_of_a_symmetric_stress_are_symmetric():
    lines = characteristics(base("wedge", 45, 15, 0.2), bump_of_sigma(0.2), 8, 0.2)
    one, other = (set(map(tuple, np.round(ends, 12))) for ends in (lines.theta, -lines.theta))
    assert one == other
    whole = characteristics(base("wedge", 45, 15, 0.2), one_sided_bump(0.2), 8, 0.05)
    assert whole.theta.min() == pytest.approx(-base("wedge", 45, 15, 0.2).hopper.half_angle)
    with pytest.raises(InvalidParameterError, match="symmetric"):
        characteristics(base("cone", 38, 17, 0.12), one_sided_bump(0.2), 8, 0.05)


def test_slope_below_which_waves_are_calm():
    """Half of 2 s |Lambda|, the threshold for a smooth wall; none where short waves grow."""
    under = base("wedge", 45, 10, 0.0)
    growth = asymptotic_line(under.solution).abscissa
    assert calm_slope(under) == pytest.approx(sin(under.hopper.delta) * abs(growth), rel=1e-6)
    assert calm_slope(base("wedge", 35, 10, 0.0)) == 0.0
    assert calm_slope(base("cone", 38, 17, 0.12)) > 0


@pytest.mark.parametrize("case", [("wedge", 45, 15, 0.2), ("cone", 38, 17, 0.12)])
def test_steepest_slope_on_a_row(case):
    """On the first row it is that of the top, later that of the march on the loop."""
    under, top = base(*case), bump_of_sigma(0.1)
    net = make_net(under, symmetric=True)
    first = next(rows(net, 400, lambda x: riemann_deviation(under, top, x)))
    x = np.linspace(-1, 1, 2001)[:-1] + 5e-4
    w = riemann_deviation(under, top, x)[0]
    state = base_state(under, under.hopper.half_angle * x)
    slope = np.gradient(w, under.hopper.half_angle * x) * state.a / state.d
    assert _steepest(first) == pytest.approx(slope.max(), rel=5e-3)


def test_nets_that_end_early_see_the_same():
    under, top = base("cone", 50, 10, 0.1), bump_of_sigma(0.05)
    early = first_crossing(under, top, 50.0)
    assert early.crossing is None
    assert early.converging


def test_a_crossing_by_coarse_nets():
    """Published: .313278 +- 5e-7."""
    found = first_crossing(base("wedge", 45, 15, 0.2), bump_of_sigma(0.2), 1.0, 1e-3, cells=32)
    assert found.crossing is not None
    assert found.crossing.tau == pytest.approx(0.313278, abs=3 * found.crossing.error)
    assert found.crossing.error < 1e-3


def test_fields_over_depth_and_angle():
    under = base("cone", 38, 17, 0.12)
    found = march(under, bump_of_sigma(0.1), 0.2)
    tau, theta = np.array([0.0, 0.07, 0.2]), under.hopper.half_angle * np.linspace(-1, 1, 9)
    sigma, psi = found.fields_over(tau, theta)
    for i, at in enumerate(tau):
        np.testing.assert_allclose([sigma[i], psi[i]], found.fields(at, theta), atol=1e-7)
    assert found.distance([0.0])[0] == pytest.approx(
        (np.exp(0.1) - 1) * (1 + sin(under.hopper.delta))
    )
    assert found.error_up_to(0.0) <= found.error_up_to(0.1) <= found.error_estimate
    with pytest.raises(InvalidParameterError, match=r"tau = 0\.3 is not within the march"):
        found.distance([0.3])
