"""A hopper and its material: the parameters every computation starts from."""

from dataclasses import dataclass
from math import degrees, isfinite, pi, sin
from numbers import Real
from typing import Literal, cast, get_args

import numpy as np
from numpy.typing import ArrayLike

from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
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
        if self.geometry not in get_args(Geometry):
            raise InvalidParameterError(
                f"geometry = {self.geometry!r} is unknown: use wedge or cone"
            )
        for name in ("delta", "half_angle"):
            require_angle(name, getattr(self, name))
        material: object = self.material
        if not isinstance(material, YieldCondition):
            raise InvalidParameterError(
                f"material = {material!r} is not a yield condition: use yield_condition(name)"
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


def require_angle(name: str, value: float, *, zero_allowed: bool = False) -> None:
    """Check that an angle in radians is finite and inside (0, pi/2), or [0, pi/2).

    Raises
    ------
    InvalidParameterError
        If it is not; the message states the value in degrees.
    """
    # numpy scalars and ints are welcome, strings and arrays are not.
    if not is_real(value):
        raise InvalidParameterError(f"{name} = {value!r} is not a number: give radians")
    angle = float(value)
    inside = 0 <= angle < pi / 2 if zero_allowed else 0 < angle < pi / 2
    if not (isfinite(angle) and inside):
        interval = "[0, 90)" if zero_allowed else "(0, 90)"
        raise InvalidParameterError(
            f"{name} = {degrees(angle):.6g} deg is out of range: it must lie in {interval} deg"
        )


def as_geometry(name: str) -> Geometry:
    """Return ``name`` as a Geometry.

    Raises
    ------
    InvalidParameterError
        If it is neither wedge nor cone.
    """
    if name not in get_args(Geometry):
        raise InvalidParameterError(f"geometry = {name!r} is unknown: use wedge or cone")
    return cast(Geometry, name)


def as_angles(name: str, values: ArrayLike) -> Array:
    """Return real numbers as an array, shape (n,).

    Raises
    ------
    InvalidParameterError
        If they are not real numbers.
    """
    array = np.atleast_1d(np.asarray(values))
    if array.dtype.kind not in "fiu":
        raise InvalidParameterError(f"{name} must be real numbers, in radians")
    return array.astype(float)


def is_real(value: object) -> bool:
    """Whether a value is a real number: not a string, not complex, not an array."""
    return isinstance(value, Real)
