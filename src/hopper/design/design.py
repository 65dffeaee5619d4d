"""The design of a hopper in numbers: how steep, which flow factor, how wide an outlet."""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import Positive, Radians, checked
from hopper.assessment.propagation import with_errors
from hopper.assessment.radial import wall_velocity
from hopper.brief import brief
from hopper.design.half_angles import HalfAngles, half_angles
from hopper.design.material import Material
from hopper.design.outlet import FlowFunction, Outlet, smallest_outlet
from hopper.errors import ConvergenceError, NonPositiveStressError, SingularVelocityError
from hopper.quantity import Quantity
from hopper.radial.flow_factor import flow_factor
from hopper.stability.modes import Disturbances
from hopper.values import require_angle

# Step in the half angle for slopes, radians.
_STEP = 1e-6


@dataclass(frozen=True)
class Demand:
    """What an outlet must be wide enough for: a flow function, and the bulk density in kg/m^3."""

    flow_function: FlowFunction
    density: Positive

    __repr__ = brief("flow_function", "density")


@dataclass(frozen=True)
class Design:
    """A hopper for a material and its wall; angles in radians.

    Attributes
    ----------
    half_angles : HalfAngles
    recommended : Quantity or None
        Half angle a margin below the smallest of the limits; None where there is none.
    flow_factor, velocity_ratio : Quantity or None
        There, and u(theta_w) / u(0).
    outlet : Outlet or None
        The smallest one, where that was asked for.
    notes : tuple of str
        Why something is None.
    """

    half_angles: HalfAngles
    recommended: Quantity | None
    flow_factor: Quantity | None
    velocity_ratio: Quantity | None
    outlet: Outlet | None
    notes: tuple[str, ...]

    __repr__ = brief("recommended deg", "half_angles.governed_by", "flow_factor")


@checked
def design(
    material: Material,
    margin: Radians,
    demand: Demand | None = None,
    disturbances: Disturbances | None = None,
) -> Design:
    """Return the half angle a margin (radians) below the smallest limit, and what follows there.

    Raises
    ------
    WallFrictionError
        If the material cannot transmit the wall's friction.
    InvalidParameterError
        If an argument is out of range, or no outlet is wide enough for the flow function.

    Examples
    --------
    >>> from hopper.design.design import design
    >>> from hopper.design.material import Material
    >>> found = design(Material("cone", delta=0.7, friction_angle=0.28), margin=0.05)
    >>> found.half_angles.governed_by, round(found.recommended.value, 4)
    ('classical', 0.5136)
    """
    require_angle("margin", margin, zero_allowed=True)
    found = half_angles(material, disturbances)
    notes, smallest = list(found.notes), found.smallest
    recommended = smallest and Quantity(smallest.value - margin, smallest.error)
    if recommended and recommended.value <= 0:
        notes.append("recommended: the margin leaves no half angle below the smallest limit")
        recommended = None
    if recommended is None:
        if smallest is None:
            notes.append("recommended: there is no limit to keep the margin from")
        return Design(found, None, None, None, None, tuple(notes))
    if found.stable_from and recommended.value < found.stable_from.value:
        notes.append("stability: the recommended hopper is narrower than the stable ones")
    try:
        factor, velocity = _numbers(material, recommended, notes)
    except (ConvergenceError, NonPositiveStressError) as error:
        notes.append(f"flow factor: {error}")
        return Design(found, recommended, None, None, None, tuple(notes))
    outlet = None
    if demand:
        hopper = material.hopper(recommended.value)
        outlet = smallest_outlet(hopper, factor, demand.flow_function, demand.density)
    return Design(found, recommended, factor, velocity, outlet, tuple(notes))


def _numbers(
    material: Material, half_angle: Quantity, notes: list[str]
) -> tuple[Quantity, Quantity | None]:
    """Return the flow factor and the velocity ratio, with what the half angle leaves in them."""
    solution, beside = (
        material.solution(angle) for angle in (half_angle.value, half_angle.value - _STEP)
    )
    (factor,) = with_errors(solution, lambda one: np.array([flow_factor(one)]))
    share = half_angle.error / _STEP
    factor = Quantity(factor.value, factor.error + share * abs(factor.value - flow_factor(beside)))
    try:
        (_, ratio), (_, near) = wall_velocity(solution), wall_velocity(beside)
    except (SingularVelocityError, ConvergenceError) as unknown:
        notes.append(f"velocity: {unknown}")
        return factor, None
    return factor, Quantity(ratio.value, ratio.error + share * abs(ratio.value - near.value))
