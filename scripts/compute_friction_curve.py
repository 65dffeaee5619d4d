"""Spectral abscissa over wall friction: low modes and line, and the paper's algorithm."""

import logging
from collections.abc import Sequence
from dataclasses import replace
from math import atan, tan
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, paper_checks, ranges
from hopper.domain.borders import tangency_friction
from hopper.domain.stability_map import sweep_friction
from hopper.problem import Hopper
from hopper.radial.friction_limit import friction_limit
from hopper_data.contents import CfDataset
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
    check: dict[str, Any] | None = None,
) -> CfDataset:
    """Sweep mu for every delta, and compute points of each curve by the paper's algorithm.

    A curve ends at the limit of friction where that comes before the end of the range.
    """
    hoppers = [hopper_of(geometry, delta, half_angle_deg) for delta in deltas_deg]
    ends = [_ends(hopper) for hopper in hoppers]
    frictions = [_frictions(end["limit"], **mu) for end in ends]
    result = {
        "sweeps": [
            sweep_friction(hopper, np.arctan(row))
            for hopper, row in zip(hoppers, frictions, strict=True)
        ],
        "ends": ends,
        "mu": frictions,
        "check": check and _checked(hoppers, ends, mu["stop"], **check),
        "delta": deltas_deg,
    }
    return dataset(result, TABLE, AXES)


def _frictions(limit: float, stop: float | str, points: int) -> np.ndarray:
    if stop == "limit" or limit <= float(stop):
        return ranges.closing_in(limit, points)
    return ranges.spaced(0, float(stop), points)


def _checked(
    hoppers: Sequence[Hopper],
    ends: Sequence[dict[str, float]],
    stop: float | str,
    points: int,
    **meshes: Any,
) -> dict[str, Any]:
    checked = [_frictions(end["limit"], stop, points) for end in ends]
    at = [
        (hopper, atan(value))
        for hopper, frictions in zip(hoppers, checked, strict=True)
        for value in frictions
    ]
    return {"mu": checked, **paper_checks.compared(at, np.shape(checked), **meshes)}


def _ends(hopper: Hopper) -> dict[str, float]:
    """Return mu at the tangency, NaN without one, and at the limit of radial solutions."""
    tangency = tangency_friction(hopper)
    limit = friction_limit(hopper).friction_angle
    ends = {"tangency": np.nan if tangency is None else tan(tangency), "limit": tan(limit)}
    logging.info("%s: tangency at mu = %.6f", hopper, ends["tangency"])
    return ends


TABLE = (
    *(replace(variable, over="delta point") for variable in within("sweeps", SWEEP)),
    number("mu", "coefficient of wall friction", "delta point"),
    number("tangency_mu", "mu at the tangency", "delta", "ends.tangency"),
    number("limit_mu", "largest mu with a solution", "delta", "ends.limit"),
    number("check_mu", "mu of the checked point", "delta check", "check.mu"),
    *within("check", paper_checks.table("delta check")),
)
AXES = (in_degrees("delta", "angle of internal friction", "delta"),)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_friction_curve,
            "Influence of wall friction on stability, {geometry}",
            "(4.1), (4.2)",
        )
    )
