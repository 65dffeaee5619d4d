"""Characteristics of the full steady equations, stress and velocity together, from their symbol.

A short wave of wave vector xi perturbs the stress along its yield surface and the velocity. Stress
balance is of first order in the stress; the flow rule is of first order in the velocity and
algebraic in the stress. With velocities counted one order smoother than stresses [DN], the symbol
is a homogeneous quartic in xi. Its real roots are the normals of characteristics: the equations
are hyperbolic where all four are real.

References
----------
.. [DN] A. Douglis, L. Nirenberg, Interior estimates for elliptic systems of partial differential
   equations, Comm. Pure Appl. Math. 8 (1955).
"""

import numpy as np
import scipy

from hopper.arguments import Fraction, checked
from hopper.arrays import Array, Complex
from hopper.errors import InvalidParameterError
from hopper.evidence.motion import stress
from hopper.yield_conditions import MOHR_COULOMB, YieldCondition

_SAMPLES = 8
_REAL = 1e-6
_LEAST_SINE = 1e-100


@checked
def real_characteristics(law: YieldCondition, s: Fraction, psi: float) -> int:
    """Return how many of the four characteristics of a radial stress state are real.

    ``s`` = sin(delta), ``psi`` in radians; a double one counts twice.

    Examples
    --------
    >>> from hopper import yield_condition
    >>> from hopper.evidence.characteristics import real_characteristics
    >>> real_characteristics(yield_condition("von-mises"), s=0.6, psi=0.2)
    4
    """
    return int(np.sum(np.abs(characteristic_normals(law, s, psi).imag) < _REAL))


@checked
def characteristic_normals(law: YieldCondition, s: Fraction, psi: float) -> Complex:
    """Return the angles from e_r to the normals of the characteristics, complex, shape (4,)."""
    # Even and of degree 4 on the circle: with w = exp(2 i angle), w**-2 times a quartic in w.
    angles = np.pi * np.arange(_SAMPLES) / _SAMPLES
    symbol = _mohr_coulomb_symbol if law == MOHR_COULOMB else _von_mises_symbol
    values = [np.linalg.det(symbol(law, s, psi, np.cos(a), np.sin(a))) for a in angles]
    if s < _LEAST_SINE or not np.isfinite(values).all():
        raise InvalidParameterError(f"s = {s:.3g} and psi = {psi:.3g} have no finite coefficients")
    modes = np.fft.fft(values)
    return np.log(np.roots(modes[[2, 1, 0, -1, -2]]).astype(complex)) / 2j


def _mohr_coulomb_symbol(law: YieldCondition, s: float, psi: float, xr: float, xt: float) -> Array:
    """Return the symbol for (sigma, psi, v_r, v_theta): (2.8), (2.9), (2.10), (2.11)."""
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    by_sigma = stress(law, s, 1.0, psi)
    rr, tt, rt = 2 * s * s2, -2 * s * s2, -2 * s * c2
    return np.array(
        [
            [xr * by_sigma.rr + xt * by_sigma.rt, xr * rr + xt * rt, 0, 0],
            [xr * by_sigma.rt + xt * by_sigma.tt, xr * rt + xt * tt, 0, 0],
            [0, 0, xr, xt],
            # Coaxiality; its dependence on psi cannot matter, as no velocity enters above.
            [0, 0, s2 * xr - c2 * xt, -c2 * xr - s2 * xt],
        ]
    )


def _von_mises_symbol(law: YieldCondition, s: float, psi: float, xr: float, xt: float) -> Array:
    """Return the symbol for (p, two ways along the yield surface, v_r, v_theta, chi).

    Rows: (2.8), (2.9), and V = chi (T - p I), (2.7), for rr, tt, pp and rt, with chi p = 1.
    """
    state = np.array(stress(law, s, 1.0, psi))
    deviator = (state - [1, 1, 1, 0]) / s
    # Traceless, and along the yield surface to first order.
    along = scipy.linalg.null_space(np.array([[1, 1, 1, 0], deviator * [1, 1, 1, 2]]))
    rr, tt, _, rt = np.column_stack([state, s * along])
    symbol = np.zeros((6, 6))
    symbol[0, :3] = xr * rr + xt * rt
    symbol[1, :3] = xr * rt + xt * tt
    # V_phiphi = -v_r / r is of lower order.
    symbol[2:, 3:5] = np.array([[-xr, 0], [0, -xt], [0, 0], [-xt / 2, -xr / 2]])
    symbol[2:, 1:3] = -s * along
    symbol[2:, 5] = -deviator
    return symbol
