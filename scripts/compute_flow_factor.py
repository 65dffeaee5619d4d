"""Flow factors of Jenike's chart: curves over wall friction, and the published points."""

import logging
from math import radians

import numpy as np
import pandas as pd

from hopper_workflow import artifacts, jobs, ranges
from hopper.errors import NoRadialSolutionError
from hopper.problem import Hopper
from hopper.radial.flow_factor import flow_factor
from hopper.radial.solution import solve_radial
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import hopper_of
from hopper_data.tables import in_degrees, number, text


def compute_flow_factor(
    chart: str, *, friction_angles_deg: dict[str, float], least_friction_deg: float
) -> CfDataset:
    """Compute flow factors at the chart's points, and along a curve for each of its hoppers."""
    published = pd.read_csv(chart)
    grid = ranges.steps(**friction_angles_deg)
    columns = {name: published[name].to_list() for name in published}
    rows = list(zip(*(columns[name] for name in _HOPPER), strict=True))
    hoppers = dict.fromkeys(rows)
    points = [
        solve_radial(hopper_of(*row), radians(phi))
        for row, phi in zip(rows, columns["phi_w_deg"], strict=True)
    ]
    computed = np.array([flow_factor(point) for point in points])
    deviation = computed / published.ff_chart.to_numpy() - 1
    counted = published.phi_w_deg.to_numpy() >= least_friction_deg
    rms = float(np.sqrt(np.mean(deviation[counted] ** 2)))
    of = {shape: counted & (published.geometry.to_numpy() == shape) for shape in GEOMETRIES}
    logging.info("RMS deviation from the chart: %.2f %% over %d points", 100 * rms, counted.sum())
    result = {
        "hoppers": [dict(zip(_HOPPER, row, strict=True)) for row in hoppers],
        "curves": [_curve(hopper_of(*row), grid) for row in hoppers],
        "published": columns,
        "points": points,
        "computed": computed,
        "rms_deviation": rms,
        "rms": [float(np.sqrt(np.mean(deviation[chosen] ** 2))) for chosen in of.values()],
        "geometry": list(of),
        "delta": _only(columns["delta_deg"]),
        "phi": grid,
    }
    return dataset(result, TABLE, AXES)


def _only(values: list[float]) -> float:
    """Return the value that all have."""
    (value,) = set(values)
    return value


def _curve(hopper: Hopper, friction_angles_deg: np.ndarray) -> np.ndarray:
    """Return flow factors, NaN beyond the largest friction that has a solution."""
    curve = np.full(friction_angles_deg.size, np.nan)
    for j, phi in enumerate(friction_angles_deg):
        try:
            curve[j] = flow_factor(solve_radial(hopper, radians(phi)))
        except NoRadialSolutionError as error:
            logging.info("%s: curve ends: %s", hopper.geometry, error)
            break
    return curve


GEOMETRIES = ("wedge", "cone")
_HOPPER = ("geometry", "delta_deg", "theta_deg")
TABLE = (
    text("curve_geometry", "geometry", "curve", "hoppers.geometry"),
    in_degrees("curve_half_angle", "half opening angle", "curve", "hoppers.theta_deg"),
    number("curve_flow_factor", "computed flow factor", "curve phi", "curves"),
    text("point_geometry", "geometry", "point", "published.geometry"),
    in_degrees("point_half_angle", "half opening angle", "point", "published.theta_deg"),
    in_degrees("point_phi", "angle of wall friction", "point", "published.phi_w_deg"),
    number("published", "flow factor read off the published chart", "point", "published.ff_chart"),
    number("computed", "computed flow factor", "point"),
    number(
        "error_estimate",
        "relative error estimate of the computed flow factor",
        "point",
        "points.error_estimate",
    ),
    number("rms_deviation", "RMS relative deviation from the chart"),
    number("rms", "the same for each geometry", "geometry"),
    in_degrees("delta", "angle of internal friction of the chart", source="delta"),
)
AXES = (
    text("geometry", "shape of the hopper", "geometry"),
    in_degrees("phi", "angle of wall friction", "phi"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_flow_factor,
            "Flow factors against the published Jenike chart",
            "(2.8)-(2.15), (3.1), (3.3); Jenike (1964)",
        )
    )
