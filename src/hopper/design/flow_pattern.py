"""Mass flow, yes or no, and with how much half angle to spare."""

from dataclasses import dataclass

from hopper.arguments import Radians, checked
from hopper.brief import brief
from hopper.design.half_angles import flow_limit
from hopper.design.material import Material
from hopper.errors import (
    ConvergenceError,
    NoLimitError,
    NonPositiveStressError,
    NoRadialSolutionError,
    NowhereError,
)
from hopper.quantity import Quantity
from hopper.values import require_angle


@dataclass(frozen=True)
class FlowPattern:
    """Whether a hopper is in mass flow.

    Attributes
    ----------
    mass_flow : bool or None
        None where the limit is not resolved.
    spare : Quantity or None
        Half angle (radians) up to the limit of mass flow, negative beyond it; None without a limit.
    reason : str
        Why there is none; empty otherwise.
    """

    mass_flow: bool | None
    spare: Quantity | None
    reason: str

    __repr__ = brief("mass_flow", "spare deg", "reason")


@checked
def flow_pattern(material: Material, half_angle: Radians) -> FlowPattern:
    """Return whether a hopper of half angle ``half_angle`` (radians) is in mass flow.

    That is within the limit of :func:`hopper.design.half_angles.flow_limit`. Without one it is
    where there is a radial solution.

    Raises
    ------
    WallFrictionError
        If the material cannot transmit the wall's friction.

    Examples
    --------
    >>> from hopper.design.flow_pattern import flow_pattern
    >>> from hopper.design.material import Material
    >>> flow_pattern(Material("cone", delta=0.7, friction_angle=0.28), half_angle=0.35).mass_flow
    True
    """
    require_angle("half_angle", half_angle)
    try:
        limit = flow_limit(material)
    except NowhereError as error:
        return FlowPattern(False, None, str(error))
    except (ConvergenceError, NonPositiveStressError) as error:
        return FlowPattern(None, None, str(error))
    except NoLimitError as error:
        return FlowPattern(_solved(material, half_angle), None, str(error))
    spare = Quantity(limit.value - half_angle, limit.error)
    return FlowPattern(spare.value > 0, spare, "")


def _solved(material: Material, half_angle: float) -> bool | None:
    try:
        material.solution(half_angle)
    except (NoRadialSolutionError, NonPositiveStressError):
        return False
    except ConvergenceError:
        return None
    return True
