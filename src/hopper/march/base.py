"""The radial field under a march: its states on the loop, in time or tilted time."""

from dataclasses import dataclass
from math import degrees

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError, TangencyError
from hopper.march.equations import Coefficients, coefficients, terms, tilt
from hopper.problem import Hopper
from hopper.radial.grid import half_grid
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.stability.tilted import first_tangency
from hopper.yield_conditions import MOHR_COULOMB

# Cells and degree of the piecewise polynomials of a table: an error of 1e-12 where layers at the
# apex are wider than 1/50 of the hopper.
_CELLS, _DEGREE = 2048, 3
# Half-grid points for the height of tilted time.
_HEIGHT_POINTS = 120


@dataclass(frozen=True, eq=False)
class Base:
    """A radial field of a Mohr-Coulomb material and the time in which it is marched.

    ``tilted`` time tau - h(theta) is the one that passes tangencies of the radial field; its data
    lie on r = r_top exp(-h(theta)).
    """

    solution: RadialSolution
    tilted: bool

    __repr__ = brief(
        "hopper.geometry",
        "hopper.delta deg",
        "hopper.half_angle deg",
        "solution.friction_angle deg",
        "tilted",
    )

    @property
    def hopper(self) -> Hopper:
        """The hopper."""
        return self.solution.hopper


@dataclass(frozen=True, eq=False)
class BaseState:
    """The radial field at points ``y`` of a leg: psi, 1 / sigma, and its N, A and D."""

    y: Array
    psi: Array
    light: Array
    at: Coefficients
    numerator: Array
    a: Array
    d: Array

    __repr__ = brief("y deg", "psi deg")


@dataclass(frozen=True, eq=False)
class BaseTable:
    """psi and 1 / sigma of the radial field as piecewise polynomials on [0, theta_w].

    Made for points that move at every step, where spectral interpolation would cost too much.
    """

    half_angle: float
    powers: Array

    __repr__ = brief("half_angle deg")

    def __call__(self, theta: Array) -> tuple[Array, Array]:
        """Return psi and 1 / sigma at ``theta`` (radians, in [0, theta_w]), shapes (n,)."""
        position = theta * (_CELLS / self.half_angle)
        # What is no number ends up in some cell.
        cell = np.maximum(np.minimum(position.astype(np.intp), _CELLS - 1), 0)
        z = np.empty((2, theta.size))
        z[:] = 2 * (position - cell) - 1
        powers = self.powers.take(cell, axis=2)
        psi, light = ((powers[0] * z + powers[1]) * z + powers[2]) * z + powers[3]
        return psi, light


@checked
def base_of(solution: RadialSolution, tilted: bool | None = None) -> Base:
    """Return the base of a march; time is tilted where it must be, unless told.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb.
    TangencyError
        If time is not to be tilted and psi of the radial field reaches pi/4 - delta/2.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.march.base import base_of
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> base_of(solution).tilted
    False
    """
    if solution.hopper.material != MOHR_COULOMB:
        raise InvalidParameterError(
            "the stress march is formulated for Mohr-Coulomb materials only: use mohr-coulomb"
        )
    tangency = first_tangency(solution)
    if tilted is False and tangency is not None:
        raise TangencyError(
            f"psi of the radial field reaches pi/4 - delta/2 at theta = {degrees(tangency):.6g} "
            "deg: use tilted time",
            tangency,
        )
    return Base(solution, tangency is not None if tilted is None else tilted)


@checked
def radial_fields(base: Base, theta: Array) -> tuple[Array, Array]:
    """Return sigma, exactly even, and psi, exactly odd in ``theta`` (radians, shape (n,))."""
    sigma, psi, _, _ = base.solution.fields(np.abs(theta))
    return sigma, np.copysign(1.0, theta) * psi


@checked
def base_state(base: Base, y: Array) -> BaseState:
    """Return the radial field at points ``y`` of a leg (radians, shape (n,), not 0 in a cone)."""
    sigma, psi = radial_fields(base, y)
    light = 1 / sigma
    slope = tilt(base.hopper, psi) if base.tilted else np.zeros_like(y)
    at = coefficients(base.hopper, y, slope)
    return BaseState(y, psi, light, at, *terms(at, np.tan(psi), light))


@checked
def base_table(base: Base) -> BaseTable:
    """Return psi and 1 / sigma of the radial field as piecewise polynomials."""
    z = np.cos(np.pi * (np.arange(_DEGREE + 1) + 0.5) / (_DEGREE + 1))
    theta = (np.arange(_CELLS)[:, None] + 0.5 + z / 2) * (base.hopper.half_angle / _CELLS)
    sigma, psi, _, _ = base.solution.fields(theta.ravel())
    values = np.stack([psi, 1 / sigma]).reshape(2, _CELLS, _DEGREE + 1)
    powers = np.einsum("pz,scz->psc", np.linalg.inv(np.vander(z)), values)
    return BaseTable(base.hopper.half_angle, np.ascontiguousarray(powers))


@checked
def tilt_height(base: Base, theta: Array) -> Array:
    """Return h (even) at ``theta`` (radians, shape (n,)); 0 where time is not tilted."""
    if not base.tilted:
        return np.zeros_like(theta)
    grid = half_grid(_HEIGHT_POINTS, base.hopper.half_angle)
    slope = tilt(base.hopper, base.solution.psi_at(grid.theta))
    height = base.hopper.half_angle * chebyshev.integrate_odd(slope)
    return grid.interpolation(theta, "even") @ height
