"""The stress equations in Riemann variables, on a hopper unfolded into a loop.

With T = r T(tau, theta) and tau = -log(r / r_top) the stress equations of a Mohr-Coulomb material
have the exact Riemann variables R+- = log sigma +- 2 tan(delta) psi. R- at theta is R+ at -theta
of the hopper seen in a mirror. So

    W_tau + a W_y = G,    W = R+,    log sigma = (W + V) / 2,    psi = (W - V) / (4 tan delta)

is all there is, with V(y) the mirrored partner's W(-y). A *leg* of the loop runs from one wall to
the other and goes on as its partner; where sigma is even and psi odd, the only leg is its own
partner. Over cos(psi) all terms are linear in t = tan(psi): with eta = pi/4 - delta/2, k = d - 2,

    a = A / D,    G = N / D,    A = cos eta - t sin eta,    D = sin eta + t cos eta - h' A,
    N cos(delta) = (1 - k s) (cos eta + t sin eta) - (3 + k) s A - 2 k s t cos(eta) cot(y)
                   + (cos(eta - y) + t sin(eta - y)) / sigma.

h' is the slope of *tilted time* tau - h(theta), 0 if it is not tilted. Where D = 0 a
characteristic is tangent to the lines of constant time.
"""

from dataclasses import dataclass
from math import cos, sin, tan

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.problem import Hopper
from hopper.stability.tilted import tangency_angle


@dataclass(frozen=True)
class Coefficients:
    """Coefficients of N = n0 + n1 t + (l0 + l1 t) / sigma and D = d0 + d1 t, at points y."""

    n0: float
    n1: Array
    l0: Array
    l1: Array
    cos_eta: float
    sin_eta: float
    d0: Array
    d1: Array

    __repr__ = brief("n0", "cos_eta", "sin_eta")


@dataclass(frozen=True)
class RaySlopes:
    """Slopes tau' = D / A and w' = N / A of a characteristic over y, and their derivatives.

    ``tau_by_t`` and ``w_by_t`` are those by tan(psi), ``w_by_light`` by log(1 / sigma). All are
    regular where a characteristic is tangent to the lines of constant time.
    """

    tau: Array
    w: Array
    tau_by_t: Array
    w_by_t: Array
    w_by_light: Array

    __repr__ = brief("tau", "w")


def psi_factor(hopper: Hopper) -> float:
    """Return psi (radians) over W - V, 1 / (4 tan delta)."""
    return 1 / (4 * tan(hopper.delta))


def tilt(hopper: Hopper, psi: Array) -> Array:
    """Return the slope h' = sin 2psi / (s + cos 2psi) of a radial field's tilted time."""
    t = np.tan(psi)
    return 2 * t / (1 + hopper.s - (1 - hopper.s) * t**2)


def coefficients(hopper: Hopper, y: Array, slope: Array) -> Coefficients:
    """Return the coefficients at points ``y`` of a leg (radians; not 0 in a cone).

    ``slope`` is h' there; all arrays have the shape of ``y``.
    """
    s, k, eta = hopper.s, hopper.curvature, tangency_angle(hopper.delta)
    over = 1 / cos(hopper.delta)
    hoop = 2 * k * s * cos(eta) / np.tan(y) if k else np.zeros_like(y)
    return Coefficients(
        n0=over * (1 - (3 + 2 * k) * s) * cos(eta),
        n1=over * ((1 + 3 * s) * sin(eta) - hoop),
        l0=over * np.cos(eta - y),
        l1=over * np.sin(eta - y),
        cos_eta=cos(eta),
        sin_eta=sin(eta),
        d0=sin(eta) - slope * cos(eta),
        d1=cos(eta) + slope * sin(eta),
    )


def terms(at: Coefficients, t: Array, light: Array) -> tuple[Array, Array, Array]:
    """Return N, A and D at states of tan(psi) ``t`` and 1 / sigma ``light``."""
    numerator = at.n0 + at.n1 * t + light * (at.l0 + at.l1 * t)
    return numerator, at.cos_eta - at.sin_eta * t, at.d0 + at.d1 * t


def ray_slopes(at: Coefficients, t: Array, light: Array) -> RaySlopes:
    """Return the slopes of characteristics at states ``t``, ``light`` with their derivatives."""
    numerator, a, d = terms(at, t, light)
    w = numerator / a
    # d1 A + sin_eta D = 1, however time is tilted.
    return RaySlopes(
        tau=d / a,
        w=w,
        tau_by_t=1 / a**2,
        w_by_t=(at.n1 + light * at.l1 + at.sin_eta * w) / a,
        w_by_light=light * (at.l0 + at.l1 * t) / a,
    )


def both_families(
    hopper: Hopper, theta: Array, t: Array, light: Array
) -> tuple[Array, Array, Array, Array]:
    """Return the slopes d tau/dy of C+ and C- and their dw/dy, for time that is not tilted.

    The same as :func:`ray_slopes` at y = theta and, in the mirror, at y = -theta, in fewer steps.

    Parameters
    ----------
    hopper : Hopper
        Of a Mohr-Coulomb material.
    theta : array, shape (n,)
        Radians; not 0 in a cone.
    t, light : array, shape (..., n)
        tan(psi) and 1 / sigma at theta.
    """
    s, k, eta = hopper.s, hopper.curvature, tangency_angle(hopper.delta)
    over, ce, se = 1 / cos(hopper.delta), cos(eta), sin(eta)
    c, sn, light = np.cos(theta), np.sin(theta), over * light
    even = over * (1 - (3 + 2 * k) * s) * ce + ce * light * (c - t * sn)
    if k:
        even -= (2 * over * s * ce) * t * (c / sn)
    odd = (over * (1 + 3 * s) * se) * t + se * light * (sn + t * c)
    ct, st = ce * t, se * t
    forward, backward = ce - st, ce + st
    return (
        (se + ct) / forward,
        (se - ct) / backward,
        (even + odd) / forward,
        (even - odd) / backward,
    )
