"""Coefficients of the stress equations linearised about a radial solution, (4.1).

With sigma = r (sigma0 + eps sigma1(t, theta)), psi = psi0 + eps psi1(t, theta) and t = log r,

    u_t + A u_theta + F u = 0,    u = (sigma1, psi1),    F = B + (d - 2) C.

The paper prints A12, B12, C12 twice and A21, B21, C21 half the values for these unknowns: its
unknowns are (sigma1, psi1 / 2). ``psi_scale`` p selects (sigma1, psi1 / p); eigenvalues do not
depend on it, norms do.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hopper.chebyshev import Array
from hopper.errors import InvalidParameterError
from hopper.radial import RadialSolution
from hopper.yield_conditions import MOHR_COULOMB


@dataclass(frozen=True)
class Coefficients:
    """Entries of A and F = B + (d - 2) C at n angles, each of shape (n,).

    A11 = A22. ``q`` = sin(delta) - cos(2 psi) is negative where the equations are hyperbolic with
    t as time; where it vanishes a characteristic is tangent to the radial direction.
    """

    q: Array
    a11: Array
    a12: Array
    a21: Array
    f11: Array
    f12: Array
    f21: Array
    f22: Array


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
        positive, or an angle lies outside the hopper.
    """
    hopper = solution.hopper
    if hopper.material is not MOHR_COULOMB:
        raise InvalidParameterError(
            "linear stability is formulated for Mohr-Coulomb materials only: use mohr-coulomb"
        )
    if not (np.isfinite(psi_scale) and psi_scale > 0):
        raise InvalidParameterError(f"psi_scale = {psi_scale!r} must be a positive number")
    theta = np.asarray(theta, dtype=float)
    return _coefficients(hopper.s, hopper.curvature, theta, solution.fields(theta), psi_scale)


def _coefficients(
    s: float, k: int, theta: Array, fields: tuple[Array, Array, Array, Array], p: float
) -> Coefficients:
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
    c21 = -(1 + s) * ((1 - c2) * cot + s2) / (2 * sigma * q)
    c22 = (q - s2 * cot) / q
    return Coefficients(
        q=q,
        a11=-s2 / q,
        a12=p * 2 * s * sigma / q,
        a21=(1 - s**2) / (2 * s * sigma * q) / p,
        f11=b11 + k * c11,
        f12=p * (b12 + k * c12),
        f21=(b21 + k * c21) / p,
        f22=b22 + k * c22,
    )
