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
SCALARS: Table = (
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


def over_theta(result: RadialSolution | VelocityField) -> tuple[dict[str, Any], Table]:
    """Return the fields of a solution or of its velocity over the hopper, and their table."""
    if isinstance(result, VelocityField):
        theta = angles(result.half_angle)
        return {"theta": theta, "u": result.at(theta)}, VELOCITY
    theta = angles(result.hopper.half_angle)
    sigma, psi, _, _ = result.fields(theta)
    return {"theta": theta, "sigma": sigma, "psi": psi}, STRESS
