"""How the stable domain of cones shrinks with the half opening angle."""

import logging
from collections.abc import Sequence
from math import ceil, isnan, radians
from typing import Any

import numpy as np
import xarray as xr

from hopper_workflow import artifacts, jobs
from hopper.domain.borders import borders, stable_area
from hopper.domain.neutral_curve import NeutralCurve, neutral_curve
from hopper.domain.neutral_points import neutral_delta
from hopper_data.datasets import dataset
from hopper_data.tables import Table, angle, flag, in_degrees


def compute_domain_angle(
    *,
    half_angles_deg: Sequence[float],
    phis_deg: Sequence[float],
    largest_delta_deg: float,
    neutral_step_deg: float,
) -> xr.Dataset:
    """Compute the area of the domain up to a largest delta, and neutral deltas."""
    report = jobs.progress(logging.getLogger(), "half angles")
    step, largest = radians(neutral_step_deg), radians(largest_delta_deg)
    domains: list[dict[str, Any]] = []
    for half_angle in half_angles_deg:
        curve = neutral_curve("cone", radians(half_angle), step, largest)
        points = max(3, 1 + ceil((largest - curve.delta[-1]) / step))
        limit = borders("cone", radians(half_angle), np.linspace(curve.delta[-1], largest, points))
        areas = np.array(stable_area(curve, limit))
        errors = np.abs(areas - stable_area(curve.thinned(), limit.thinned()))
        neutral = [_neutral(curve, half_angle, phi) for phi in phis_deg]
        domains.append(
            {
                "area": dict(zip(_AREAS, areas, strict=True)),
                "error": dict(zip(_AREAS, errors, strict=True)),
                "neutral_delta": neutral,
                "missing": np.isnan(neutral),
            }
        )
        report(len(domains), len(half_angles_deg))
    axes = {"half_angle": half_angles_deg, "phi": phis_deg}
    return dataset({"domains": domains, **axes}, TABLE, AXES)


def _neutral(curve: NeutralCurve, half_angle_deg: float, phi_deg: float) -> float:
    """Return the neutral delta at one wall friction, NaN above the curve."""
    phi = radians(phi_deg)
    guess = float(curve.first_delta(phi))
    return guess if isnan(guess) else neutral_delta("cone", radians(half_angle_deg), phi, guess)


_AREAS = ("whole", "reached")


def _area(name: str, words: str, which: str) -> Table:
    return (
        angle(name, words, "half_angle", f"domains.area.{which}", power=2),
        angle(
            f"{name}_error",
            "change of it on twice the spacing of points",
            "half_angle",
            f"domains.error.{which}",
            power=2,
        ),
    )


TABLE = (
    *_area("area", "area of the stable domain", "whole"),
    *_area("area_reached", "area of its part where radial flow reaches the wall", "reached"),
    angle(
        "neutral_delta",
        "internal friction of neutral stability",
        "half_angle phi",
        "domains.neutral_delta",
    ),
    flag(
        "neutral_flag",
        "whether there is a neutral delta",
        ("neutral_point", "no_neutral_point"),
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
