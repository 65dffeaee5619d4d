"""Hoppers whose numbers lie in ranges: a box."""

from dataclasses import dataclass
from functools import cached_property
from math import atan, pi

import numpy as np

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.design.material import Material
from hopper.errors import InvalidParameterError
from hopper.problem import Geometry, as_geometry
from hopper.values import finite_number, shown
from hopper.yield_conditions import MOHR_COULOMB, YieldCondition

NAMES = ("delta", "wall", "half_angle")
# Where numbers are possible at all; of the wall, as an angle and as a coefficient.
_ANGLE, _WALL_ANGLE, _COEFFICIENT = (1e-6, pi / 2 - 1e-6), (0.0, pi / 2 - 1e-6), (0.0, 1000.0)


@dataclass(frozen=True)
class Range:
    """All numbers from ``low`` to ``high``; one number where both are equal.

    Raises
    ------
    InvalidParameterError
        If an end is not finite, or the range is upside down.
    """

    low: float
    high: float

    __repr__ = brief("low", "high")

    def __post_init__(self) -> None:
        for name in ("low", "high"):
            object.__setattr__(self, name, finite_number(name, getattr(self, name)))
        if self.low > self.high:
            raise InvalidParameterError(
                f"low = {self.low:g} is above high = {self.high:g}: give the smaller one first"
            )


@dataclass(frozen=True)
class Box:
    """Hoppers of one geometry and yield condition; angles in radians.

    Points of the box have coordinates from 0 to 1, one for each of ``ranged``.

    Parameters
    ----------
    geometry : "wedge" or "cone"
    delta, wall, half_angle : Range
        ``wall`` is of the angle of wall friction, or of its coefficient.
    condition : YieldCondition
    coefficient : bool
        Whether ``wall`` is in mu = tan(phi).

    Raises
    ------
    InvalidParameterError
        If a range holds impossible numbers, or the combination is not modelled.
    """

    geometry: Geometry
    delta: Range
    wall: Range
    half_angle: Range
    condition: YieldCondition = MOHR_COULOMB
    coefficient: bool = False

    __repr__ = brief("geometry", "delta", "wall", "half_angle")

    def __post_init__(self) -> None:
        as_geometry(self.geometry)
        for name in NAMES:
            value: object = getattr(self, name)
            if not isinstance(value, Range):
                raise InvalidParameterError(f"{name} = {shown(value)} is not a Range: give one")
        condition: object = self.condition
        if not isinstance(condition, YieldCondition):
            raise InvalidParameterError(
                f"condition = {shown(condition)} is not a yield condition: "
                "use yield_condition(name)"
            )
        if not isinstance(self.coefficient, bool):
            raise InvalidParameterError(
                f"coefficient = {shown(self.coefficient)} is no truth value: give one"
            )
        for corner in (np.zeros(len(self.ranged)), np.ones(len(self.ranged))):
            material, half_angle = self.hopper(corner)
            material.hopper(half_angle)

    @cached_property
    def ranged(self) -> tuple[str, ...]:
        """The names of what is not one number."""
        return tuple(name for name in NAMES if getattr(self, name).low < getattr(self, name).high)

    @cached_property
    def middle(self) -> Array:
        """The coordinates of the middle."""
        return np.full(len(self.ranged), 0.5)

    @checked
    def numbers(self, point: RealRow) -> dict[str, float]:
        """Return delta, wall and half angle at a point; beyond 0 and 1 outside the box."""
        if np.size(point) != len(self.ranged):
            raise InvalidParameterError(
                f"point has {np.size(point)} coordinates: give {len(self.ranged)}"
            )
        found = {name: getattr(self, name).low for name in NAMES}
        for name, share in zip(self.ranged, np.asarray(point).tolist(), strict=True):
            ends: Range = getattr(self, name)
            found[name] = ends.high if share == 1 else ends.low + share * (ends.high - ends.low)
        return found

    @checked
    def hopper(self, point: RealRow) -> tuple[Material, float]:
        """Return material with wall, and half angle (radians), at a point, shape (d,).

        Raises
        ------
        InvalidParameterError
            If the point has another number of coordinates, or the hopper is impossible.
        """
        at = self.numbers(point)
        friction = atan(at["wall"]) if self.coefficient else at["wall"]
        return Material(self.geometry, at["delta"], friction, self.condition), at["half_angle"]

    @cached_property
    def possible(self) -> Array:
        """The coordinates between which numbers are possible at all, shape (d, 2)."""
        ends = []
        for name in self.ranged:
            wall = _COEFFICIENT if self.coefficient else _WALL_ANGLE
            limits = np.array(wall if name == "wall" else _ANGLE)
            own: Range = getattr(self, name)
            ends.append((limits - own.low) / (own.high - own.low))
        return np.array(ends).reshape(-1, 2)
