"""The slopes that the radial stress equations (2.8), (2.9) with (3.3) prescribe."""

import numpy as np

from hopper.arguments import Row, checked
from hopper.arrays import Array
from hopper.problem import Hopper
from hopper.radial.steps import equation_coefficients, terms_of
from hopper.values import require_equal_shapes

_NEAR_AXIS = 1e-7


@checked
def slopes(hopper: Hopper, theta: Row, sigma: Row, psi: Row) -> tuple[Array, Array]:
    """Return d log(sigma)/d theta and d psi/d theta that the equations prescribe, shape (n,).

    Examples
    --------
    >>> from numpy import array
    >>> from hopper import Hopper
    >>> from hopper.radial.equations import slopes
    >>> dlog, dpsi = slopes(Hopper("wedge", 0.7, 0.2), array([0.1]), array([0.4]), array([0.1]))
    >>> round(float(dpsi[0]), 4)
    1.2033
    """
    determinant, dlog, dpsi = flow(hopper, theta, sigma, psi)
    dlog, dpsi = dlog / determinant, dpsi / determinant
    near = np.abs(theta) < _NEAR_AXIS
    if near.any():
        # There cot(theta) sin(2 psi) is 2 psi' to second order, and its rounding is not.
        flat = np.zeros(int(near.sum()))
        light = np.cos(theta[near]) / sigma[near]
        terms = terms_of(psi[near], flat, flat, flat, light, flat)
        dpsi[near] = (
            equation_coefficients(hopper)[0] @ terms / (2 * hopper.s * (1 + hopper.curvature))
        )
    return dlog, dpsi


@checked
def flow(hopper: Hopper, theta: Row, sigma: Row, psi: Row) -> tuple[Array, Array, Array]:
    """Return the common denominator of the slopes and the two numerators, each of shape (n,).

    As derivatives of (theta, log sigma, psi) they are regular where psi is singular.
    """
    require_equal_shapes(theta=theta, sigma=sigma, psi=psi)
    cot = np.divide(1.0, np.tan(theta), out=np.zeros_like(theta), where=theta != 0)
    flat = np.zeros_like(theta)
    terms = terms_of(psi, cot, flat, flat, np.cos(theta) / sigma, np.sin(theta) / sigma)
    radial, angular, _, _, radial_l, radial_psi, angular_l, angular_psi = (
        equation_coefficients(hopper) @ terms
    )
    return (
        radial_l * angular_psi - radial_psi * angular_l,
        radial_psi * angular - angular_psi * radial,
        angular_l * radial - radial_l * angular,
    )
