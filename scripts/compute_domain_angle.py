"""How the stable domain of cones shrinks with the half opening angle."""

import logging
from collections.abc import Sequence
from math import radians
from typing import Any

import numpy as np
import xarray as xr

from hopper_workflow import artifacts, jobs
from hopper.domain.borders import stable_area, tangency_curve
from hopper.domain.neutral import NoNeutralPointError, neutral_curve, neutral_delta
from hopper_data.datasets import dataset
from hopper_data.tables import angle, flag, in_degrees


def compute_domain_angle(
    *,
    half_angles_deg: Sequence[float],
    phis_deg: Sequence[float],
    largest_delta_deg: float,
    neutral_step_deg: float,
    tangency_points: int,
) -> xr.Dataset:
    """Compute the area of the domain up to a largest delta, and neutral deltas."""
    report = jobs.progress(logging.getLogger(), "half angles")
    domains: list[dict[str, Any]] = []
    for half_angle in half_angles_deg:
        curve = neutral_curve("cone", radians(half_angle), radians(neutral_step_deg))
        deltas = np.linspace(curve.delta[-1], radians(largest_delta_deg), tangency_points)
        tangency = tangency_curve("cone", radians(half_angle), deltas)
        area = stable_area(curve, deltas, tangency)
        coarse = stable_area(curve.thinned(), deltas[::2], tangency[::2])
        neutral = [_neutral(half_angle, phi) for phi in phis_deg]
        domains.append(
            {
                "area": area,
                "area_error": abs(area - coarse),
                "neutral_delta": neutral,
                "missing": np.isnan(neutral),
            }
        )
        report(len(domains), len(half_angles_deg))
    axes = {"half_angle": half_angles_deg, "phi": phis_deg}
    return dataset({"domains": domains, **axes}, TABLE, AXES)


def _neutral(half_angle_deg: float, phi_deg: float) -> float:
    try:
        return neutral_delta("cone", radians(half_angle_deg), radians(phi_deg))
    except NoNeutralPointError as error:
        logging.info("%s", error)
        return float("nan")


TABLE = (
    angle("area", "area of the stable domain", "half_angle", "domains.area", power=2),
    angle(
        "area_error",
        "change of the area on twice the spacing of points",
        "half_angle",
        "domains.area_error",
        power=2,
    ),
    angle(
        "neutral_delta",
        "internal friction of neutral stability",
        "half_angle phi",
        "domains.neutral_delta",
    ),
    flag(
        "neutral_flag",
        "whether there is a neutral delta",
        ("neutral_point", "tangency_comes_first"),
        "half_angle phi",
        "domains.missing",
    ),
)
AXES = (
    in_degrees("half_angle", "half opening angle", "half_angle"),
    in_degrees("phi", "angle of wall friction", "phi"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_domain_angle,
            "Stable domain of cones over the half opening angle",
            "(4.1), (4.2)",
        )
    )
