"""The design of a hopper for a material and a wall that are known in ranges."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from math import nan
from operator import attrgetter

import numpy as np

from hopper.arguments import Radians, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.design.design import Demand, Design, design
from hopper.design.half_angles import LIMITS
from hopper.errors import HopperError, InvalidParameterError
from hopper.quantity import Quantity
from hopper.stability.modes import Disturbances
from hopper.uncertainty.box import Box
from hopper.uncertainty.extremes import COARSE, Extreme, extremes
from hopper.uncertainty.ranged import Interval
from hopper.uncertainty.sampling import Share, normal_points, points_in_box, shares
from hopper.values import require_angle

NUMBERS = (
    *(f"half_angles.{name}" for name in (*LIMITS, "stable_from", "mass_flow")),
    *("recommended", "flow_factor", "velocity_ratio", "outlet.stress", "outlet.width"),
)
# Points of each shift, as a power of 2: the limits are interpolated, so that they cost nothing.
_POWER = 8


@dataclass(frozen=True)
class RangedDesign:
    """A design over a box.

    Attributes
    ----------
    middle : Design
        Of the middle of the box.
    numbers : dict
        Intervals by name, over the part of the box in which the number exists.
    recommended : Quantity or None
        The margin below the smallest limit of the whole box (radians).
    shares : dict
        Of the box, by which limit is the smallest there.
    probabilities : dict or None
        The same for independent normal values, where that was asked for.
    """

    middle: Design
    numbers: dict[str, Interval]
    recommended: Quantity | None
    shares: dict[str, Share]
    probabilities: dict[str, Share] | None

    __repr__ = brief("recommended deg", "shares")


@checked
def design_over(
    box: Box,
    margin: Radians,
    demand: Demand | None = None,
    disturbances: Disturbances | None = None,
    normal: bool = False,
) -> RangedDesign:
    """Return designs over the ranges of delta and wall; as :func:`hopper.design.design.design`.

    A design takes long, so that the search for extremes is coarse, and shares are of limits that
    are interpolated between three values of each range.

    Raises
    ------
    InvalidParameterError
        If the box has a range of half angles, or is a single hopper.
    HopperError
        As :func:`hopper.design.design.design` in the middle of the box.
    """
    if not box.ranged or "half_angle" in box.ranged:
        raise InvalidParameterError("box has no range of delta or wall, or one of half angles")
    require_angle("margin", margin, zero_allowed=True)
    middle = design(box.hopper(box.middle)[0], margin, demand, disturbances)
    known: dict[bytes, Design | None] = {box.middle.tobytes(): middle}

    def found(point: Array) -> Design | None:
        if (key := point.tobytes()) not in known:
            try:
                known[key] = design(box.hopper(point)[0], margin, demand, disturbances)
            except HopperError:
                known[key] = None
        return known[key]

    lattice = np.array(list(product((0.0, 0.5, 1.0), repeat=len(box.ranged))))
    intervals = {name: _interval(found, name, lattice) for name in NUMBERS}
    numbers = {name: interval for name, interval in intervals.items() if interval}
    limits = [numbers[name].low for limit in LIMITS if (name := f"half_angles.{limit}") in numbers]
    least = min(limits, key=lambda limit: limit.value, default=None)
    recommended = least and Quantity(least.value - margin, least.error)
    points = points_in_box(len(box.ranged), _POWER)
    at_nodes = [found(node) for node in lattice]
    probabilities = None
    if normal:
        probabilities = _governors(at_nodes, normal_points(points, box.possible))
    return RangedDesign(
        middle,
        numbers,
        recommended if recommended and recommended.value > 0 else None,
        _governors(at_nodes, points),
        probabilities,
    )


def _interval(
    found: Callable[[Array], Design | None], name: str, lattice: Array
) -> Interval | None:
    def at(point: Array) -> Quantity | None:
        result = found(point)
        part, _, last = name.rpartition(".")
        whole = attrgetter(part)(result) if result and part else result
        quantity: Quantity | None = whole and getattr(whole, last)
        return quantity

    def value(point: Array) -> float:
        quantity = at(point)
        return quantity.value if quantity else nan

    def end(extreme: Extreme) -> Quantity:
        quantity = at(extreme.at)
        return Quantity(extreme.value, extreme.error + (quantity.error if quantity else 0.0))

    ends = extremes(value, lattice, COARSE)
    return Interval(*map(end, ends)) if ends else None


def _governors(nodes: list[Design | None], points: Array) -> dict[str, Share]:
    """Return the share of each smallest limit; the error holds what interpolation leaves open."""
    size = points.shape[-1]
    table = np.array(
        [
            [value.value if one and (value := getattr(one.half_angles, name)) else np.inf
             for one in nodes]
            for name in LIMITS
        ]
    ).reshape(len(LIMITS), *[3] * size)  # fmt: skip
    fine, coarse = (
        shares(lambda point, at=at: [_smallest(table, point, at)], points)
        for at in (np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0]))
    )
    none = Share(0.0, 0.0)
    return {
        name: Share(share.value, share.error + abs(share.value - coarse.get(name, none).value))
        for name, share in fine.items()
    }


def _smallest(table: Array, point: Array, nodes: Array) -> str:
    """Return which interpolated limit is the smallest; one that a node lacks is taken as none."""
    values = table if nodes.size == 3 else table[(slice(None), *[slice(None, None, 2)] * point.size)]
    for place in point[::-1]:
        weights = [
            np.prod([(place - other) / (node - other) for other in nodes if other != node])
            for node in nodes
        ]
        with np.errstate(invalid="ignore"):
            values = values @ np.array(weights)
    known = np.where(np.isfinite(values), values, np.inf)
    return LIMITS[int(known.argmin())] if np.isfinite(known).any() else "none"
