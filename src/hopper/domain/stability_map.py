"""Verdicts of stability along a sweep of wall friction, each with the region it lies in."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError, NoRadialSolutionError
from hopper.problem import Hopper
from hopper.radial.branch import branch_up_to, members_on
from hopper.radial.collocation import Member, largest_psi
from hopper.radial.members import physical_member
from hopper.radial.solution import solution_of
from hopper.stability.collocation import PARITIES, Parity
from hopper.stability.modes import (
    GOVERNORS,
    OTHERS,
    Disturbances,
    Governor,
    LinearStability,
    linear_stabilities,
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
# Relative error of the governing mode.
_TOLERANCE = 5e-10
# Errors of the radial fields that leave that.
_FIELDS = 1e-11


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
        Largest psi of the radial solution, radians.
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

    ``disturbances`` as in :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    InvalidParameterError
        If the angles do not increase or lie outside [0, pi/2).

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.domain.stability_map import sweep_friction
    >>> sweep = sweep_friction(Hopper("cone", delta=0.7, half_angle=0.35), [0.1, 0.3])
    >>> sweep.abscissa.round(4)
    array([-2.2805, -4.4827])
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
    allowed = np.flatnonzero(region == _NO_SOLUTION)
    members, region[allowed] = _members(hopper, angles[allowed])
    solved = {i: solution_of(m) for i, m in zip(allowed, members, strict=True) if m and m.tau > 0}
    results = linear_stabilities(
        list(solved.values()), disturbances, tolerance=_TOLERANCE, others=OTHERS
    )
    for (i, solution), result in zip(solved.items(), results, strict=True):
        if isinstance(result, ConvergenceError):
            region[i] = _NOT_CONVERGED
        else:
            region[i], values[:-1, i], codes[:, i] = _row(result)
            values[-1, i] = largest_psi(solution.member)
    return Sweep(angles, region, *values, *codes)


def _members(hopper: Hopper, angles: Array) -> tuple[list[Member | None], NDArray[np.int8]]:
    """Return the members at wall frictions, None where none is found, and their regions."""
    region = np.full(angles.size, _NO_SOLUTION, dtype=np.int8)
    psi_walls = np.array([hopper.material.wall_angle(hopper.delta, phi) for phi in angles])
    try:
        branch = branch_up_to(hopper, float(psi_walls.max(initial=0.0)))
    except NoRadialSolutionError:
        return [None] * angles.size, region
    members = members_on(branch, psi_walls, _FIELDS)
    last: Member | None = None
    for i, angle in enumerate(angles[psi_walls <= branch.reach]):
        region[i] = _NOT_CONVERGED
        try:
            members[i] = member = members[i] or physical_member(hopper, float(angle), last)
        except ConvergenceError:
            continue
        if member is None:
            region[i] = _NO_SOLUTION
            break
        last = member
        if member.tau <= 0:
            region[i] = _NON_POSITIVE
    return members, region


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
