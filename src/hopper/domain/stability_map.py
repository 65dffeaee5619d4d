"""Verdicts of stability along a sweep of wall friction, each with the region it lies in."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError, TangencyError
from hopper.problem import Hopper, require_angle
from hopper.radial.collocation import Member
from hopper.radial.family import family_from
from hopper.radial.friction_limit import friction_limit_from
from hopper.radial.members import physical_member
from hopper.radial.solution import solution_of
from hopper.stability.modes import LinearStability, linear_stability

REGIONS = (
    "stable",
    "unstable",
    "tangent_characteristic",
    "no_radial_solution",
    "no_wall_angle",
    "non_positive_stress",
    "not_converged",
)
_TANGENT, _NO_SOLUTION, _NO_WALL, _NON_POSITIVE, _NOT_CONVERGED = range(2, 7)


@dataclass(frozen=True)
class Sweep:
    """Results at n wall friction angles; NaN where the region has no verdict.

    Attributes
    ----------
    friction_angle : array, shape (n,)
        phi, radians.
    region : integer array, shape (n,)
        Index into ``REGIONS``.
    abscissa, line, highest_mode, error_estimate : arrays, shape (n,)
        Supremum of Re(lambda), abscissa of the asymptotic line, largest real part of a low mode,
        error of the abscissa.
    """

    friction_angle: Array
    region: NDArray[np.int8]
    abscissa: Array
    line: Array
    highest_mode: Array
    error_estimate: Array

    __repr__ = brief("friction_angle deg", "abscissa", "error_estimate")


def sweep_friction(hopper: Hopper, friction_angles: ArrayLike) -> Sweep:
    """Evaluate a hopper at increasing wall friction angles (radians).

    Neighbours start each other's iteration. Beyond the tangency only the existence of a radial
    solution is decided, by the limit of its branch.

    Raises
    ------
    InvalidParameterError
        If the angles do not increase or lie outside [0, pi/2).
    """
    angles = np.asarray(friction_angles, dtype=float)
    if np.any(np.diff(angles) <= 0):
        raise InvalidParameterError("friction_angles must increase: sort and remove repeated ones")
    for angle in angles:
        require_angle("friction_angle", angle, zero_allowed=True)
    region = np.full(angles.size, _NO_SOLUTION, dtype=np.int8)
    region[angles > hopper.material.largest_friction_angle(hopper.delta)] = _NO_WALL
    values = np.full((4, angles.size), np.nan)
    last: Member | None = None
    for i in np.flatnonzero(region == _NO_SOLUTION):
        rest = (np.arange(angles.size) >= i) & (region == _NO_SOLUTION)
        try:
            member = physical_member(hopper, float(angles[i]), last)
            if member is None:
                region[rest & (angles <= _limit(last, angles[-1]))] = _NOT_CONVERGED
                break
            last = member
            if member.tau <= 0:
                region[i] = _NON_POSITIVE
                continue
            result = linear_stability(solution_of(member))
        except ConvergenceError:
            region[i] = _NOT_CONVERGED
        except TangencyError:
            region[rest & (angles <= _limit(last, angles[-1]))] = _TANGENT
            break
        else:
            region[i] = 0 if result.stable else 1
            values[:, i] = _numbers(result)
    return Sweep(angles, region, *values)


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


def _numbers(result: LinearStability) -> tuple[float, float, float, float]:
    highest = float(result.eigenvalues.real.max())
    return result.abscissa, result.line.abscissa, highest, result.error_estimate
