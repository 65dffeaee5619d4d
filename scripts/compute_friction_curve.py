"""Spectral abscissa over wall friction: low modes and line, and the paper's algorithm."""

import logging
from collections.abc import Sequence
from math import atan, tan
from typing import Any

import numpy as np
import xarray as xr

from hopper.domain.borders import tangency_friction
from hopper.domain.stability_map import sweep_friction
from hopper.radial.friction_limit import friction_limit
from hopper.radial.solution import solve_radial
from support import artifacts, fields, hoppers, jobs, maps, paper_checks


def compute_friction_curve(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    half_angle_deg: float,
    deltas_deg: Sequence[float],
    mu: dict[str, Any],
    check: dict[str, Any],
) -> None:
    """Sweep mu for every delta, and check a few points of each curve by the paper's algorithm."""
    friction = fields.axis(0, **mu)
    points, meshes = check["points"], {name: check[name] for name in check if name != "points"}
    sweeps, ends, checked, solutions = [], [], [], []
    for delta in deltas_deg:
        hopper = hoppers.mohr_coulomb(geometry, delta, half_angle_deg)
        sweeps.append(sweep_friction(hopper, np.arctan(friction)))
        tangency = tangency_friction(hopper)
        limit = friction_limit(hopper).friction_angle
        ends.append((np.nan if tangency is None else tan(tangency), tan(limit)))
        last = min(tan(limit if tangency is None else tangency), mu["stop"])
        checked.append(np.linspace(0, last, points + 1)[:-1])
        solutions += [solve_radial(hopper, atan(value)) for value in checked[-1]]
        logging.info("%s, delta = %g deg: tangency at mu = %.6f", geometry, delta, ends[-1][0])
    over, at = ("delta", "mu"), ("delta", "check")
    dataset = xr.Dataset(
        {
            "abscissa": fields.number(over, [s.abscissa for s in sweeps], "supremum of Re(lambda)"),
            "line": fields.number(over, [s.line for s in sweeps], "asymptotic line"),
            "highest_mode": fields.number(
                over, [s.highest_mode for s in sweeps], "largest real part of a low mode"
            ),
            "abscissa_error": fields.number(
                over, [s.error_estimate for s in sweeps], "error estimate of the abscissa"
            ),
            "region": maps.region(over, [s.region for s in sweeps]),
            "tangency_mu": fields.number("delta", [e[0] for e in ends], "mu at the tangency"),
            "limit_mu": fields.number("delta", [e[1] for e in ends], "largest mu with a solution"),
            "check_mu": fields.number(at, checked, "mu of the checked point"),
            **paper_checks.check_variables(at, solutions, np.shape(checked), **meshes),
        },
        coords={
            "delta": fields.angle("delta", list(deltas_deg), "angle of internal friction"),
            "mu": fields.number("mu", friction, "coefficient of wall friction"),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Influence of wall friction on stability, {geometry}",
        equations="(4.1), (4.2)",
        parameters={
            "geometry": geometry,
            "half_angle_deg": half_angle_deg,
            "deltas_deg": list(deltas_deg),
            "mu": mu,
            "check": check,
        },
    )


if __name__ == "__main__":
    jobs.run(compute_friction_curve, snakemake)  # type: ignore[name-defined]  # noqa: F821
