"""Flow factors of Jenike's chart: curves over wall friction, and the published points."""

import logging
from math import radians

import numpy as np
import pandas as pd
import xarray as xr

from hopper.errors import NoRadialSolutionError
from hopper.problem import Hopper, as_geometry
from hopper.radial.flow_factor import flow_factor
from hopper.radial.solution import solve_radial
from support import artifacts, fields, jobs


def compute_flow_factor(
    chart: str,
    artifact: str,
    provenance: str,
    *,
    friction_angles_deg: dict[str, float],
    least_friction_deg: float,
) -> None:
    """Compute flow factors at the chart's points, and along a curve for each of its hoppers."""
    published = pd.read_csv(chart)
    grid = fields.steps(**friction_angles_deg)
    hoppers = published[["geometry", "delta_deg", "theta_deg"]].drop_duplicates()
    # NaN beyond the largest friction that has a solution: the curve ends there.
    curves = np.full((len(hoppers), grid.size), np.nan)
    computed = np.empty(len(published))
    errors = np.empty(len(published))
    for i, (geometry, delta, angle) in enumerate(hoppers.itertuples(index=False)):
        hopper = Hopper(as_geometry(geometry), radians(delta), radians(angle))
        for j, phi in enumerate(grid):
            try:
                curves[i, j] = flow_factor(solve_radial(hopper, radians(phi)))
            except NoRadialSolutionError:
                logging.info("%s %g deg: curve ends at phi = %g deg", geometry, angle, phi)
                break
        mine = (published.geometry == geometry) & (published.theta_deg == angle)
        for row in np.flatnonzero(mine):
            solution = solve_radial(hopper, radians(published.phi_w_deg[row]))
            computed[row], errors[row] = flow_factor(solution), solution.error_estimate
    deviation = computed / published.ff_chart.to_numpy() - 1
    counted = published.phi_w_deg.to_numpy() >= least_friction_deg
    rms = float(np.sqrt(np.mean(deviation[counted] ** 2)))
    logging.info("RMS deviation from the chart: %.2f %% over %d points", 100 * rms, counted.sum())
    dataset = xr.Dataset(
        {
            "curve_geometry": ("curve", hoppers.geometry.to_list(), {"long_name": "geometry"}),
            "curve_half_angle": ("curve", hoppers.theta_deg.to_numpy(), _HALF_ANGLE),
            "curve_flow_factor": (("curve", "phi"), curves, _FLOW_FACTOR),
            "point_geometry": ("point", published.geometry.to_list(), {"long_name": "geometry"}),
            "point_half_angle": ("point", published.theta_deg.to_numpy(), _HALF_ANGLE),
            "point_phi": ("point", published.phi_w_deg.to_numpy(), _PHI),
            "published": (
                "point",
                published.ff_chart.to_numpy(),
                {"long_name": "flow factor read off the published chart", "units": "1"},
            ),
            "computed": ("point", computed, _FLOW_FACTOR),
            "error_estimate": (
                "point",
                errors,
                {"long_name": "relative error estimate of the computed flow factor", "units": "1"},
            ),
            "rms_deviation": (
                (),
                rms,
                {"long_name": "RMS relative deviation from the chart", "units": "1"},
            ),
        },
        coords={"phi": ("phi", grid, _PHI)},
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Flow factors against the published Jenike chart",
        equations="(2.8)-(2.15), (3.1), (3.3); Jenike (1964)",
        parameters={
            "friction_angles_deg": friction_angles_deg,
            "least_friction_deg": least_friction_deg,
        },
    )


_HALF_ANGLE = {"long_name": "half opening angle", "units": "degree"}
_PHI = {"long_name": "angle of wall friction", "units": "degree"}
_FLOW_FACTOR = {"long_name": "computed flow factor", "units": "1"}

if __name__ == "__main__":
    jobs.run(compute_flow_factor, snakemake)  # type: ignore[name-defined]  # noqa: F821
