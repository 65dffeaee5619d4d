"""Answers about a hopper whose numbers are known in ranges: intervals, shares, probabilities."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import product
from math import nan

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.design.flow_pattern import FlowPattern
from hopper.errors import InvalidParameterError
from hopper.quantity import Quantity
from hopper.stability.modes import Disturbances, parities_among
from hopper.uncertainty.box import Box
from hopper.uncertainty.extremes import Extreme, extremes, least
from hopper.uncertainty.hoppers import BoxedHoppers
from hopper.uncertainty.numbers import Number, radial_numbers, spare_number, stability_numbers
from hopper.uncertainty.sampling import Share, cut_off, normal_points, points_in_box, shares
from hopper.yield_conditions import MOHR_COULOMB

# Points of each shift, as a power of 2: of verdicts, and of mass flow where it has a closed form.
_POWER, _CLOSED_POWER = 5, 8
# Of the first shift, those from which the search for extremes may start.
_STARTS = 16
# Of each range, places along the border of existence from which the search starts there.
_ALONG = 5


@dataclass(frozen=True)
class Extent:
    """The least and the largest value over a box, with what is uncertain of each."""

    low: Quantity
    high: Quantity

    __repr__ = brief("low", "high")


@dataclass(frozen=True)
class Ranged:
    """An answer over a box.

    Attributes
    ----------
    pattern : FlowPattern
        In the middle of the box.
    numbers : dict
        Intervals by name, over the part of the box in which the number exists.
    shares : dict
        Of the box, by what holds there.
    probabilities : dict or None
        The same for independent normal values, where that was asked for.
    cut_off : float
        Probability of values that are impossible, and left out.
    """

    pattern: FlowPattern
    numbers: dict[str, Extent]
    shares: dict[str, Share]
    probabilities: dict[str, Share] | None
    cut_off: float

    __repr__ = brief("pattern.mass_flow", "shares")


@checked
def radial_over(box: Box, normal: bool = False) -> Ranged:
    """Return the numbers and limits of the radial solution over a box.

    ``normal`` asks for probabilities: means in the middle, the box one standard deviation around.

    Raises
    ------
    InvalidParameterError
        If the box is a single hopper.

    Examples
    --------
    >>> from hopper.uncertainty.box import Box, Range
    >>> from hopper.uncertainty.ranged import radial_over
    >>> box = Box("cone", Range(0.6, 0.7), wall=Range(0.28, 0.28), half_angle=Range(0.4, 0.4))
    >>> factor = radial_over(box).numbers["flow_factor"]
    >>> round(factor.low.value, 4), round(factor.high.value, 4)
    (1.4641, 1.589)
    """
    hoppers = BoxedHoppers(box)
    return _answer(hoppers, radial_numbers(hoppers), hoppers.radial_labels, normal)


@checked
def stability_over(
    box: Box, disturbances: Disturbances | None = None, normal: bool = False
) -> Ranged:
    """Return the abscissae and verdicts of stability over a box, as :func:`radial_over`.

    ``disturbances`` as in :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    InvalidParameterError
        If the box is a single hopper, of another than Mohr-Coulomb material, or asymmetric
        disturbances of a cone are asked for.

    Examples
    --------
    >>> from hopper.uncertainty.box import Box, Range
    >>> from hopper.uncertainty.ranged import stability_over
    >>> box = Box("cone", Range(0.4, 0.6), wall=Range(0.2, 0.2), half_angle=Range(0.2, 0.2))
    >>> round(stability_over(box).shares["stable"].value, 2)
    0.71
    """
    hoppers = BoxedHoppers(box, disturbances)
    if box.condition != MOHR_COULOMB:
        raise InvalidParameterError(
            "box is of another than Mohr-Coulomb material: its stability is not looked at"
        )
    parities_among(disturbances, box.geometry)
    return _answer(hoppers, stability_numbers(hoppers), hoppers.stability_labels, normal)


def _answer(
    hoppers: BoxedHoppers,
    numbers: dict[str, Number],
    labels: Callable[[Array], Iterable[str]],
    normal: bool,
) -> Ranged:
    box = hoppers.box
    if not box.ranged:
        raise InvalidParameterError("box is a single hopper: give a range")
    points = points_in_box(len(box.ranged), _POWER)
    found = _shares(hoppers, labels, lambda at: at)
    numbers = {"spare": spare_number(hoppers), **numbers}
    starts = points[0, :_STARTS]
    intervals = {name: _interval(hoppers, number, starts) for name, number in numbers.items()}
    known = {name: interval for name, interval in intervals.items() if interval}
    if "spare" in known:
        found = _confirmed(found, known["spare"])
    probabilities = None
    if normal:
        probabilities = _shares(hoppers, labels, lambda at: normal_points(at, box.possible))
    missing = cut_off(box.possible) if normal else 0.0
    return Ranged(hoppers.pattern(box.middle), known, found, probabilities, missing)


def _shares(
    hoppers: BoxedHoppers,
    labels: Callable[[Array], Iterable[str]],
    placed: Callable[[Array], Array],
) -> dict[str, Share]:
    """Return shares by points of the unit box that ``placed`` puts where they are wanted."""
    dimensions = len(hoppers.box.ranged)
    found = shares(labels, placed(points_in_box(dimensions, _POWER)))
    if hoppers.closed:  # more points cost next to nothing
        many = placed(points_in_box(dimensions, _CLOSED_POWER))
        found.pop("mass_flow", None)
        found |= shares(hoppers.flow_labels, many)
    return found


def _confirmed(found: dict[str, Share], spare: Extent) -> dict[str, Share]:
    """Return the shares with that of mass flow for certain, where the half angle to spare says."""
    sampled = found.get("mass_flow", Share(0.0, 0.0)).value
    if sampled == 1 and spare.low.value > spare.low.error:
        return found | {"mass_flow": Share(1.0, 0.0)}
    if sampled == 0 and spare.high.value < -spare.high.error:
        return found | {"mass_flow": Share(0.0, 0.0)}
    return found


def _interval(hoppers: BoxedHoppers, number: Number, starts: Array) -> Extent | None:
    """Return the interval of a number over the ranges on which it depends."""
    box = hoppers.box
    own = [i for i, name in enumerate(box.ranged) if name in number.depends]

    def lifted(part: Array) -> Array:
        point = box.middle.copy()
        point[own] = part
        return point

    lattice = np.array(list(product((0.0, 0.5, 1.0), repeat=len(own))))
    samples = lattice
    if len(own) == len(box.ranged):
        samples = np.concatenate([lattice, starts])
    ends = extremes(lambda part: number.value(lifted(part)), samples)
    if ends is None:
        return None
    if len(own) == len(box.ranged):
        ends = _with_border(hoppers, number, ends)

    def quantity(end: Extreme) -> Quantity:
        return Quantity(end.value, end.error + number.error(lifted(end.at)))

    return Extent(*map(quantity, ends))


def _with_border(
    hoppers: BoxedHoppers, number: Number, ends: tuple[Extreme, Extreme]
) -> tuple[Extreme, Extreme]:
    """Return extremes, or those along the border of existence where they are further out.

    Next to it numbers go as the square root of the distance, so that a search in the box does not
    follow it: here it is followed.
    """
    rest = len(hoppers.box.ranged) - 1

    def value(part: Array, margins: float = 1.0) -> float:
        point = hoppers.border(part, margins)
        return nan if point is None else number.value(point)

    lattice = np.array(list(product(np.linspace(0, 1, _ALONG), repeat=rest)))
    values = np.array([value(place) for place in lattice])
    both = []
    for sign, inside in zip((1, -1), ends, strict=True):
        further = np.nanmin(np.append(sign * values, np.inf)) < sign * inside.value
        beside = least(_times(sign, value), lattice) if further else None
        if beside is None:
            both.append(inside)
            continue
        beside = Extreme(sign * beside.value, beside.error, beside.at)
        # As the square root of the distance: at four margins twice as far off as at one; twice
        # that, as the border itself is known within a margin.
        error = 2 * abs(value(beside.at, 4.0) - beside.value) + beside.error
        point = hoppers.border(beside.at)
        both.append(inside if point is None else Extreme(beside.value, error, point))
    return both[0], both[1]


def _times(sign: int, value: Callable[[Array], float]) -> Callable[[Array], float]:
    return lambda part: sign * value(part)
