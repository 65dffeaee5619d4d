"""Verdicts on von Mises cones over the plane of internal and wall friction, and their borders."""

from dataclasses import dataclass
from math import nan
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import Radians, Row, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.domain.borders import friction_reaching
from hopper.errors import ConvergenceError, HopperError, InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.branch import branch_up_to, members_on
from hopper.radial.collocation import Member, largest_psi
from hopper.radial.solution import solution_of
from hopper.values import require_angle
from hopper.von_mises.characteristics import (
    AXIS_HYPERBOLIC,
    TENSION,
    equation_type,
    sonic_angle,
    tangency_angle,
)
from hopper.von_mises.saint_venant import end_effects
from hopper.von_mises.verdict import Kind, Verdict, flow_limit, judge, judge_solution
from hopper.yield_conditions import VON_MISES

COUPLED_REGIONS: tuple[Kind, ...] = get_args(Kind)
# Errors of the radial fields that leave the modes accurate.
_FIELDS = 1e-11
# Where resolution ends is no sharper than this; radians.
_EDGE = 3e-3


@dataclass(frozen=True)
class CoupledSweep:
    """Verdicts at n wall friction angles; NaN where the region has no such number.

    Attributes
    ----------
    friction_angle : array, shape (n,)
        phi, radians.
    region, slanted : integer arrays, shape (n,)
        Index into ``COUPLED_REGIONS``; 1 where data belong on a slanted surface, else 0.
    abscissa : array, shape (n,)
        Supremum of Re(lambda) of hyperbolic flows, the flow rate left out.
    decay_down, decay_up : arrays, shape (n,)
        Exponents of elliptic flows.
    error_estimate : array, shape (n,)
        Of the abscissa or the exponents.
    psi_max : array, shape (n,)
        Largest psi of the radial solution, radians.
    """

    friction_angle: Array
    region: NDArray[np.int8]
    slanted: NDArray[np.int8]
    abscissa: Array
    decay_down: Array
    decay_up: Array
    error_estimate: Array
    psi_max: Array

    __repr__ = brief("friction_angle deg", "abscissa", "decay_down", "decay_up")


@checked
def sweep_coupled(hopper: Hopper, friction_angles: Row) -> CoupledSweep:
    """Judge a von Mises cone at increasing wall friction angles (radians).

    Raises
    ------
    InvalidParameterError
        If the angles do not increase or lie outside [0, pi/2), or the material is not von Mises.
    """
    angles = np.asarray(friction_angles)
    if np.any(np.diff(angles) <= 0):
        raise InvalidParameterError("friction_angles must increase: sort and remove repeated ones")
    for angle in angles:
        require_angle("friction_angle", angle, zero_allowed=True)
    limit = flow_limit(hopper)
    region = np.full(angles.size, COUPLED_REGIONS.index("no_radial_solution"), dtype=np.int8)
    slanted = np.zeros(angles.size, dtype=np.int8)
    values = np.full((5, angles.size), nan)
    allowed = np.flatnonzero((angles < limit) | (hopper.delta >= TENSION))
    for i, member in zip(allowed, _members(hopper, angles[allowed]), strict=True):
        found = _judged(hopper, float(angles[i]), member)
        region[i] = COUPLED_REGIONS.index(found.verdict)
        slanted[i] = found.slanted
        ends = found.end_effects
        rates = (ends.decay_down, ends.decay_up) if ends else (nan, nan)
        largest = largest_psi(member) if member else nan
        values[:, i] = found.abscissa, *rates, found.error_estimate, largest
    return CoupledSweep(angles, region, slanted, *values)


def _members(hopper: Hopper, angles: Array) -> list[Member | None]:
    """Return radial solutions solved together, None for those that are not resolved so."""
    if hopper.delta >= TENSION or not angles.size:
        return [None] * angles.size
    psi_walls = np.array([hopper.material.wall_angle(hopper.delta, phi) for phi in angles])
    try:
        return members_on(branch_up_to(hopper, float(psi_walls[-1])), psi_walls, _FIELDS)
    except HopperError:
        return [None] * angles.size


def _judged(hopper: Hopper, friction_angle: float, member: Member | None) -> Verdict:
    if member is None or member.tau <= 0:
        return judge(hopper, friction_angle)
    solution = solution_of(member)
    kind = equation_type(solution)
    # The modes of mixed flows decide nothing.
    if kind.kind == "mixed":
        return Verdict("mixed", "", kind)
    return judge_solution(solution)


