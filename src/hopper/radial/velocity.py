"""Radial velocity field v = -u(theta) r^(1-d) e_r of a radial stress field, (3.4) and (3.5)."""

from dataclasses import dataclass
from math import degrees, pi, sqrt

import numpy as np

from hopper.arguments import RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError, SingularVelocityError
from hopper.problem import as_angles
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.yield_conditions import VON_MISES

_SIZES = (24, 48, 96, 192, 384, 768)
_TOLERANCE = 1e-12


@dataclass(frozen=True)
class VelocityField:
    """u(theta), normalised by u(0) = 1, as an even Chebyshev series of log u.

    ``error_estimate`` is the largest change of log u in the last mesh refinement.
    """

    half_angle: float
    log_u: Array
    error_estimate: float

    __repr__ = brief("half_angle deg", "wall", "error_estimate")

    @checked
    def at(self, theta: RealLike) -> Array:
        """Return u at ``theta`` (radians, |theta| <= theta_w), shape (n,).

        Raises
        ------
        InvalidParameterError
            If an angle lies outside the hopper.
        """
        x = as_angles("theta", theta) / self.half_angle
        if not np.all(np.abs(x) <= 1 + 1e-12):
            raise InvalidParameterError(
                f"theta lies outside the hopper: keep |theta| <= half_angle = "
                f"{degrees(self.half_angle):.6g} deg"
            )
        return np.exp(chebyshev.half_interpolation_matrix(self.log_u.size, x, "even") @ self.log_u)

    @property
    def wall(self) -> float:
        """u(theta_w) / u(0)."""
        return float(np.exp(self.log_u[-1]))


@checked
def decay_exponent(solution: RadialSolution) -> float:
    """Return c in u' = -c u tan 2psi: 3 (cone), 2 (wedge), sqrt(12) (von Mises).

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.radial.velocity import decay_exponent
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> decay_exponent(solution)
    3.0
    """
    hopper = solution.hopper
    return sqrt(12) if hopper.material == VON_MISES else 2.0 + hopper.curvature


@checked
def solve_velocity(solution: RadialSolution) -> VelocityField:
    """Integrate the velocity equation over a radial stress field.

    Raises
    ------
    SingularVelocityError
        If psi reaches pi/4 inside the hopper.
    ConvergenceError
        If log u is not resolved to 1e-6.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial, solve_velocity
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> round(solve_velocity(solution).wall, 4)
    0.494
    """
    theta = solution.first_angle_with(pi / 4)
    if theta is not None:
        raise SingularVelocityError(
            f"velocity is singular: psi reaches pi/4 at theta = {degrees(theta):.6g} deg; "
            "lower the wall friction to get a velocity field",
            theta,
        )
    coarse, error = None, np.inf
    for size in _SIZES:
        log_u = _log_u(solution, size)
        if coarse is not None:
            x = chebyshev.half_nodes(coarse.size)
            change = chebyshev.half_interpolation_matrix(size, x, "even") @ log_u - coarse
            previous, error = error, float(np.abs(change).max())
            if error < _TOLERANCE or (error < 1e-10 and error > previous / 2):
                break
        coarse = log_u
    if error > 1e-6:
        raise ConvergenceError(
            f"velocity not resolved: error {error:.1e}; psi comes too close to pi/4, "
            "lower the wall friction"
        )
    return VelocityField(solution.hopper.half_angle, log_u, max(error, solution.error_estimate))


def _log_u(solution: RadialSolution, size: int) -> Array:
    """Return log u on the half grid by integrating -c tan 2psi term by term."""
    half_angle = solution.hopper.half_angle
    x = chebyshev.half_nodes(size)
    slope = -decay_exponent(solution) * half_angle * np.tan(2 * solution.psi_at(half_angle * x))
    return chebyshev.integrate_odd(slope)
