"""The neutral curve, which separates unstable from stable hoppers, in numbers."""

from dataclasses import dataclass
from math import pi
from typing import Literal

from hopper.assessment.limits import coefficient
from hopper.assessment.stability import abscissa_with_error
from hopper.brief import brief
from hopper.domain.neutral import NoNeutralPointError, neutral_curve, neutral_delta
from hopper.problem import Geometry, Hopper
from hopper.quantity import Quantity
from hopper.radial.solution import solve_radial
from hopper.stability.modes import linear_stability

# Steps, in radians: in delta for a slope, and in phi along the curve.
_STEP, _PHI_STEP = 1e-6, 0.035
# Error of the end of the curve: 1e-6 degrees.
_END_ERROR = pi / 180e6


@dataclass(frozen=True)
class NeutralPoint:
    """The delta (radians) that separates unstable (smaller) from stable hoppers."""

    delta: Quantity
    governed_by: Literal["mode", "line"]

    __repr__ = brief("delta deg", "governed_by")


def assess_neutral(geometry: Geometry, half_angle: float, friction_angle: float) -> NeutralPoint:
    """Return the neutral delta of a Mohr-Coulomb hopper; angles in radians.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    NoNeutralPointError
        If no delta separates unstable from stable hoppers at this friction.
    """
    delta = neutral_delta(geometry, half_angle, friction_angle)
    at, beyond = (
        solve_radial(Hopper(geometry, angle, half_angle), friction_angle)
        for angle in (delta, delta + _STEP)
    )
    result, _, abscissa = abscissa_with_error(at)
    slope = (linear_stability(beyond).abscissa - abscissa.value) / _STEP
    error = (abs(abscissa.value) + abscissa.error) / abs(slope)
    return NeutralPoint(Quantity(delta, error), result.governed_by)


def largest_neutral_coefficient(geometry: Geometry, half_angle: float) -> Quantity | None:
    """Return the largest mu that has a neutral delta, None if not even a smooth wall has one."""
    try:
        curve = neutral_curve(geometry, half_angle, _PHI_STEP)
    except NoNeutralPointError:
        return None
    return coefficient(Quantity(float(curve.friction_angle[-1]), _END_ERROR))
