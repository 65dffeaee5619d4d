"""The neutral curve of von Mises cones over wall friction, with its corners.

At each phi one mode or the strip is neutral. Where two of them are, the curve has a corner: a root
in phi as well, so that the curve's shape does not depend on the steps along it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from math import nan

import numpy as np

from hopper.arguments import Positive, Radians, checked
from hopper.arrays import Array, Mask
from hopper.brief import brief
from hopper.errors import ConvergenceError, HopperError
from hopper.values import require_angle
from hopper.von_mises.following import Followed, both_neutral, flow_at, governing
from hopper.von_mises.growth import growth
from hopper.von_mises.neutral import (
    NeutralDelta,
    NeutralFlow,
    exceeded,
    first_size,
    followed_up,
    neutral_flow,
    resolved_near,
)

# Steps, in the largest one, in which a mode that is lost is given up for another.
_SHORT = 1 / 4
# The least step, radians and part of the largest one; the largest change of delta in a step, in
# steps.
_SMALLEST_STEP, _SMALLEST_PART, _STEEPEST = 1e-4, 1 / 64, 2


@dataclass(frozen=True)
class NeutralBorder:
    """Points of the neutral curve from the smooth wall on, arrays of shape (n,).

    Attributes
    ----------
    friction_angle, delta, error_estimate : array
        phi, delta and its error, radians.
    frequency : array
        Im(lambda) of the neutral modes; NaN for the strip.
    settled : bool array
        Whether the test of resolution expects no mode above 0.
    """

    friction_angle: Array
    delta: Array
    error_estimate: Array
    frequency: Array
    settled: Mask

    __repr__ = brief("friction_angle deg", "delta deg", "settled")


@checked
def neutral_curve(
    half_angle: Radians, step: Positive, highest: Radians | None = None
) -> NeutralBorder:
    """Trace the neutral curve from phi = 0 to its end, by continuation in phi.

    It ends where no flow is stable, or none exists, or none is resolved; the last is found to a
    64th of the step in phi.

    Parameters
    ----------
    half_angle : float
        theta_w, radians.
    step : float
        Largest step in phi, radians.
    highest : float, optional
        Friction angle (radians) at which to stop.

    Raises
    ------
    InvalidParameterError
        If an angle or the step is out of range.
    ConvergenceError
        If not even the smooth wall has a neutral delta.
    """
    require_angle("half_angle", half_angle)
    if highest is not None:
        require_angle("highest", highest, zero_allowed=True)
    first = neutral_flow(half_angle, 0.0)
    if first is None:
        raise ConvergenceError(
            f"no neutral delta at half_angle = {np.degrees(half_angle):.6g} deg even for a smooth "
            "wall: lower half_angle"
        )
    least = max(_SMALLEST_STEP, _SMALLEST_PART * step)
    flows = list(_traced(first, step, least, highest))
    points = [first.point]
    for left, right in pairwise(flows):
        points += [flow.point for flow in _between(left, right, least)] if right.changed else []
        points.append(right.point)
    return NeutralBorder(
        *(np.array([getattr(p, name) for p in points]) for name in NeutralBorder.__annotations__)
    )


def _traced(
    first: NeutralFlow, step: float, least: float, highest: float | None
) -> Iterator[NeutralFlow]:
    """Yield neutral flows by increasing phi."""
    last, current, slope = first, step, 0.0
    yield first
    while current > least:
        phi = last.point.friction_angle + current
        if highest is not None and phi > highest * (1 + 1e-12):
            return
        guess = last.point.delta + slope * current
        found = _following(last, phi, guess, restart=current <= _SHORT * step)
        change = found.point.delta - last.point.delta if found else nan
        if found is None or (abs(change) > _STEEPEST * step and current > 2 * least):
            current /= 2
            continue
        slope = change / current
        yield found
        last, current = found, min(2 * current, step)


def _following(last: NeutralFlow, phi: float, guess: float, restart: bool) -> NeutralFlow | None:
    """Return the next flow from what governs the last one, or else what governs at the guess."""
    first = first_size(last.growth)
    try:
        return followed_up(last.governor, phi, guess, last.slope, first)
    except HopperError:
        if not restart:
            return None
    try:
        there = flow_at(last.governor.flow.hopper.half_angle, phi, guess, last.governor.flow)
        found = followed_up(governing(growth(there), there), phi, guess, first=first)
    except HopperError:
        return None
    return replace(found, changed=True)


def _between(left: NeutralFlow, right: NeutralFlow, least: float) -> list[NeutralFlow]:
    """Return the corners between two neutral flows, and others that lie higher there, by phi."""
    low, high = left.point.friction_angle, right.point.friction_angle
    if high - low < least:
        return []
    try:
        one, other = _corner(left, right)
        phi, delta = one.flow.friction_angle, one.flow.hopper.delta
        if not low + least / 8 < phi < high - least / 8:
            return []
        full = resolved_near(one.flow, first_size(right.growth))
        if exceeded(one, full) and exceeded(other, full):
            higher = followed_up(governing(full, one.flow), phi, delta, first=full.modes.size)
            return [*_between(left, higher, least), higher, *_between(higher, right, least)]
    except HopperError:
        return []
    error = max(flow.point.error_estimate for flow in (left, right))
    point = NeutralDelta(delta, phi, error, other.value.imag, full.settled)
    return [replace(right, point=point, governor=other, growth=full)]


def _corner(left: NeutralFlow, right: NeutralFlow) -> tuple[Followed, Followed]:
    """Return what governs two neutral flows where both are neutral."""
    places = np.array([[at.point.delta, at.point.friction_angle] for at in (left, right)])
    # Re(lambda) of each where the other is neutral gives its slope along the curve.
    change = places[1] - places[0]
    rises = np.array([
        left.governor.at(right.governor.flow).value.real,
        -right.governor.at(left.governor.flow).value.real,
    ])  # fmt: skip
    over_delta = np.array([left.slope, right.slope])
    jacobian = np.stack([over_delta, (rises - over_delta * change[0]) / change[1]], axis=1)
    place = np.linalg.solve(jacobian, (jacobian * places).sum(axis=1))
    return both_neutral(left.governor, right.governor, place, jacobian)
