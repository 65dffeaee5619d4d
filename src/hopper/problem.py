"""A hopper and its material: the parameters every computation starts from."""

from dataclasses import dataclass
from math import sin
from typing import Literal, cast, get_args

from numpy.typing import ArrayLike

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.values import real_row, require_angle, shown
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES, YieldCondition

Geometry = Literal["wedge", "cone"]


@dataclass(frozen=True)
class Hopper:
    """A hopper of half opening angle ``half_angle`` with a material of internal friction ``delta``.

    Parameters
    ----------
    geometry : "wedge" or "cone"
    delta : float
        Angle of internal friction, radians, in (0, pi/2).
    half_angle : float
        Half opening angle theta_w, radians, in (0, pi/2).
    material : YieldCondition
        Mohr-Coulomb, or von Mises (cone only).

    Raises
    ------
    InvalidParameterError
        If a value is non-finite, outside its range, or the combination is not modelled.
    """

    geometry: Geometry
    delta: float
    half_angle: float
    material: YieldCondition = MOHR_COULOMB

    __repr__ = brief("geometry", "delta deg", "half_angle deg", "material.name")

    def __post_init__(self) -> None:
        as_geometry(self.geometry)
        for name in ("delta", "half_angle"):
            require_angle(name, getattr(self, name))
            object.__setattr__(self, name, float(getattr(self, name)))
        material: object = self.material
        if not isinstance(material, YieldCondition):
            raise InvalidParameterError(
                f"material = {shown(material)} is not a yield condition: use yield_condition(name)"
            )
        if self.material == VON_MISES and self.geometry == "wedge":
            raise InvalidParameterError(
                "model = von-mises is formulated for cones only: use geometry = cone"
            )

    @property
    def curvature(self) -> int:
        """K = d - 2: 0 for a wedge, 1 for a cone."""
        return 1 if self.geometry == "cone" else 0

    @property
    def s(self) -> float:
        """sin(delta)."""
        return sin(self.delta)


def as_geometry(name: str) -> Geometry:
    """Return ``name`` as a Geometry.

    Raises
    ------
    InvalidParameterError
        If it is neither wedge nor cone.
    """
    if not isinstance(name, str) or name not in get_args(Geometry):
        raise InvalidParameterError(f"geometry = {shown(name)} is unknown: use wedge or cone")
    return cast(Geometry, name)


@checked
def as_angles(name: str, values: ArrayLike) -> Array:
    """Return real numbers as an array, shape (n,).

    Raises
    ------
    InvalidParameterError
        If they are not finite real numbers, one or a row of them.
    """
    return real_row(name, values, "angles")
