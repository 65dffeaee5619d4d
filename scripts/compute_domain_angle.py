"""How the stable domain of cones shrinks with the half opening angle."""

import logging
from collections.abc import Sequence
from math import ceil, isnan, radians
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs
from hopper.arrays import Array
from hopper.domain.borders import borders, stable_area
from hopper.domain.neutral_curve import NeutralCurve, neutral_curve
from hopper.domain.neutral_points import neutral_delta
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import Table, angle, flag, in_degrees


def compute_domain_angle(
    *,
    half_angles_deg: Sequence[float],
    phis_deg: Sequence[float],
    largest_delta_deg: float,
    neutral_step_deg: float,
    curve_points: int,
) -> CfDataset:
    """Compute the area of the domain up to a largest delta, and neutral deltas.

    Neutral deltas are roots at each half angle, and at as many in between as curves need.
    """
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
    order = np.argsort(half_angles_deg)
    ends = np.array(half_angles_deg, dtype=float)[order]
    known = np.array([domains[index]["neutral_delta"] for index in order])
    at = np.linspace(ends[0], ends[-1], curve_points)
    curves = [
        _between(radians(phi), np.radians(at), np.interp(at, ends, deltas))
        for phi, deltas in zip(phis_deg, known.T, strict=True)
    ]
    axes = {"half_angle": half_angles_deg, "phi": phis_deg, "curve_half_angle": at}
    return dataset({"domains": domains, "curve_delta": np.array(curves).T, **axes}, TABLE, AXES)


def _between(phi: float, half_angles: Array, guesses: Array) -> list[float]:
    """Return the neutral delta (radians) at half angles, NaN where there is no guess."""
    return [
        guess if isnan(guess) else neutral_delta("cone", half_angle, phi, guess)
        for half_angle, guess in zip(half_angles.tolist(), guesses.tolist(), strict=True)
    ]


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
    angle("curve_delta", "the same at half angles in between", "curve_half_angle phi"),
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
    in_degrees("curve_half_angle", "half opening angle", "curve_half_angle"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_domain_angle,
            "Stable domain of cones over the half opening angle",
            "(4.1), (4.2)",
        )
    )
