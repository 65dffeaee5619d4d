"""Spectral abscissa over wall friction: low modes and line, and the paper's algorithm."""

import logging
from collections.abc import Sequence
from dataclasses import replace
from math import atan, tan
from typing import Any

import numpy as np
import xarray as xr

from hopper_workflow import artifacts, jobs, paper_checks, ranges
from hopper.domain.borders import tangency_friction
from hopper.domain.stability_map import sweep_friction
from hopper.problem import Hopper
from hopper.radial.friction_limit import friction_limit
from hopper.radial.solution import solve_radial
from hopper_data.datasets import dataset
from hopper_data.domain import SWEEP
from hopper_data.inputs import hopper_of
from hopper_data.tables import in_degrees, number, within


def compute_friction_curve(
    *,
    geometry: str,
    half_angle_deg: float,
    deltas_deg: Sequence[float],
    mu: dict[str, Any],
    check: dict[str, Any],
) -> xr.Dataset:
    """Sweep mu for every delta, and check a few points of each curve by the paper's algorithm."""
    friction = ranges.spaced(0, **mu)
    points, meshes = check["points"], {name: check[name] for name in check if name != "points"}
    hoppers = [hopper_of(geometry, delta, half_angle_deg) for delta in deltas_deg]
    ends = [_ends(hopper) for hopper in hoppers]
    checked = [np.linspace(0, min(end["limit"], mu["stop"]), points + 1)[:-1] for end in ends]
    solutions = [
        solve_radial(hopper, atan(value))
        for hopper, frictions in zip(hoppers, checked, strict=True)
        for value in frictions
    ]
    result = {
        "sweeps": [sweep_friction(hopper, np.arctan(friction)) for hopper in hoppers],
        "ends": ends,
        "check": {"mu": checked, **paper_checks.compared(solutions, np.shape(checked), **meshes)},
        "delta": deltas_deg,
        "mu": friction,
    }
    return dataset(result, TABLE, AXES)


def _ends(hopper: Hopper) -> dict[str, float]:
    """Return mu at the tangency, NaN without one, and at the limit of radial solutions."""
    tangency = tangency_friction(hopper)
    limit = friction_limit(hopper).friction_angle
    ends = {"tangency": np.nan if tangency is None else tan(tangency), "limit": tan(limit)}
    logging.info("%s: tangency at mu = %.6f", hopper, ends["tangency"])
    return ends


TABLE = (
    *(replace(variable, over="delta mu") for variable in within("sweeps", SWEEP)),
    number("tangency_mu", "mu at the tangency", "delta", "ends.tangency"),
    number("limit_mu", "largest mu with a solution", "delta", "ends.limit"),
    number("check_mu", "mu of the checked point", "delta check", "check.mu"),
    *within("check", paper_checks.table("delta check")),
)
AXES = (
    in_degrees("delta", "angle of internal friction", "delta"),
    number("mu", "coefficient of wall friction", "mu"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_friction_curve,
            "Influence of wall friction on stability, {geometry}",
            "(4.1), (4.2)",
        )
    )
