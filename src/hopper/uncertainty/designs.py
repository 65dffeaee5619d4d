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
from hopper.uncertainty.interpolation import interpolated, interpolation_nodes
from hopper.uncertainty.ranged import Extent
from hopper.uncertainty.sampling import Share, normal_points, points_in_box, shares
from hopper.values import require_angle

NUMBERS = (
    *(f"half_angles.{name}" for name in (*LIMITS, "stable_from", "mass_flow")),
    *("recommended", "flow_factor", "velocity_ratio", "outlet.stress", "outlet.width"),
)
# Nodes of each range, by their number, and points at which the interpolant is looked at.
_NODES, _FINE = {1: 5, 2: 3}, {1: 1001, 2: 101}
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
    numbers: dict[str, Extent]
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

    A design takes long: numbers are interpolated between those at a few nodes, the corners among
    them, and where the interpolant is least or largest a design is computed.

    Raises
    ------
    InvalidParameterError
        If the box has a range of half angles, or is a single hopper.
    HopperError
        As :func:`hopper.design.design.design` in the middle of the box.

    Examples
    --------
    >>> from hopper.uncertainty.box import Box, Range
    >>> from hopper.uncertainty.designs import design_over
    >>> box = Box("cone", Range(0.65, 0.7), wall=Range(0.28, 0.28), half_angle=Range(0.3, 0.3))
    >>> round(design_over(box, margin=0.05).recommended.value, 4)
    0.5136
    """
    require_angle("margin", margin, zero_allowed=True)
    if not box.ranged or "half_angle" in box.ranged:
        raise InvalidParameterError("box has no range of delta or wall, or one of half angles")
    at_middle = design(box.hopper(box.middle)[0], margin, demand, disturbances)
    known: dict[bytes, Design | None] = {box.middle.tobytes(): at_middle}

    def found(point: Array) -> Design | None:
        if (key := point.tobytes()) not in known:
            try:
                known[key] = design(box.hopper(point)[0], margin, demand, disturbances)
            except HopperError:
                known[key] = None
        return known[key]

    dimensions = len(box.ranged)
    nodes = interpolation_nodes(_NODES[dimensions])
    lattice = [found(np.array(node)) for node in product(nodes, repeat=dimensions)]
    tables = {name: _table(lattice, name, dimensions) for name in NUMBERS}
    intervals = {name: _interval(found, name, table) for name, table in tables.items()}
    numbers = {name: interval for name, interval in intervals.items() if interval}
    limits = np.array([tables[f"half_angles.{name}"] for name in LIMITS])
    points = points_in_box(dimensions, _POWER)
    probabilities = None
    if normal:
        probabilities = _governors(limits, normal_points(points, box.possible))
    return RangedDesign(
        at_middle, numbers, _recommended(numbers, margin), _governors(limits, points), probabilities
    )


def _recommended(numbers: dict[str, Extent], margin: float) -> Quantity | None:
    """Return the margin below the smallest limit of the whole box."""
    limits = [numbers[name].low for limit in LIMITS if (name := f"half_angles.{limit}") in numbers]
    least = min(limits, key=lambda limit: limit.value, default=None)
    if least is None or least.value <= margin:
        return None
    return Quantity(least.value - margin, least.error)


def _quantity(found: Design | None, name: str) -> Quantity | None:
    part, _, last = name.rpartition(".")
    whole = attrgetter(part)(found) if found and part else found
    return getattr(whole, last) if whole else None


def _table(lattice: list[Design | None], name: str, dimensions: int) -> Array:
    """Return a number at the nodes, NaN where it does not exist."""
    quantities = [_quantity(one, name) for one in lattice]
    values = np.array([one.value if one else nan for one in quantities])
    return values.reshape([_NODES[dimensions]] * dimensions)


def _interval(found: Callable[[Array], Design | None], name: str, table: Array) -> Extent | None:
    if np.isnan(table).all():
        return None
    whole = not np.isnan(table).any()
    nodes = np.array(list(product(interpolation_nodes(table.shape[0]), repeat=table.ndim)))
    places = nodes
    if whole:
        fine = np.linspace(0, 1, _FINE[table.ndim])
        places = np.concatenate([nodes, list(product(fine, repeat=table.ndim))])
    values = interpolated(table, places) if whole else table.ravel()
    ends = []
    for place in (np.nanargmin(values), np.nanargmax(values)):
        quantity = _quantity(found(places[place]), name)
        if quantity is None:
            return None
        # Where it exists in a part only, no more is known than between neighbours.
        off = abs(quantity.value - values[place]) if whole else float(np.nanstd(table))
        ends.append(Quantity(quantity.value, quantity.error + off))
    return Extent(*ends)


def _governors(limits: Array, points: Array) -> dict[str, Share]:
    """Return the share of each smallest limit; the error holds what interpolation leaves open."""
    size = points.shape[-1]
    skipped = (slice(None), *[slice(None, None, 2)] * size)
    fine, coarse = (_shares_of_smallest(table, points) for table in (limits, limits[skipped]))
    none = Share(0.0, 0.0)
    return {
        name: Share(share.value, share.error + abs(share.value - coarse.get(name, none).value))
        for name, share in fine.items()
    }


def _shares_of_smallest(limits: Array, points: Array) -> dict[str, Share]:
    """Return the shares; a limit that lacks at a node is taken as none."""
    flat = points.reshape(-1, points.shape[-1])
    values = np.array(
        [
            interpolated(table, flat) if np.isfinite(table).all() else np.full(len(flat), np.inf)
            for table in limits
        ]
    )
    least = np.where(np.isfinite(values).any(axis=0), values.argmin(axis=0), len(LIMITS))
    names = dict(zip((point.tobytes() for point in flat), least.tolist(), strict=True))
    return shares(lambda point: [(*LIMITS, "none")[names[point.tobytes()]]], points)