@dataclass(frozen=True)
class CoupledBorders:
    """Wall friction angles (radians) at which something changes, over delta; NaN where it does not.

    Attributes
    ----------
    delta : array, shape (n,)
    limit : array
        psi reaches pi/4: no radial flow beyond.
    sonic : array
        Below it a flow is elliptic, beyond it mixed; NaN from 35.26 deg on.
    tangency : array
        Beyond it data belong on a slanted surface; NaN for less than 35.26 deg.
    """

    delta: Array
    limit: Array
    sonic: Array
    tangency: Array

    __repr__ = brief("delta deg", "limit deg", "sonic deg")


@checked
def coupled_borders(half_angle: Radians, deltas: Row) -> CoupledBorders:
    """Return the borders of von Mises cones over ``deltas`` (radians), each a root in phi.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    ConvergenceError
        If a radial solution on a border is not resolved.
    """
    table = np.full((3, deltas.size), nan)
    for i, delta in enumerate(deltas):
        hopper = Hopper("cone", float(delta), half_angle, VON_MISES)
        table[0, i] = flow_limit(hopper)
        if delta < AXIS_HYPERBOLIC:
            table[1, i] = friction_reaching(hopper, sonic_angle(hopper.s)) or nan
        elif delta < TENSION:
            table[2, i] = friction_reaching(hopper, tangency_angle(hopper.s)) or nan
    return CoupledBorders(deltas, *table)


@checked
def stable_edge(half_angle: Radians, deltas: Row, friction_angle: Radians) -> Array:
    """Return the wall friction angles (radians) up to which cones are stable, each to 3e-3.

    Beyond the end of the neutral curve stable cones border on ones that are not resolved, up to
    the limit of flow. NaN where a cone is not stable at ``friction_angle``.

    Parameters
    ----------
    half_angle : float
        theta_w, radians.
    deltas : array, shape (n,)
        Close enough that the part of the limit of flow that is stable differs little.
    friction_angle : float
        Radians; stable for all of them.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    """
    found, part = np.full(deltas.size, nan), np.full(deltas.size, nan)
    for i, delta in enumerate(deltas):
        hopper = Hopper("cone", float(delta), half_angle, VON_MISES)
        limit = flow_limit(hopper)
        guess = _continued(deltas[:i], part[:i], float(delta)) * limit
        found[i] = _edge(hopper, friction_angle, limit, guess)
        part[i] = found[i] / limit
    return found


def _continued(x: Array, y: Array, at: float) -> float:
    """Return y on the straight line through the last two points, NaN without any."""
    if y.size < 2:
        return float(y[-1]) if y.size else nan
    return float(y[-1] + (at - x[-1]) * (y[-1] - y[-2]) / (x[-1] - x[-2]))


def _edge(hopper: Hopper, below: float, above: float, guess: float) -> float:
    """Return the edge between a stable friction and one without a verdict or flow.

    The guess may be NaN.
    """

    def stable(phi: float) -> bool:
        return judge(hopper, phi).verdict == "stable"

    least, reach = below, _EDGE
    # Away from the guess until the verdict changes: the next step then leads out of the bracket.
    while below < guess < above:
        if stable(guess):
            below, guess = guess, guess + reach
        else:
            above, guess = guess, guess - reach
        reach *= 2
    while above - below > _EDGE:
        middle = (below + above) / 2
        below, above = (middle, above) if stable(middle) else (below, middle)
    return below if below > least or stable(below) else nan


@checked
def decay_rates(hopper: Hopper, friction_angles: Row) -> tuple[Array, Array]:
    """Return the exponents of decay of elliptic flows, down and up, NaN where there are none.

    Raises
    ------
    InvalidParameterError
        As :func:`sweep_coupled`.
    """
    found = np.full((2, friction_angles.size), nan)
    for i, member in enumerate(_members(hopper, friction_angles)):
        if member is None or member.tau <= 0:
            continue
        try:
            ends = end_effects(solution_of(member))
        except ConvergenceError:
            continue
        found[:, i] = ends.decay_down, ends.decay_up
    return found[0], found[1]
