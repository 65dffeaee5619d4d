"""The net of characteristics: exact cases, order, and agreement with the loop."""

from itertools import islice

import numpy as np
import pytest

from hopper.march.fields import state_at
from hopper.march.net import SLOPES, TAU, THETA, make_net, rows
from hopper.march.tops import bump_of_sigma, one_sided_bump, riemann_deviation
from tests.march.witnesses import BEYOND, base, on_loop

HOPPERS = [("wedge", 38, 17, 0.12), ("cone", 38, 17, 0.12), ("cone", 40, 20, 0.2), BEYOND]


def boundary_values(under, top, cells, tau, end):
    """w at one end of a net at one tau, by a polynomial through nearby rows."""
    seen = []
    net = make_net(under, top.symmetric)
    for row in rows(net, cells, lambda x: riemann_deviation(under, top, x)):
        if row.shape[1] == cells + 1:
            seen.append((row[TAU, end], row[2, end]))
        if row[TAU].min() > tau + 0.05:
            break
    times, values = np.array(seen).T
    near = np.argsort(np.abs(times - tau))[:6]
    return np.polyfit(times[near] - tau, values[near], 5)[-1]


@pytest.mark.parametrize("case", HOPPERS)
def test_radial_field_is_balanced_exactly(case):
    under = base(*case)
    for row in islice(rows(make_net(under, True), 20, lambda x: np.zeros((2, x.size))), 60):
        assert np.all(row[[2, 3, 6, 7]] == 0)
    # Lines alone remain: each tau is a base travel time, and they never cross.
    assert row[TAU].min() > 0
    assert np.all(np.diff(row[THETA]) > 0)
    assert np.all(row[SLOPES] > 0)


@pytest.mark.parametrize("case", HOPPERS)
def test_order_two_and_agreement_with_the_loop_at_the_wall(case):
    under, top, tau = base(*case), bump_of_sigma(0.1), 0.15
    coarse, middle, fine = (boundary_values(under, top, n, tau, -1) for n in (40, 80, 160))
    assert (coarse - middle) / (middle - fine) == pytest.approx(4, abs=0.15)
    limit = fine + (fine - middle) / 3
    error = abs(limit - (middle + (middle - coarse) / 3))
    loops = [state_at(on_loop(under, top, n, tau), tau)[0, -1] for n in (96, 128)]
    assert limit == pytest.approx(loops[1], abs=error + abs(loops[1] - loops[0]))
    assert error < 2e-6


@pytest.mark.parametrize("end", [0, -1])
def test_both_walls_of_a_wedge_without_symmetry(end):
    under, top, tau = base("wedge", 38, 17, 0.12), one_sided_bump(0.1), 0.1
    middle, fine = (boundary_values(under, top, n, tau, end) for n in (160, 320))
    limit = fine + (fine - middle) / 3
    # C+ leaves the left wall as leg 0 begins, and arrives at the right one as it ends.
    loop = state_at(on_loop(under, top, 144, tau), tau)[0, end]
    assert limit == pytest.approx(loop, abs=2e-6)


def test_axis_of_a_wedge():
    under, top, tau = base("wedge", 38, 17, 0.12), bump_of_sigma(0.1), 0.15
    middle, fine = (boundary_values(under, top, n, tau, 0) for n in (80, 160))
    history = on_loop(under, top, 128, tau)
    value = history.loop.mesh.interpolation(np.array([0.0]))[0] @ state_at(history, tau)[0]
    assert fine + (fine - middle) / 3 == pytest.approx(value, abs=1e-6)
