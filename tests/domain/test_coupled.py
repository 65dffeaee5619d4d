"""Sweeps and borders of von Mises cones against single verdicts, closed forms and the reference."""

from math import asin, atan, degrees, isnan, nan, radians, sin, sqrt

import numpy as np
import pytest

from hopper.domain.coupled import (
    COUPLED_REGIONS,
    coupled_borders,
    decay_rates,
    stable_edge,
    sweep_coupled,
)
from hopper.errors import InvalidParameterError
from hopper.von_mises.verdict import judge
from tests.von_mises.witnesses import REFERENCE, cone


@pytest.mark.parametrize(("delta", "half_angle"), [(25, 10), (40, 10), (50, 30), (61, 10)])
def test_a_sweep_is_what_single_verdicts_say(delta, half_angle):
    phis = np.radians([0.0, 5, 12, 20, 26, 33])
    hopper = cone(delta, half_angle)
    sweep = sweep_coupled(hopper, phis)
    for i, phi in enumerate(phis):
        alone = judge(hopper, float(phi))
        assert COUPLED_REGIONS[sweep.region[i]] == alone.verdict
        assert sweep.slanted[i] == alone.slanted
        assert sweep.abscissa[i] == pytest.approx(alone.abscissa, abs=1e-7, nan_ok=True)
        down = alone.end_effects.decay_down if alone.end_effects else nan
        assert sweep.decay_down[i] == pytest.approx(down, abs=1e-7, nan_ok=True)


@pytest.mark.parametrize("border", REFERENCE["borders_phi_deg"],
                         ids=lambda b: f"{b['half_angle']}-{b['delta']}")  # fmt: skip
def test_borders_of_the_reference(border):
    found = coupled_borders(radians(border["half_angle"]), np.radians([border["delta"]]))
    ends = border["phi_elliptic_ends"]
    if ends is not None:
        # Inside the cone the reference took psi on a grid, at most 2e-4 deg off.
        assert degrees(found.sonic[0]) == pytest.approx(ends, abs=2e-4)
        assert isnan(found.tangency[0])
    else:
        assert degrees(found.tangency[0]) == pytest.approx(border["phi_tangency"], abs=2e-4)
        assert isnan(found.sonic[0])


def test_borders_at_the_wall_in_closed_form():
    deltas = np.radians([20.0, 30, 40, 50])
    found = coupled_borders(radians(10), deltas)
    s = np.sin(deltas)
    np.testing.assert_allclose(np.tan(found.limit), s, rtol=1e-9)
    low, high = s[:2], s[2:]
    closed = low * np.sqrt(1 - 3 * low**2) / (1 + low**2)
    np.testing.assert_allclose(np.tan(found.sonic[:2]), closed, rtol=1e-9)
    closed = high * np.sqrt(1 - 4 * high**2 / 3) / (1 + 2 * high**2 / 3)
    np.testing.assert_allclose(np.tan(found.tangency[2:]), closed, rtol=1e-9)
    # Next to 35.26 deg the border comes down to the smooth wall.
    near = coupled_borders(radians(10), np.array([asin(1 / sqrt(3)) - 1e-4]))
    assert near.sonic[0] < 2e-2
    assert atan(sin(radians(30))) == pytest.approx(found.limit[1])


def test_decay_rates_are_those_of_the_reference():
    known = REFERENCE["sets"][0]
    down, up = decay_rates(cone(25, 10), np.arctan([0.05, 0.1, 0.3]))
    assert down[1] == pytest.approx(known["decay_down"], abs=1e-8)
    assert up[1] == pytest.approx(known["decay_up"], abs=1e-8)


def test_stable_edge():
    # The second and third edge are found from their neighbours.
    deltas, phi = np.radians([50.0, 51, 51.5]), radians(31)
    edges = stable_edge(radians(10), deltas, phi)
    for delta, edge in zip((50, 51, 51.5), edges, strict=True):
        assert judge(cone(delta, 10), float(edge)).verdict == "stable"
        assert judge(cone(delta, 10), float(edge) + 3.1e-3).verdict == "not_converged"
    assert isnan(stable_edge(radians(30), np.radians([50.0]), radians(10))[0])


def test_bad_sweeps_are_refused():
    with pytest.raises(InvalidParameterError, match="friction_angles must increase"):
        sweep_coupled(cone(40, 10), np.array([0.2, 0.1]))
    with pytest.raises(InvalidParameterError, match="out of range"):
        sweep_coupled(cone(40, 10), np.array([-0.1, 0.1]))
