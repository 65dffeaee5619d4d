"""Verdicts of stability along a sweep of wall friction, each with the region it lies in."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.collocation import Member
from hopper.radial.family import family_from
from hopper.radial.friction_limit import friction_limit_from
from hopper.radial.members import physical_member
from hopper.radial.solution import solution_of
from hopper.stability.collocation import PARITIES, Parity
from hopper.stability.modes import (
    GOVERNORS,
    Disturbances,
    Governor,
    LinearStability,
    linear_stability,
)
from hopper.values import require_angle

REGIONS = (
    "stable",
    "stable_symmetric_only",
    "unstable",
    "no_radial_solution",
    "no_wall_angle",
    "non_positive_stress",
    "not_converged",
)
GOVERNED_BY = ("none", *GOVERNORS)
PARITY = ("none", *PARITIES)
_STABLE, _SYMMETRIC, _UNSTABLE, _NO_SOLUTION, _NO_WALL, _NON_POSITIVE, _NOT_CONVERGED = range(7)
# Relative errors of the governing mode, and of the others, which must only be seen to lie below.
_TOLERANCE, _OTHERS = 1e-9, 1e-5


@dataclass(frozen=True)
class Sweep:
    """Results at n wall friction angles; NaN where the region has no verdict.

    Attributes
    ----------
    friction_angle : array, shape (n,)
        phi, radians.
    region : integer array, shape (n,)
        Index into ``REGIONS``.
    abscissa, error_estimate : arrays, shape (n,)
        Supremum of Re(lambda) over the disturbances looked at, and its error.
    symmetric, asymmetric : arrays, shape (n,)
        The same for each parity; the second is NaN where it was not looked at.
    line : array, shape (n,)
        Abscissa of the asymptotic line.
    psi_max : array, shape (n,)
        Largest psi on the radial solution's nodes, radians.
    governed_by, parity : integer arrays, shape (n,)
        What the abscissa is due to, index into ``GOVERNED_BY`` and ``PARITY``; 0 without a verdict,
        and the parity also where the line governs.
    """

    friction_angle: Array
    region: NDArray[np.int8]
    abscissa: Array
    error_estimate: Array
    symmetric: Array
    asymmetric: Array
    line: Array
    psi_max: Array
    governed_by: NDArray[np.int8]
    parity: NDArray[np.int8]

    __repr__ = brief("friction_angle deg", "abscissa", "error_estimate")


@checked
def sweep_friction(
    hopper: Hopper, friction_angles: RealRow, disturbances: Disturbances | None = None
) -> Sweep:
    """Evaluate a hopper at increasing wall friction angles (radians).

    Neighbours start each other's iteration. ``disturbances`` as in
    :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    InvalidParameterError
        If the angles do not increase or lie outside [0, pi/2).
    """
    angles = np.asarray(friction_angles)
    if np.any(np.diff(angles) <= 0):
        raise InvalidParameterError("friction_angles must increase: sort and remove repeated ones")
    for angle in angles:
        require_angle("friction_angle", angle, zero_allowed=True)
    region = np.full(angles.size, _NO_SOLUTION, dtype=np.int8)
    region[angles > hopper.material.largest_friction_angle(hopper.delta)] = _NO_WALL
    values = np.full((6, angles.size), np.nan)
    codes = np.zeros((2, angles.size), dtype=np.int8)
    last: Member | None = None
    for i in np.flatnonzero(region == _NO_SOLUTION):
        try:
            member = physical_member(hopper, float(angles[i]), last)
            if member is None:
                rest = (np.arange(angles.size) >= i) & (region == _NO_SOLUTION)
                region[rest & (angles <= _limit(last, angles[-1]))] = _NOT_CONVERGED
                break
            last = member
            if member.tau <= 0:
                region[i] = _NON_POSITIVE
                continue
            solution = solution_of(member)
            result = linear_stability(solution, disturbances, tolerance=_TOLERANCE, others=_OTHERS)
        except ConvergenceError:
            region[i] = _NOT_CONVERGED
        else:
            region[i], values[:-1, i], codes[:, i] = _row(result)
            values[-1, i] = solution.psi.max()
    return Sweep(angles, region, *values, *codes)


def _limit(member: Member | None, highest: float) -> float:
    """Return the largest friction angle with a solution, or ``highest`` if it is no smaller.

    That of ``member`` where it is not resolved.
    """
    if member is None:
        return -np.inf
    law, delta = member.hopper.material, member.hopper.delta
    for following in family_from(member):
        if following.psi_wall_by_tau <= 0:
            break
        member = following
        if law.friction_angle(delta, member.psi_wall) >= highest:
            return highest
    try:
        return friction_limit_from(member).friction_angle
    except ConvergenceError:
        return solution_of(member).friction_angle


def _row(result: LinearStability) -> tuple[int, tuple[float, ...], tuple[int, int]]:
    """Return the region, the numbers and the codes of a verdict."""
    asymmetric = result.asymmetric
    numbers = (
        result.abscissa,
        result.error_estimate,
        result.symmetric[0],
        np.nan if asymmetric is None else asymmetric[0],
        result.line.abscissa,
    )
    region = _STABLE if result.stable else _SYMMETRIC if numbers[2] < 0 else _UNSTABLE
    return region, numbers, _codes(result.governed_by, result.parity)


def _codes(governor: Governor, parity: Parity | None) -> tuple[int, int]:
    return GOVERNED_BY.index(governor), PARITY.index(parity or "none")
