"""Limits of a hopper's wall friction."""

from dataclasses import dataclass, replace
from math import pi, tan

import numpy as np

from hopper.arguments import checked
from hopper.assessment.propagation import ROUNDING, with_errors
from hopper.brief import brief
from hopper.domain.borders import tangency_friction
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NoRadialSolutionError,
)
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.friction_limit import FrictionLimit, friction_limit
from hopper.radial.mass_flow import mass_flow_friction_angle
from hopper.radial.solution import solve_radial
from hopper.yield_conditions import MOHR_COULOMB

# Step in phi for a slope, radians.
_STEP = 1e-6


@dataclass(frozen=True)
class Limits:
    """Limits of a hopper's wall friction, whatever the friction of its own wall.

    Attributes
    ----------
    friction : FrictionLimit or None
        Largest friction with a radial solution, and what ends the branch there; None where it is
        not resolved or not even a smooth wall has a solution.
    coefficient : Quantity or None
        The same as mu = tan(phi).
    mass_flow : Quantity or None
        phi of sigma_0 -> 0, radians; None but for Mohr-Coulomb cones with sin(delta) >= 1/3.
    tangency : Quantity or None
        mu at which psi reaches pi/4 - delta/2, where a characteristic is tangent to the arc
        r = const; None where it does not, and for von Mises materials.
    """

    friction: FrictionLimit | None
    coefficient: Quantity | None
    mass_flow: Quantity | None
    tangency: Quantity | None

    __repr__ = brief("coefficient", "mass_flow deg", "tangency")

    @property
    def fold(self) -> Quantity | None:
        """``coefficient``, where a fold is what ends the branch."""
        return self.coefficient if self.friction and self.friction.end == "fold" else None


@checked
def assess_limits(hopper: Hopper) -> Limits:
    """Return the limits of a hopper's wall friction.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.assessment.limits import assess_limits
    >>> limits = assess_limits(Hopper("cone", delta=0.7, half_angle=0.35))
    >>> limits.friction.end, round(limits.coefficient.value, 4)
    ('fold', 0.4673)
    """
    mass_flow = _mass_flow(hopper)
    try:
        friction = friction_limit(hopper)
    except (NoRadialSolutionError, ConvergenceError):
        return Limits(None, None, mass_flow, None)
    largest = Quantity(friction.friction_angle, friction.error_estimate + ROUNDING)
    return Limits(friction, coefficient(largest), mass_flow, tangency_coefficient(hopper))


@checked
def coefficient(angle: Quantity) -> Quantity:
    """Return mu = tan(phi) of a friction angle phi (radians)."""
    mu = tan(angle.value)
    return Quantity(mu, (1 + mu**2) * angle.error)


def _mass_flow(hopper: Hopper) -> Quantity | None:
    try:
        phi = mass_flow_friction_angle(hopper)
    except InvalidParameterError:
        return None
    # A closed form, but its rounding is magnified near sin(delta) = 1/3.
    rounded = mass_flow_friction_angle(replace(hopper, delta=hopper.delta * (1 + ROUNDING)))
    return Quantity(phi, abs(rounded - phi) + ROUNDING)


@checked
def tangency_coefficient(hopper: Hopper) -> Quantity | None:
    """Return the mu at which psi reaches pi/4 - delta/2, None where it does not."""
    if hopper.material != MOHR_COULOMB:
        return None
    try:
        phi = tangency_friction(hopper)
        if phi is None:
            return None
        here = solve_radial(hopper, phi)
        before = solve_radial(hopper, phi - _STEP, start=here)
    except HopperError:
        return None
    psi_max = with_errors(here, lambda solution: np.array(solution.psi_maximum()[1:]))[0]
    residual = abs(psi_max.value - (pi / 4 - hopper.delta / 2)) + psi_max.error
    slope = (psi_max.value - before.psi_maximum()[1]) / _STEP
    return coefficient(Quantity(phi, residual / slope + ROUNDING))
