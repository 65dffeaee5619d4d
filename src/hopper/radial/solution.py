"""Radial (similarity) stress fields T = r T(theta) for a given wall friction, paper section 3."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, tan
from typing import Literal, get_args

import numpy as np

from hopper.arguments import Positive, Radians, RealLike, checked
from hopper.arrays import Array
from hopper.brief import apart, brief
from hopper.errors import (
    ConvergenceError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    not_resolved_because,
)
from hopper.problem import Hopper, as_angles
from hopper.radial.collocation import Member, top_of
from hopper.radial.equations import slopes
from hopper.radial.fields import stacked_fields
from hopper.radial.friction_limit import friction_limit
from hopper.radial.grid import Grid
from hopper.radial.members import member_with_tau, members_with_wall_angle, physical_member
from hopper.radial.steps import normal_weight
from hopper.roots import root_between
from hopper.values import require_angle

Branch = Literal["physical", "second", "third"]
_BRANCHES: tuple[Branch, ...] = get_args(Branch)
# Part of an angle by which others are beside it.
_BESIDE = 1e-4


@dataclass(frozen=True, eq=False)
class RadialSolution:
    """A radial stress field with its error estimate.

    Attributes
    ----------
    hopper : Hopper
    friction_angle : float
        Wall friction angle phi, radians.
    branch : "physical", "second" or "third"
        Part of the family: before the fold, beyond it, beyond a second one.
    member : Member
        The discrete solution on its collocation grid.
    """

    hopper: Hopper
    friction_angle: float
    branch: Branch
    member: Member

    __repr__ = brief(
        "hopper.geometry",
        "hopper.delta deg",
        "hopper.half_angle deg",
        "friction_angle deg",
        "branch",
        "sigma_axis",
        "error_estimate",
    )

    @property
    def theta(self) -> Array:
        """Collocation points in (0, theta_w], radians, shape (m,)."""
        return self.member.grid.theta

    @property
    def sigma(self) -> Array:
        """Average stress at ``theta``, in units of rho g r, shape (m,)."""
        return np.exp(self.member.log_ratio) / self.member.tau

    @property
    def psi(self) -> Array:
        """Sokolovskii angle at ``theta``, radians, shape (m,)."""
        return self.member.psi

    @property
    def sigma_axis(self) -> float:
        """sigma_0 = sigma(0), in units of rho g r."""
        return 1 / self.member.tau

    @property
    def sigma_wall(self) -> float:
        """sigma(theta_w), in units of rho g r."""
        return float(self.sigma[-1])

    @property
    def psi_wall(self) -> float:
        """psi(theta_w), radians."""
        return self.member.psi_wall

    @property
    def error_estimate(self) -> float:
        """Bound on the errors of log(sigma / sigma_0) and psi at any theta, and of log sigma_0.

        From the convergence of the mesh, and from rounding as the wall's friction magnifies it:
        near the largest friction psi(theta_w) hardly determines the solution. Where the stress on
        the axis is large, so is its error: tau = 1 / sigma_0 is known to the member's error.
        """
        return self.member.error * max(1.0, self.sigma_axis)

    @checked
    def psi_at(self, theta: RealLike) -> Array:
        """Return psi (radians) at ``theta`` (radians, |theta| <= theta_w), shape (n,)."""
        return self.member.grid.interpolation(self._inside(theta), "odd") @ self.psi

    @checked
    def fields(self, theta: RealLike) -> tuple[Array, Array, Array, Array]:
        """Return sigma, psi, d sigma/d theta and d psi/d theta at ``theta``, each of shape (n,).

        Slopes come from the differential equations, so they carry no differentiation error.

        Parameters
        ----------
        theta : array, shape (n,)
            Radians, |theta| <= theta_w.

        Raises
        ------
        InvalidParameterError
            If an angle lies outside the hopper.
        """
        theta = self._inside(theta)
        log_ratio = self.member.grid.interpolation(theta, "even") @ self.member.log_ratio
        psi = self.member.grid.interpolation(theta, "odd") @ self.psi
        return self._with_slopes(theta, log_ratio, psi)

    @checked
    def fields_on(self, grids: Sequence[Grid]) -> tuple[Array, Array, Array, Array]:
        """Return :meth:`fields` at the points of half grids, one after the other, shape (n,)."""
        sigma, psi, dsigma, dpsi = stacked_fields([self.member], grids)
        return sigma[0], psi[0], dsigma[0], dpsi[0]

    def _with_slopes(
        self, theta: Array, log_ratio: Array, psi: Array
    ) -> tuple[Array, Array, Array, Array]:
        sigma = np.exp(log_ratio) / self.member.tau
        dlog, dpsi = slopes(self.hopper, theta, sigma, psi)
        return sigma, psi, sigma * dlog, dpsi

    def psi_maximum(self) -> tuple[float, float]:
        """Return (theta, psi), radians, at the largest psi on [0, theta_w].

        The slope of psi is that of the equations: its error is as small as that of the fields.
        """
        top, wall = top_of(self.psi), self.hopper.half_angle
        if not top:
            return wall, self.psi_wall
        theta = wall * float(self.member.grid.map.forward(np.cos([top]))[0][0])
        # The series knows its slope less well than the equations do: a Newton step by theirs.
        beside = theta * np.array([1 - _BESIDE, 1.0, 1 + _BESIDE])
        beside[2] = min(beside[2], wall)
        left, here, right = self.fields(beside)[3]
        if left > right:
            theta = min(theta + np.ptp(beside) * here / (left - right), wall)
        return float(theta), float(self.psi_at(theta)[0])

    @checked
    def first_angle_with(self, psi: float) -> float | None:
        """Return the least theta (radians) at which psi has the given value, None if nowhere."""
        theta, largest = self.psi_maximum()
        if not 0 <= psi <= largest:
            return None
        return root_between(lambda angle: float(self.psi_at(angle)[0]) - psi, 0.0, theta)

    def _inside(self, theta: RealLike) -> Array:
        theta = as_angles("theta", theta)
        if not np.all(np.abs(theta) <= self.hopper.half_angle * (1 + 1e-12)):
            raise InvalidParameterError(
                f"theta lies outside the hopper: keep |theta| <= half_angle = "
                f"{degrees(self.hopper.half_angle):.6g} deg"
            )
        return theta


@checked
def solve_radial(
    hopper: Hopper,
    friction_angle: Radians,
    branch: Branch = "physical",
    start: RadialSolution | None = None,
) -> RadialSolution:
    """Return the radial stress field of a hopper whose wall has the given friction.

    Parameters
    ----------
    hopper : Hopper
        Geometry and material.
    friction_angle : float
        Wall friction angle phi = arctan(mu), radians, in [0, pi/2).
    branch : "physical", "second" or "third"
        The branch connected to the smooth wall, or one beyond the fold.
    start : RadialSolution, optional
        A neighbour in a sweep; saves Newton steps.

    Raises
    ------
    InvalidParameterError
        If the friction or the branch is not valid.
    WallFrictionError
        If the material cannot transmit the wall's friction.
    NoRadialSolutionError
        If the wall is rougher than the largest friction with a solution on the branch.
    NonPositiveStressError
        If the stress would not be positive.
    ConvergenceError
        If the fields cannot be resolved.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> round(solve_radial(Hopper("cone", 0.7, 0.35), friction_angle=0.3).sigma_axis, 4)
    0.1185
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    if branch == "physical":
        member = _on_physical_branch(hopper, friction_angle, start)
        return RadialSolution(hopper, friction_angle, branch, member)
    found = _all_branches(hopper, friction_angle)
    if len(found) <= (index := _BRANCHES.index(branch)):
        raise NoRadialSolutionError(
            f"phi = {degrees(friction_angle):.6g} deg has no {branch} solution: it exists only "
            "near the fold of a cone; use branch = physical",
            friction_limit(hopper).friction_angle,
        )
    return found[index]


