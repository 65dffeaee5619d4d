"""The limit of vanishing stress on the axis: the classical mass-flow limit of conical hoppers.

For Mohr-Coulomb cones the family of radial solutions ends, as sigma_0 -> 0, in the exact solution
sigma = sin(theta) / (2 s sin 2gamma), psi = gamma - theta, with
2 gamma = pi - arccos((1 - s) / (2 s)). The friction of a wall along which it slips is the limit
that Jenike's charts draw between mass flow and funnel flow.
"""

from math import acos, asin, degrees, pi

import numpy as np

from hopper.arguments import Radians, RealLike, checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.problem import Hopper, as_angles
from hopper.values import require_angle
from hopper.yield_conditions import MOHR_COULOMB

_LEAST_SIN_DELTA = 1 / 3
# The least delta (radians) with a limit in closed form.
LEAST_DELTA = asin(_LEAST_SIN_DELTA)


def _apex_angle(hopper: Hopper) -> float:
    if hopper.geometry != "cone" or hopper.material != MOHR_COULOMB:
        raise InvalidParameterError(
            "the mass-flow limit is known in closed form for Mohr-Coulomb cones only: "
            "use geometry = cone and model = mohr-coulomb"
        )
    if hopper.s < _LEAST_SIN_DELTA:
        raise InvalidParameterError(
            f"delta = {degrees(hopper.delta):.6g} deg has no mass-flow limit: it needs "
            f"delta >= {degrees(LEAST_DELTA):.4f} deg (sin delta >= 1/3)"
        )
    return (pi - acos((1 - hopper.s) / (2 * hopper.s))) / 2


@checked
def limiting_fields(hopper: Hopper, theta: RealLike) -> tuple[Array, Array]:
    """Return sigma (units of rho g r) and psi (radians) of the limit at ``theta`` > 0 (radians).

    Raises
    ------
    InvalidParameterError
        If the hopper is not a Mohr-Coulomb cone with sin(delta) >= 1/3, or an angle lies outside.
    """
    gamma = _apex_angle(hopper)
    theta = as_angles("theta", theta)
    if not np.all((theta > 0) & (theta <= hopper.half_angle * (1 + 1e-12))):
        raise InvalidParameterError(
            f"theta must lie in (0, half_angle = {degrees(hopper.half_angle):.6g} deg]"
        )
    return np.sin(theta) / (2 * hopper.s * np.sin(2 * gamma)), gamma - theta


@checked
def limiting_wall_angle(hopper: Hopper) -> float:
    """Return psi(theta_w) of the limit, radians; negative where the limit needs no friction.

    Raises
    ------
    InvalidParameterError
        As :func:`limiting_fields`.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.radial.mass_flow import limiting_wall_angle
    >>> round(limiting_wall_angle(Hopper("cone", delta=0.7, half_angle=0.35)), 4)
    0.5753
    """
    return _apex_angle(hopper) - hopper.half_angle


@checked
def mass_flow_friction_angle(hopper: Hopper) -> float:
    """Return the wall friction angle phi (radians) of the mass-flow limit, at least 0.

    Raises
    ------
    InvalidParameterError
        As :func:`limiting_fields`.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.radial.mass_flow import mass_flow_friction_angle
    >>> round(mass_flow_friction_angle(Hopper("cone", delta=0.7, half_angle=0.35)), 4)
    0.4359
    """
    return max(0.0, hopper.material.friction_angle(hopper.delta, limiting_wall_angle(hopper)))


@checked
def mass_flow_half_angle(hopper: Hopper, friction_angle: Radians) -> float:
    """Return the half angle (radians) up to which a wall of friction ``friction_angle`` slips.

    Raises
    ------
    InvalidParameterError
        As :func:`limiting_fields`.
    WallFrictionError
        If the material cannot transmit the wall's friction.

    Examples
    --------
    >>> from hopper import Hopper, mass_flow_half_angle
    >>> round(mass_flow_half_angle(Hopper("cone", 0.7, 0.35), friction_angle=0.25), 4)
    0.6032
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    return _apex_angle(hopper) - hopper.material.wall_angle(hopper.delta, friction_angle)
