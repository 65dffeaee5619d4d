"""What fills a hopper, and its wall, whatever its half angle."""

from dataclasses import dataclass
from functools import lru_cache
from math import radians

from hopper.arguments import Radians, checked
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.problem import Geometry, Hopper
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.values import require_angle, shown
from hopper.yield_conditions import MOHR_COULOMB, YieldCondition

# The narrowest half angle looked at, radians.
NARROWEST = radians(0.5)


@dataclass(frozen=True)
class Material:
    """What fills a hopper, and its wall: angles in radians.

    Parameters
    ----------
    geometry : "wedge" or "cone"
    delta, friction_angle : float
        Angles of internal friction and of wall friction.
    condition : YieldCondition
        Mohr-Coulomb, or von Mises (cone only).

    Raises
    ------
    InvalidParameterError
        If a value is out of range, or the combination is not modelled.
    """

    geometry: Geometry
    delta: float
    friction_angle: float
    condition: YieldCondition = MOHR_COULOMB

    __repr__ = brief("geometry", "delta deg", "friction_angle deg", "condition.name")

    def __post_init__(self) -> None:
        condition: object = self.condition
        if not isinstance(condition, YieldCondition):
            raise InvalidParameterError(
                f"condition = {shown(condition)} is not a yield condition: "
                "use yield_condition(name)"
            )
        Hopper(self.geometry, self.delta, NARROWEST, self.condition)
        require_angle("friction_angle", self.friction_angle, zero_allowed=True)

    @property
    def slips(self) -> bool:
        """Whether mass flow is slip along the wall, as in Mohr-Coulomb cones."""
        return self.geometry == "cone" and self.condition == MOHR_COULOMB

    @checked
    def hopper(self, half_angle: Radians) -> Hopper:
        """Return the hopper of a half angle."""
        return Hopper(self.geometry, self.delta, half_angle, self.condition)

    @checked
    def solution(self, half_angle: Radians) -> RadialSolution:
        """Return the radial solution at a half angle, as :func:`hopper.radial.solve_radial`."""
        return _solution(self, half_angle)


@lru_cache(maxsize=64)
def _solution(material: Material, half_angle: float) -> RadialSolution:
    return solve_radial(material.hopper(half_angle), material.friction_angle)
