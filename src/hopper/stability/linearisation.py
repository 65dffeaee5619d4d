"""Coefficients of the stress equations linearised about a radial solution, (4.1).

With sigma = r (sigma0 + eps sigma1(t, theta)), psi = psi0 + eps psi1(t, theta) and t = log r,

    u_t + A u_theta + F u = 0,    u = (sigma1, psi1),    F = B + (d - 2) C.

The paper prints A12, B12, C12 twice and A21, B21, C21 half the values for these unknowns: its
unknowns are (sigma1, psi1 / 2). ``psi_scale`` p selects (sigma1, psi1 / p); eigenvalues do not
depend on it, norms do.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError, TangencyError
from hopper.radial.grid import half_grid
from hopper.radial.solution import RadialSolution
from hopper.yield_conditions import MOHR_COULOMB

# Half grids that modes and line begin with. At these sizes numpy's overhead is most of the cost, so
# their coefficients are evaluated together.
_FIRST_GRIDS = (16, 24, 36)
# Largest psi at the nodes, and at those of a grid four times as fine, relative to the limit, from
# which a closer look at the maximum is due: they miss it to second order in their distance.
_NEAR, _NEAR_ON_FINER = 0.98, 0.998


@dataclass(frozen=True)
class Coefficients:
    """Entries of A and F = B + (d - 2) C at n angles, each of shape (n,).

    ``sigma`` and ``psi`` are the radial solution's; A11 = A22. ``q`` = sin(delta) - cos(2 psi) is
    negative where the equations are hyperbolic with t as time; where it vanishes a characteristic
    is tangent to the arc r = const.
    """

    sigma: Array
    psi: Array
    q: Array
    a11: Array
    a12: Array
    a21: Array
    f11: Array
    f12: Array
    f21: Array
    f22: Array

    __repr__ = brief("sigma", "psi deg", "q")


def coefficients(
    solution: RadialSolution, theta: ArrayLike, psi_scale: float = 1.0
) -> Coefficients:
    """Return the coefficients of (4.1) at angles ``theta``.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    theta : array, shape (n,)
        Radians, 0 < |theta| <= theta_w.
    psi_scale : float
        p > 0 in the unknowns (sigma1, psi1 / p): 1 as defined, 2 as printed.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb (its velocity does not decouple), psi_scale is not
        positive, or an angle lies on the axis or outside the hopper.
    """
    _require_linear(solution, psi_scale)
    theta = np.asarray(theta, dtype=float)
    if np.any(theta == 0):
        raise InvalidParameterError("theta = 0 is the axis, where C is singular: use other angles")
    return _coefficients(solution, theta, solution.fields(theta), psi_scale)


def coefficients_on_half_grid(
    solution: RadialSolution, m: int, psi_scale: float = 1.0
) -> Coefficients:
    """Return the coefficients at the ``m`` positive Chebyshev points, as :func:`coefficients`.

    The arrays are read-only.
    """
    sizes = _FIRST_GRIDS if m in _FIRST_GRIDS else (m,)
    return _on_half_grids(solution, sizes, psi_scale)[sizes.index(m)]


@lru_cache(maxsize=4)
def _on_half_grids(
    solution: RadialSolution, sizes: tuple[int, ...], psi_scale: float
) -> tuple[Coefficients, ...]:
    _require_linear(solution, psi_scale)
    grids = [half_grid(m, solution.hopper.half_angle) for m in sizes]
    theta = np.concatenate([grid.theta for grid in grids])
    at = vars(_coefficients(solution, theta, solution.fields_on(grids), psi_scale))
    for array in at.values():
        array.flags.writeable = False
    parts = [slice(stop - m, stop) for m, stop in zip(sizes, np.cumsum(sizes), strict=True)]
    return tuple(Coefficients(**{name: at[name][part] for name in at}) for part in parts)


def _require_linear(solution: RadialSolution, psi_scale: float) -> None:
    if solution.hopper.material != MOHR_COULOMB:
        raise InvalidParameterError(
            "linear stability is formulated for Mohr-Coulomb materials only: use mohr-coulomb"
        )
    if not (np.isfinite(psi_scale) and psi_scale > 0):
        raise InvalidParameterError(f"psi_scale = {psi_scale!r} must be a positive number")


def _coefficients(
    solution: RadialSolution, theta: Array, fields: tuple[Array, Array, Array, Array], p: float
) -> Coefficients:
    s, k = solution.hopper.s, solution.hopper.curvature
    sigma, psi, dsigma, dpsi = fields
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    cot = 1 / np.tan(theta)
    q = s - c2
    b11 = (2 * s * dpsi + 3 * s - c2) / q
    b12 = 2 * s * dsigma / q
    b21 = -(1 + dpsi) * s2 / (sigma * q)
    b22 = 3 + 2 * dpsi - dsigma * s2 / (sigma * q)
    c11 = s * (s2 * cot + c2 + 1) / q
    c12 = 2 * s * sigma * cot / q
    # 1 - cos(2 psi) = 2 sin(psi)**2 keeps its digits near the axis.
    c21 = -(1 + s) * (2 * np.sin(psi) ** 2 * cot + s2) / (2 * sigma * q)
    c22 = (q - s2 * cot) / q
    return Coefficients(
        sigma=sigma,
        psi=psi,
        q=q,
        a11=-s2 / q,
        a12=p * 2 * s * sigma / q,
        a21=(1 - s**2) / (2 * s * sigma * q) / p,
        f11=b11 + k * c11,
        f12=p * (b12 + k * c12),
        f21=(b21 + k * c21) / p,
        f22=b22 + k * c22,
    )


def tangency_angle(delta: float) -> float:
    """Return the psi (radians) at which a characteristic is tangent to the arcs r = const."""
    return pi / 4 - delta / 2


@lru_cache(maxsize=8)
def require_no_tangency(solution: RadialSolution) -> None:
    """Check that psi stays below pi/4 - delta/2.

    Raises
    ------
    TangencyError
        If it does not.
    """
    limit = tangency_angle(solution.hopper.delta)
    if solution.psi.max() < _NEAR * limit:
        return
    finer = half_grid(4 * solution.theta.size, solution.hopper.half_angle)
    if solution.fields_on([finer])[1].max() < _NEAR_ON_FINER * limit:
        return
    theta, largest = solution.psi_maximum()
    if largest >= limit:
        first = brentq(lambda angle: float(solution.psi_at(angle)[0]) - limit, 0.0, theta)
        raise TangencyError.at(solution.hopper.delta, first)
