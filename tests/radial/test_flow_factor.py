"""Flow factors against their definition and the published Jenike chart."""

import csv
from math import degrees, radians, sin
from pathlib import Path

import numpy as np
import pytest

from hopper import Hopper, flow_factor, solve_radial
from hopper.problem import as_geometry
from tests.radial import witness

CHART = Path(__file__).parents[2] / "resources" / "jenike_chart_delta40.csv"


def test_flow_factors_of_the_published_chart():
    with CHART.open() as file:
        points = [row for row in csv.DictReader(file) if float(row["phi_w_deg"]) >= 2]
    assert len(points) == 49
    deviation = []
    for point in points:
        delta, half_angle = (radians(float(point[name])) for name in ("delta_deg", "theta_deg"))
        hopper = Hopper(as_geometry(point["geometry"]), delta, half_angle)
        computed = flow_factor(solve_radial(hopper, radians(float(point["phi_w_deg"]))))
        deviation.append(computed / float(point["ff_chart"]) - 1)
    assert np.sqrt(np.mean(np.square(deviation))) < 0.03
    assert np.abs(deviation).max() < 0.08


@pytest.mark.parametrize(
    ("geometry", "h"), [("cone", lambda deg: 2 + deg / 60), ("wedge", lambda deg: 1 + deg / 180)]
)
@pytest.mark.parametrize("half_angle", [8, 30])
def test_flow_factor_from_its_definition(geometry, h, half_angle):
    """Major stress at the wall over the stress of an arch of span 2 r sin(theta_w)."""
    hopper = Hopper(geometry, radians(40), radians(half_angle))
    solution = solve_radial(hopper, radians(10))
    model, k, s = witness.describe(hopper)
    wall = witness.shoot(model, k, s, solution.sigma_axis, np.array([hopper.half_angle]))[:, 0]
    (rr, tt, rt, _), _ = witness.components(model, s, wall[1])
    major = wall[0] * np.linalg.eigvalsh([[rr, rt], [rt, tt]])[1]
    arch = 2 * sin(hopper.half_angle) / h(degrees(hopper.half_angle))
    assert flow_factor(solution) == pytest.approx(major / arch, rel=1e-10)
