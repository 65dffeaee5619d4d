"""Radial stress and velocity fields over a hopper's cross-section, one per model and friction."""

import logging
from collections.abc import Sequence
from math import atan, degrees, radians

import numpy as np
import xarray as xr

from hopper.problem import Hopper, as_geometry
from hopper.radial.solution import solve_radial as solve
from hopper.radial.velocity import solve_velocity
from hopper.yield_conditions import yield_condition
from support import artifacts, jobs


def solve_radial(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    models: Sequence[str],
    mu: Sequence[float],
    points: int,
) -> None:
    """Solve for every model and wall friction and write the profiles over [-theta_w, theta_w]."""
    theta_deg = np.linspace(-half_angle_deg, half_angle_deg, points)
    shape = (len(models), len(mu))
    profiles = {name: np.empty((*shape, points)) for name in ("sigma", "psi", "u")}
    scalars = {name: np.empty(shape) for name in _SCALARS}
    for i, model in enumerate(models):
        hopper = Hopper(
            as_geometry(geometry),
            radians(delta_deg),
            radians(half_angle_deg),
            yield_condition(model),
        )
        for j, friction in enumerate(mu):
            solution = solve(hopper, atan(friction))
            velocity = solve_velocity(solution)
            theta = np.radians(theta_deg)
            profiles["sigma"][i, j], profiles["psi"][i, j], _, _ = solution.fields(theta)
            profiles["u"][i, j] = velocity.at(theta)
            peak, psi_max = solution.psi_maximum()
            scalars["sigma_axis"][i, j] = solution.sigma_axis
            scalars["sigma_wall"][i, j] = solution.sigma_wall
            scalars["psi_max"][i, j] = psi_max
            scalars["theta_psi_max"][i, j] = degrees(peak)
            scalars["u_wall"][i, j] = velocity.wall
            scalars["error_radial"][i, j] = solution.error_estimate
            scalars["error_velocity"][i, j] = velocity.error_estimate
            logging.info("%s, mu = %g: error %.1e", model, friction, velocity.error_estimate)
    data: dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, str]]] = {
        name: (("model", "mu", "theta"), values, _PROFILES[name])
        for name, values in profiles.items()
    }
    data |= {name: (("model", "mu"), scalars[name], _SCALARS[name]) for name in scalars}
    dataset = xr.Dataset(
        data,
        coords={
            "model": ("model", list(models), {"long_name": "yield condition"}),
            "mu": ("mu", list(mu), {"long_name": "coefficient of wall friction", "units": "1"}),
            "theta": ("theta", theta_deg, {"long_name": "polar angle", "units": "degree"}),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Radial stress and velocity fields",
        equations="(2.8)-(2.15), (3.1)-(3.5)",
        parameters={
            "geometry": geometry,
            "delta_deg": delta_deg,
            "half_angle_deg": half_angle_deg,
            "models": list(models),
            "mu": list(mu),
            "points": points,
        },
    )


_PROFILES = {
    "sigma": {"long_name": "average stress over rho g r", "units": "1"},
    "psi": {"long_name": "Sokolovskii angle", "units": "radian"},
    "u": {"long_name": "radial velocity relative to the axis", "units": "1"},
}
_SCALARS = {
    "sigma_axis": {"long_name": "average stress on the axis over rho g r", "units": "1"},
    "sigma_wall": {"long_name": "average stress at the wall over rho g r", "units": "1"},
    "psi_max": {"long_name": "largest Sokolovskii angle", "units": "radian"},
    "theta_psi_max": {"long_name": "polar angle of the largest psi", "units": "degree"},
    "u_wall": {"long_name": "velocity at the wall relative to the axis", "units": "1"},
    "error_radial": {"long_name": "error estimate of log(sigma) and psi", "units": "1"},
    "error_velocity": {"long_name": "error estimate of log(u)", "units": "1"},
}

if __name__ == "__main__":
    jobs.run(solve_radial, snakemake)  # type: ignore[name-defined]  # noqa: F821
