"""The radial equations written out a second time, from the stress components, and shot outwards.

Nothing here comes from the package. The components T (over sigma) and their slopes by psi are put
into the divergence form of the equations of motion; a 2 x 2 system yields sigma' and psi'.
"""

from math import sqrt, tan

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

ROOT3 = sqrt(3)


def components(model, s, psi):
    """Return (T_rr, T_tt, T_rt, T_pp) / sigma and the psi slopes of (T_tt, T_rt) / sigma."""
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    if model == "mohr-coulomb":
        tensor = (1 - s * c2, 1 + s * c2, -s * s2, 1 + s + 0 * psi)
        return tensor, (-2 * s * s2, -2 * s * c2)
    angular = 1 + s * c2 / ROOT3
    tensor = (1 - 2 * s * c2 / ROOT3, angular, -s * s2, angular)
    return tensor, (-2 * s * s2 / ROOT3, -2 * s * c2)


def momentum(model, k, s, theta, sigma, psi, dsigma, dpsi):
    """Return the residuals of the radial and the angular equation of motion."""
    (rr, tt, rt, pp), (tt_psi, rt_psi) = components(model, s, psi)
    cot = 1 / np.tan(theta)
    radial = dsigma * rt + sigma * rt_psi * dpsi
    radial += sigma * ((2 + k) * rr - tt + k * (cot * rt - pp)) + np.cos(theta)
    angular = dsigma * tt + sigma * tt_psi * dpsi
    angular += sigma * ((3 + k) * rt + k * cot * (tt - pp)) - np.sin(theta)
    return radial, angular


def slopes(model, k, s, theta, sigma, psi):
    """Return d sigma/d theta and d psi/d theta."""
    (_, tt, rt, _), (tt_psi, rt_psi) = components(model, s, psi)
    radial, angular = momentum(model, k, s, theta, sigma, psi, 0.0, 0.0)
    # Cramer's rule for [rt, sigma rt_psi; tt, sigma tt_psi] (sigma', psi') = -(radial, angular).
    determinant = sigma * (rt * tt_psi - rt_psi * tt)
    dsigma = sigma * (rt_psi * angular - tt_psi * radial) / determinant
    return dsigma, (tt * radial - rt * angular) / determinant


def apex(model, k, s, sigma_axis):
    """Return psi'(0) and sigma''(0)."""
    if model == "mohr-coulomb":
        slope = (1 + (1 - 3 * s - 2 * k * s) * sigma_axis) / ((2 + 2 * k) * s * sigma_axis)
        shear = 2 * s * sigma_axis * slope
        return slope, (1 + (3 + k) * shear + (2 + k) * slope * shear) / (1 + s)
    slope = (1 + (1 - 8 * s / ROOT3) * sigma_axis) / (4 * s * sigma_axis)
    shear = 2 * s * sigma_axis * slope
    return slope, (1 + 4 * shear + 2 * slope * shear / ROOT3) / (1 + s / ROOT3)


def shoot(model, k, s, sigma_axis, theta, rtol=1e-13):
    """Integrate outwards from sigma(0); return sigma and psi at the increasing angles ``theta``."""
    slope, curvature = apex(model, k, s, sigma_axis)
    # Far inside the apex layer, so that two terms of the series are exact to rounding.
    start = 1e-5 * min(1.0, sigma_axis) * theta[-1]
    result = solve_ivp(
        lambda t, y: slopes(model, k, s, t, y[0], y[1]),
        (start, theta[-1]),
        [sigma_axis + curvature * start**2 / 2, slope * start],
        method="DOP853",
        rtol=rtol,
        atol=1e-15,
        t_eval=theta,
    )
    assert result.success, result.message
    return result.y


def wall_angle(model, s, friction_angle):
    """Return psi_w with T_rt = -mu T_tt, found numerically on the branch from the smooth wall."""

    def slip(psi):
        (_, tt, rt, _), _ = components(model, s, psi)
        return -rt / tt - tan(friction_angle)

    steepest = minimize_scalar(
        lambda psi: -slip(psi), bounds=(0, 1.5), method="bounded", options={"xatol": 1e-10}
    )
    return brentq(slip, 0.0, steepest.x, xtol=1e-15)


def friction_angle(model, s, psi):
    """Return phi of the wall at which the Sokolovskii angle is ``psi``."""
    (_, tt, rt, _), _ = components(model, s, psi)
    return np.arctan(-rt / tt)


def describe(hopper):
    """Return (model, k, s) of a Hopper, the parameters of this module."""
    model = {"Mohr-Coulomb": "mohr-coulomb", "von Mises": "von-mises"}[hopper.material.name]
    return model, {"wedge": 0, "cone": 1}[hopper.geometry], float(np.sin(hopper.delta))