@checked
def radial_solutions(hopper: Hopper, friction_angle: Radians) -> list[RadialSolution]:
    """Return every radial stress field for the given wall friction (radians): one to three.

    The physical one first, then by falling stress on the axis.

    Raises
    ------
    HopperError
        As :func:`solve_radial` for the physical branch.

    Examples
    --------
    >>> from hopper import Hopper, radial_solutions
    >>> [one.branch for one in radial_solutions(Hopper("cone", 0.52, 0.52), friction_angle=0.34)]
    ['physical', 'second']
    """
    physical = solve_radial(hopper, friction_angle)
    return [physical, *_all_branches(hopper, friction_angle)[1:]]


def _all_branches(hopper: Hopper, friction_angle: float) -> list[RadialSolution]:
    psi_wall = hopper.material.wall_angle(hopper.delta, friction_angle)
    _require_below_limit(hopper, friction_angle)
    members = members_with_wall_angle(hopper, psi_wall)
    return [
        RadialSolution(hopper, friction_angle, branch, member)
        for branch, member in zip(_BRANCHES, members, strict=False)
    ]


@checked
def solve_radial_family(hopper: Hopper, sigma_axis: Positive) -> RadialSolution:
    """Return the member of the family with average stress ``sigma_axis`` on the axis.

    Parameters
    ----------
    hopper : Hopper
        Geometry and material.
    sigma_axis : float
        sigma_0 > 0, in units of rho g r. Its wall friction is part of the result.

    Raises
    ------
    InvalidParameterError
        If sigma_axis is not a positive number.
    NoRadialSolutionError
        If no member that slips downwards along its wall has this stress.
    ConvergenceError
        If the fields cannot be resolved.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial_family
    >>> round(solve_radial_family(Hopper("cone", 0.7, 0.35), sigma_axis=0.1).friction_angle, 4)
    0.3336
    """
    return solution_of(member_with_tau(hopper, 1 / sigma_axis))


