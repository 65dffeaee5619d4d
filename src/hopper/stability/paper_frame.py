"""The paper's frame: the linearised stress equations (4.1) in t = log r.

With sigma = r (sigma0 + eps sigma1(t, theta)), psi = psi0 + eps psi1(t, theta) and t = log r,

    u_t + A u_theta + F u = 0,    u = (sigma1, psi1),    F = B + (d - 2) C.

The paper prints A12, B12, C12 twice and A21, B21, C21 half the values for these unknowns: its
unknowns are (sigma1, psi1 / 2). ``psi_scale`` p selects (sigma1, psi1 / p); eigenvalues do not
depend on it, norms do.
"""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import Positive, RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.radial.grid import half_grid
from hopper.radial.solution import RadialSolution
from hopper.stability.tilted import require_mohr_coulomb


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


@checked
def coefficients(
    solution: RadialSolution, theta: RealLike, psi_scale: Positive = 1.0
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
    require_mohr_coulomb(solution.hopper)
    theta = np.asarray(theta, dtype=float)
    if np.any(theta == 0):
        raise InvalidParameterError("theta = 0 is the axis, where C is singular: use other angles")
    return _coefficients(solution, theta, solution.fields(theta), psi_scale)


@checked
def coefficients_on_half_grid(
    solution: RadialSolution, m: int, psi_scale: Positive = 1.0
) -> Coefficients:
    """Return the coefficients at the ``m`` positive Chebyshev points, as :func:`coefficients`."""
    require_mohr_coulomb(solution.hopper)
    grid = half_grid(m, solution.hopper.half_angle)
    return _coefficients(solution, grid.theta, solution.fields_on([grid]), psi_scale)


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
