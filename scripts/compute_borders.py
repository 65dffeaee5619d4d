"""Borders of the stable domain: neutral curve and limit of friction, and levels of psi."""

import logging
from dataclasses import replace
from functools import partial
from math import radians
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, paper_checks, ranges
from hopper.domain.borders import traced_borders
from hopper.domain.growth import ROOT_TOLERANCE
from hopper.domain.neutral_curve import NeutralCurve, neutral_curve
from hopper.domain.neutral_points import neutral_delta
from hopper.problem import Geometry, Hopper, as_geometry
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.domain import BORDERS, NEUTRAL_CURVE
from hopper_data.tables import angle, in_degrees, within


def compute_borders(
    *,
    geometry: str,
    half_angle_deg: float,
    neutral_step_deg: float,
    delta_deg: dict[str, Any],
    chord_deg: float,
    check: dict[str, Any],
) -> CfDataset:
    """Trace the neutral curve and the borders over delta; each point is a root of an equation.

    A few points of the neutral curve, its end left out, are checked by the paper's algorithm.
    """
    shape, half_angle = as_geometry(geometry), radians(half_angle_deg)
    axis = ranges.spaced(**delta_deg)
    trace = partial(neutral_curve, shape, half_angle, radians(neutral_step_deg), radians(axis[-1]))
    neutral = trace()
    logging.info("%s, %g deg: %s", geometry, half_angle_deg, neutral)
    limits = traced_borders(shape, half_angle, np.radians(axis), radians(chord_deg))
    result = {
        "neutral": neutral,
        "symmetric": trace("symmetric") if shape == "wedge" else None,
        "neutral_error": ROOT_TOLERANCE,
        "check": _check(shape, half_angle, neutral, **check),
        "borders": limits,
        "delta": np.degrees(limits.delta),
    }
    return dataset(result, TABLE, AXES)


def _check(
    geometry: Geometry, half_angle: float, neutral: NeutralCurve, *, points: int, **meshes: Any
) -> dict[str, Any]:
    # At given frictions, not at points of the curve, whose number depends on rounding.
    frictions = neutral.friction_angle[-1] * np.arange(points) / points
    guesses = neutral.first_delta(frictions)
    deltas = [
        neutral_delta(geometry, half_angle, phi, guess)
        for phi, guess in zip(frictions, guesses, strict=True)
    ]
    at = [
        (Hopper(geometry, delta, half_angle), float(phi))
        for delta, phi in zip(deltas, frictions, strict=True)
    ]
    return {"delta": deltas, "phi": frictions, **paper_checks.compared(at, **meshes)}


TABLE = (
    *within("neutral", NEUTRAL_CURVE),
    *(
        replace(
            variable,
            name=variable.name.replace("neutral", "symmetric"),
            label=f"{variable.label}, symmetric disturbances only",
            over=variable.over and "symmetric_point",
        )
        for variable in within("symmetric", NEUTRAL_CURVE)
    ),
    angle("neutral_error", "tolerance of neutral_delta"),
    angle("check_delta", "internal friction of a checked neutral point", "check", "check.delta"),
    angle("check_phi", "wall friction of a checked neutral point", "check", "check.phi"),
    *within("check", paper_checks.table("check")),
    *within("borders", BORDERS),
)
AXES = (in_degrees("delta", "angle of internal friction", "delta"),)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_borders, "Borders of the stable domain, {geometry}", "(3.3), (4.1), (4.2)"
        )
    )