@checked
def solution_of(member: Member) -> RadialSolution:
    """Return the radial solution of a member of the family, with the friction of its wall."""
    phi = member.hopper.material.friction_angle(member.hopper.delta, member.psi_wall)
    branch: Branch = "physical" if member.rising else "second"
    return RadialSolution(member.hopper, phi, branch, member)


def _on_physical_branch(
    hopper: Hopper, friction_angle: float, start: RadialSolution | None
) -> Member:
    member = physical_member(
        hopper, friction_angle, start.member if start and start.hopper == hopper else None
    )
    if member is None:
        _require_below_limit(hopper, friction_angle)
        raise ConvergenceError(
            f"radial solution not resolved at phi = {degrees(friction_angle):.6g} deg: "
            f"{not_resolved_because(friction_angle)}"
        )
    if member.tau <= 0:
        raise NonPositiveStressError(_non_positive_stress(hopper, friction_angle))
    return member


def _require_below_limit(hopper: Hopper, friction_angle: float) -> None:
    limit = friction_limit(hopper)
    if friction_angle <= limit.friction_angle:
        return
    reason = {
        "fold": "the family of solutions folds there",
        "wall": "the wall is as rough as the material there",
        "interior": "psi reaches its singular angle inside the hopper there",
        "axis": "the stress on the axis vanishes there",
    }[limit.end]
    phi, largest = apart(degrees(friction_angle), degrees(limit.friction_angle))
    mu, largest_mu = apart(tan(friction_angle), tan(limit.friction_angle))
    raise NoRadialSolutionError(
        f"no radial solution at phi = {phi} deg (mu = {mu}): the largest friction that has one is "
        f"phi = {largest} deg (mu = {largest_mu}), {reason}; lower the wall friction",
        limit.friction_angle,
    )


def _non_positive_stress(hopper: Hopper, friction_angle: float) -> str:
    law = hopper.material
    weight = normal_weight(hopper) + hopper.curvature * law.hoop
    try:
        bound = member_with_tau(hopper, 0.0).psi_wall
        least = f"phi > {degrees(law.friction_angle(hopper.delta, bound)):.6g} deg"
    except NoRadialSolutionError:
        least = "more friction than its material can transmit"
    return (
        f"average stress is not positive at phi = {degrees(friction_angle):.6g} deg: "
        f"delta = {degrees(hopper.delta):.6g} deg is too small, a smooth wall needs delta > "
        f"{degrees(np.arcsin(1 / weight)):.4f} deg and this delta needs {least}; raise delta"
    )
