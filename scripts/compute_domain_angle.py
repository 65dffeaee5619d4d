"""How the stable domain of cones shrinks with the half opening angle."""

import logging
from collections.abc import Sequence
from math import radians

import numpy as np
import xarray as xr

from hopper.domain.borders import stable_area, tangency_curve
from hopper.domain.neutral import NoNeutralPointError, neutral_curve, neutral_delta
from support import artifacts, fields, jobs


def compute_domain_angle(
    artifact: str,
    provenance: str,
    *,
    half_angles_deg: Sequence[float],
    phis_deg: Sequence[float],
    largest_delta_deg: float,
    neutral_step_deg: float,
    tangency_points: int,
) -> None:
    """Compute the area of the domain up to a largest delta, and neutral deltas."""
    report = jobs.progress(logging.getLogger(), "half angles")
    areas, errors, neutral = [], [], []
    for done, angle in enumerate(half_angles_deg, start=1):
        curve = neutral_curve("cone", radians(angle), radians(neutral_step_deg))
        deltas = np.linspace(curve.delta[-1], radians(largest_delta_deg), tangency_points)
        tangency = tangency_curve("cone", radians(angle), deltas)
        area = stable_area(curve, deltas, tangency)
        areas.append(area)
        errors.append(abs(area - stable_area(curve.thinned(), deltas[::2], tangency[::2])))
        neutral.append([_neutral(angle, phi) for phi in phis_deg])
        report(done, len(half_angles_deg))
    missing = np.isnan(neutral)
    dataset = xr.Dataset(
        {
            "area": fields.angle(
                "half_angle", np.degrees(np.degrees(areas)), "area of the stable domain", "degree2"
            ),
            "area_error": fields.angle(
                "half_angle", np.degrees(np.degrees(errors)), "change of the area on twice the "
                "spacing of points", "degree2",
            ),
            "neutral_delta": fields.angle(
                ("half_angle", "phi"), neutral, "internal friction of neutral stability"
            ),
            "neutral_flag": fields.flag(
                ("half_angle", "phi"), missing, "whether there is a neutral delta",
                ("neutral_point", "tangency_comes_first"),
            ),
        },
        coords={
            "half_angle": fields.angle("half_angle", list(half_angles_deg), "half opening angle"),
            "phi": fields.angle("phi", list(phis_deg), "angle of wall friction"),
        },
    )  # fmt: skip
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Stable domain of cones over the half opening angle",
        equations="(4.1), (4.2)",
        parameters={
            "half_angles_deg": list(half_angles_deg),
            "phis_deg": list(phis_deg),
            "largest_delta_deg": largest_delta_deg,
            "neutral_step_deg": neutral_step_deg,
            "tangency_points": tangency_points,
        },
    )


def _neutral(half_angle_deg: float, phi_deg: float) -> float:
    try:
        return float(np.degrees(neutral_delta("cone", radians(half_angle_deg), radians(phi_deg))))
    except NoNeutralPointError as error:
        logging.info("%s", error)
        return float("nan")


if __name__ == "__main__":
    jobs.run(compute_domain_angle, snakemake)  # type: ignore[name-defined]  # noqa: F821
