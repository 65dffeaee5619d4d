"""Radial stress and velocity fields over a hopper's cross-section, one per model and friction."""

import logging
from collections.abc import Sequence
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs
from hopper.radial.velocity import solve_velocity
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.radial import FIELD, field
from hopper_data.tables import in_degrees, number, text, within


def solve_radial(
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    models: Sequence[str],
    mu: Sequence[float],
    points: int,
) -> CfDataset:
    """Solve for every model and wall friction; the profiles are over [-theta_w, theta_w]."""
    theta = np.linspace(-half_angle_deg, half_angle_deg, points)
    hopper = (geometry, delta_deg, half_angle_deg)
    fields = [[_field(*hopper, friction, model, theta) for friction in mu] for model in models]
    axes = {"model": models, "mu": mu, "theta": theta}
    return dataset({"field": fields, **axes}, FIELDS, AXES, leading="model mu")


def _field(
    geometry: str, delta: float, half_angle: float, mu: float, model: str, theta_deg: np.ndarray
) -> dict[str, Any]:
    solution = solution_of(geometry, delta, half_angle, mu, model)
    velocity = solve_velocity(solution)
    logging.info("%s, mu = %g: error %.1e", model, mu, velocity.error_estimate)
    return field(solution, np.radians(theta_deg), velocity)


FIELDS = within("field", FIELD)
AXES = (
    text("model", "yield condition", "model"),
    number("mu", "coefficient of wall friction", "mu"),
    in_degrees("theta", "polar angle", "theta"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            solve_radial, "Radial stress and velocity fields", "(2.8)-(2.15), (3.1)-(3.5)"
        )
    )
