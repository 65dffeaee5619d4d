"""Radial (similarity) stress fields T = r T(theta) for a given wall friction, paper section 3."""

from dataclasses import dataclass
from math import degrees
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hopper import family
from hopper.chebyshev import Array
from hopper.errors import InvalidParameterError, NonPositiveStressError, NoRadialSolutionError
from hopper.problem import Hopper, require_angle
from hopper.radial_collocation import Closure, Member, slopes, solve

Branch = Literal["physical", "second"]


@dataclass(frozen=True)
class RadialSolution:
    """A radial stress field with its error estimate.

    Attributes
    ----------
    hopper : Hopper
    friction_angle : float
        Wall friction angle phi, radians.
    branch : "physical" or "second"
        Part of the family: before or beyond the fold.
    member : Member
        The discrete solution on its collocation grid.
    """

    hopper: Hopper
    friction_angle: float
    branch: Branch
    member: Member

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
        """Largest change of log(sigma / sigma_0), psi, log sigma_0 in the last refinement."""
        return self.member.error

    def psi_at(self, theta: ArrayLike) -> Array:
        """Return psi (radians) at ``theta`` (radians, |theta| <= theta_w), shape (n,)."""
        return self.member.grid.interpolation(self._inside(theta), "odd") @ self.psi

    def fields(self, theta: ArrayLike) -> tuple[Array, Array, Array, Array]:
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
        sigma = np.exp(self.member.grid.interpolation(theta, "even") @ self.member.log_ratio)
        sigma /= self.member.tau
        psi = self.member.grid.interpolation(theta, "odd") @ self.psi
        dlog, dpsi = slopes(self.hopper, theta, sigma, psi)
        return sigma, psi, sigma * dlog, dpsi

    def psi_maximum(self) -> tuple[float, float]:
        """Return (theta, psi), radians, at the largest psi on [0, theta_w]."""
        theta = np.linspace(0, self.hopper.half_angle, 8 * self.theta.size + 1)
        peak = int(np.argmax(self.psi_at(theta)))
        if peak == theta.size - 1:
            return self.hopper.half_angle, self.psi_wall

        def slope(angle: float) -> float:
            return float(self.fields(angle)[3][0])

        low, high = theta[max(peak - 1, 0)], theta[peak + 1]
        angle = brentq(slope, low, high, xtol=1e-13) if slope(low) > 0 > slope(high) else 0.0
        return float(angle), float(self.psi_at(angle)[0])

    def _inside(self, theta: ArrayLike) -> Array:
        theta = np.atleast_1d(np.asarray(theta, dtype=float))
        if not np.all(np.abs(theta) <= self.hopper.half_angle * (1 + 1e-12)):
            raise InvalidParameterError(
                f"theta lies outside the hopper: keep |theta| <= half_angle = "
                f"{degrees(self.hopper.half_angle):.6g} deg"
            )
        return theta


def solve_radial(
    hopper: Hopper,
    friction_angle: float,
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
    branch : "physical" or "second"
        The branch connected to the smooth wall, or the one beyond the fold.
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
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    if branch not in ("physical", "second"):
        raise InvalidParameterError(f"branch = {branch!r} is unknown: use physical or second")
    psi_wall = hopper.material.wall_angle(hopper.delta, friction_angle)
    if branch == "second":
        member = _on_second_branch(hopper, friction_angle, psi_wall)
    else:
        member = _on_physical_branch(hopper, friction_angle, psi_wall, start)
    return RadialSolution(hopper, friction_angle, branch, member)


def solve_radial_family(hopper: Hopper, sigma_axis: float) -> RadialSolution:
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
    """
    if not (np.isfinite(sigma_axis) and sigma_axis > 0):
        raise InvalidParameterError(f"sigma_axis = {sigma_axis!r} must be a positive number")
    found = family.member_with_tau(hopper, 1 / sigma_axis)
    phi = hopper.material.friction_angle(hopper.delta, found.psi_wall)
    branch: Branch = "physical" if found.psi_wall_by_tau > 0 else "second"
    return RadialSolution(hopper, phi, branch, found)


def _on_physical_branch(
    hopper: Hopper, friction_angle: float, psi_wall: float, start: RadialSolution | None
) -> Member:
    closure = Closure("psi_wall", psi_wall)
    member = solve(hopper, closure, start.member) if start else None
    if member is None or member.psi_wall_by_tau <= 0:
        member = solve(hopper, closure)
    if member is None or member.psi_wall_by_tau <= 0:
        _require_below_limit(hopper, friction_angle)
        member = family.members_with_wall_angle(hopper, psi_wall)[0]
    if member.tau <= 0:
        raise NonPositiveStressError(_non_positive_stress(hopper, friction_angle))
    return member


def _on_second_branch(hopper: Hopper, friction_angle: float, psi_wall: float) -> Member:
    _require_below_limit(hopper, friction_angle)
    found = family.members_with_wall_angle(hopper, psi_wall)
    if len(found) < 2:
        raise NoRadialSolutionError(
            f"phi = {degrees(friction_angle):.6g} deg has no second solution: it exists only "
            "between the mass-flow limit and the fold of a cone; use branch = physical",
            family.friction_limit(hopper).friction_angle,
        )
    return found[1]


def _require_below_limit(hopper: Hopper, friction_angle: float) -> None:
    limit = family.friction_limit(hopper)
    if friction_angle <= limit.friction_angle:
        return
    reason = {
        "fold": "the family of solutions folds there",
        "wall": "the wall is as rough as the material there",
        "interior": "psi reaches its singular angle inside the hopper there",
        "axis": "the stress on the axis vanishes there",
    }[limit.end]
    raise NoRadialSolutionError(
        f"no radial solution at phi = {degrees(friction_angle):.6g} deg "
        f"(mu = {np.tan(friction_angle):.6g}): the largest friction that has one is "
        f"phi = {degrees(limit.friction_angle):.6g} deg "
        f"(mu = {np.tan(limit.friction_angle):.6g}), {reason}; lower the wall friction",
        limit.friction_angle,
    )


def _non_positive_stress(hopper: Hopper, friction_angle: float) -> str:
    smooth = degrees(np.arcsin(1 / (3 + 2 * hopper.curvature)))
    bound = family.member_with_tau(hopper, 0.0)
    phi = hopper.material.friction_angle(hopper.delta, bound.psi_wall)
    return (
        f"average stress is not positive at phi = {degrees(friction_angle):.6g} deg: "
        f"delta = {degrees(hopper.delta):.6g} deg is too small, a smooth wall needs "
        f"delta > {smooth:.4f} deg and this delta needs phi > {degrees(phi):.6g} deg; raise delta"
    )
