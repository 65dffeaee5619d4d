"""Flow factors against their definition and the published Jenike chart."""

import csv
from math import degrees, radians, sin
from pathlib import Path

import numpy as np
import pytest

from hopper import Hopper, flow_factor, solve_radial
from hopper.problem import as_geometry
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
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


@pytest.mark.parametrize("half_angle", [8, 20, 30])
@pytest.mark.parametrize("phi", [0, 10, 18])
def test_flow_factor_of_von_mises_materials(half_angle, phi):
    """The largest eigenvalue of the stress at the wall: sigma (1 + sin delta) is none there."""
    hopper = Hopper("cone", radians(40), radians(half_angle), VON_MISES)
    solution = solve_radial(hopper, radians(phi))
    model, k, s = witness.describe(hopper)
    wall = witness.shoot(model, k, s, solution.sigma_axis, np.array([hopper.half_angle]))[:, 0]
    (rr, tt, rt, pp), _ = witness.components(model, s, wall[1])
    major = wall[0] * np.linalg.eigvalsh([[rr, rt, 0], [rt, tt, 0], [0, 0, pp]])[-1]
    arch = 2 * sin(hopper.half_angle) / (2 + half_angle / 60)
    assert flow_factor(solution) == pytest.approx(major / arch, rel=1e-10)
    if (half_angle, phi) == (20, 10):
        assert flow_factor(solution) == pytest.approx(1.586395, abs=1e-6)


@pytest.mark.parametrize("material", [MOHR_COULOMB, VON_MISES])
@pytest.mark.parametrize("delta", [5, 30, 45, 80])
def test_principal_stresses_are_eigenvalues(material, delta):
    psi = np.linspace(-1.5, 1.5, 61)
    sigma = np.linspace(0.1, 3, 61)
    s = sin(radians(delta))
    model = {MOHR_COULOMB: "mohr-coulomb", VON_MISES: "von-mises"}[material]
    (rr, tt, rt, pp), _ = witness.components(model, s, psi)
    major, minor = material.principal_stresses(radians(delta), sigma, psi)
    expected = np.linalg.eigvalsh(np.moveaxis(np.array([[rr, rt], [rt, tt]]), -1, 0))
    np.testing.assert_allclose(major, sigma * expected[:, 1], rtol=1e-13)
    np.testing.assert_allclose(minor, sigma * expected[:, 0], rtol=1e-12, atol=1e-14)
    # The stress across the plane is never the largest.
    assert np.all(sigma * pp <= major * (1 + 1e-14))
