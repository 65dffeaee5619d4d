"""Tables of radial fields."""

from typing import Any

import numpy as np

from hopper.arrays import Array
from hopper.radial.solution import RadialSolution
from hopper.radial.velocity import VelocityField
from hopper_data.tables import Table, angle, number

THETA: Table = (angle("theta", "polar angle", "theta"),)
STRESS: Table = (
    number("sigma", "average stress", "theta", scale="rho g r"),
    number("psi", "Sokolovskii angle", "theta", units="radian"),
)
VELOCITY: Table = (number("u", "radial velocity relative to the axis", "theta"),)
FIELD: Table = (
    *STRESS,
    *VELOCITY,
    number("sigma_axis", "average stress on the axis", scale="rho g r"),
    number("sigma_wall", "average stress at the wall", scale="rho g r"),
    number("psi_max", "largest Sokolovskii angle", units="radian"),
    angle("theta_psi_max", "polar angle of the largest psi"),
    number("u_wall", "velocity at the wall relative to the axis"),
    number("error_radial", "error estimate of log(sigma) and psi"),
    number("error_velocity", "error estimate of log(u)"),
)

# Of fields over [-theta_w, theta_w]; odd, so that one is on the axis.
POINTS = 241


def angles(half_angle: float) -> Array:
    """Return POINTS angles over [-half_angle, half_angle], radians."""
    return np.linspace(-half_angle, half_angle, POINTS)


def field(
    solution: RadialSolution, theta: Array, velocity: VelocityField | None = None
) -> dict[str, Any]:
    """Return a radial field at ``theta`` (radians), with its numbers, for the table FIELD."""
    sigma, psi, _, _ = solution.fields(theta)
    theta_psi_max, psi_max = solution.psi_maximum()
    return {
        "sigma": sigma,
        "psi": psi,
        "u": velocity.at(theta) if velocity else None,
        "sigma_axis": solution.sigma_axis,
        "sigma_wall": solution.sigma_wall,
        "psi_max": psi_max,
        "theta_psi_max": theta_psi_max,
        "u_wall": velocity.wall if velocity else None,
        "error_radial": solution.error_estimate,
        "error_velocity": velocity.error_estimate if velocity else None,
    }


def over_theta(result: RadialSolution | VelocityField) -> tuple[dict[str, Any], Table]:
    """Return a solution or a velocity over [-theta_w, theta_w], and its table."""
    if isinstance(result, VelocityField):
        theta = angles(result.half_angle)
        return {"theta": theta, "u": result.at(theta)}, VELOCITY
    theta = angles(result.hopper.half_angle)
    return {"theta": theta, **field(result, theta)}, FIELD
