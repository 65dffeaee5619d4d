"""The paper's algorithm along curves, and curves up to the limit of friction."""

from math import radians, tan
from typing import Any

import numpy as np
import pytest

from hopper_workflow import columns, paper_checks, ranges
from compute_friction_curve import compute_friction_curve
from compute_paper_border import compute_paper_border
from hopper import Hopper, friction_limit, linear_stability, solve_radial
from hopper_data.reading import as_xarray

MESHES: dict[str, Any] = {"nodes": 400, "coarse_nodes": 200, "tolerance": 1e-3}


def test_values_close_in_on_the_end():
    values = ranges.closing_in(2.0, 101)
    assert values[0] == 0
    assert np.all(np.diff(values) > 0)
    assert 0 < 1 - values[-1] / 2 <= 1.1e-10
    np.testing.assert_allclose(np.diff(np.sqrt(1 - values / 2)), -0.01, atol=2e-5)


def test_a_tolerance_that_keeps_nothing_leaves_a_gap_and_its_reason():
    hopper = Hopper("cone", radians(40), radians(20))
    at = [(hopper, 0.1), (hopper, 0.2)]
    found = paper_checks.compared(at, nodes=40, coarse_nodes=20, tolerance=1e-15)
    assert found["check_reason"].tolist() == [1, 1]
    assert np.isnan(found["check_as_worded"]).all()
    assert np.isnan(found["check_difference_physical"]).all()
    ours = [linear_stability(solve_radial(hopper, phi)).abscissa for _, phi in at]
    assert found["check_abscissa"].tolist() == ours


def test_a_radial_solution_that_is_not_resolved_leaves_a_gap_and_its_reason():
    hopper = Hopper("wedge", radians(45), radians(10))
    found = paper_checks.compared([(hopper, radians(44.9999))], **MESHES)
    assert found["check_reason"].tolist() == [2]
    assert np.isnan(found["check_abscissa"]).all()


def test_a_curve_to_the_limit_ends_where_the_fold_is_neutral():
    data = as_xarray(
        compute_friction_curve(
            geometry="cone", half_angle_deg=30, deltas_deg=[35], mu={"stop": "limit", "points": 9}
        )
    )
    limit = tan(friction_limit(Hopper("cone", radians(35), radians(30))).friction_angle)
    assert float(data.limit_mu[0]) == pytest.approx(limit, rel=1e-12)
    assert limit * (1 - 2e-10) < float(data.mu[0, -1]) < limit
    # A real mode passes 0 with the root of the distance to the fold, here 1e-5 of its scale.
    assert -1e-3 < float(data.abscissa[0, -1]) < 1e-6
    assert np.all(data.abscissa[0, :-1] < -0.3)
    assert "check_mu" not in data


def test_a_curve_that_reaches_its_limit_before_the_range_does_ends_there():
    data = as_xarray(
        compute_friction_curve(
            geometry="cone", half_angle_deg=30, deltas_deg=[35, 25], mu={"stop": 0.35, "points": 5}
        )
    )
    assert float(data.mu[0, -1]) == pytest.approx(float(data.limit_mu[0]), rel=2e-10)
    np.testing.assert_allclose(data.mu[1], np.linspace(0, 0.35, 5), rtol=1e-12)


def test_the_papers_border_has_a_sign_change_and_a_jump(monkeypatch):
    """Cone 30 deg at phi = 10 deg, where its abscissa jumps from .068 upwards near 30.1 deg."""
    border = {"neutral_phi": np.array([0.0, 20.0])}
    monkeypatch.setattr(columns, "read", lambda *_: border)
    data = as_xarray(
        compute_paper_border(
            "",
            half_angle_deg=30,
            frictions=2,
            delta_deg={"start": 28, "stop": 32, "step": 2},
            width_deg=0.01,
            **MESHES,
        )
    )
    data = data.isel(change=data.change_phi == 10)
    assert data.sizes["change"] == 2
    jump, change = (data.isel(change=index) for index in (0, 1))
    assert [int(one.jump) for one in (jump, change)] == [1, 0]
    assert float(jump.change_delta) == pytest.approx(30.1, abs=0.1)
    assert float(jump.before) == pytest.approx(0.068, abs=2e-3)
    assert float(jump.after - jump.before) > 0.05
    assert float(change.before) > 0 > float(change.after)
    assert np.all(data.change_error <= 0.005)
    # Where the sound abscissa vanishes, the paper's is still positive.
    assert float(change.change_delta) > 28.86
