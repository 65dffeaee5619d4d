"""Stress fields of a march on the loop: at one time, at many, and their momentum balance."""

from dataclasses import dataclass

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.equations import psi_factor, tilt
from hopper.march.history import History
from hopper.march.loop import Loop, rate, step

# Step of the central difference in tau, in parts of the march's own steps: its error, about the
# step's to the second power, is then that of the march.
_DIFFERENCE = 0.02
# Steps of Runge-Kutta's method in one of the march, which are longer.
_PARTS = 2


@dataclass(frozen=True, eq=False)
class Stress:
    """Components of T = r T(tau, theta), in units of rho g r, each of one shape."""

    rr: Array
    rt: Array
    tt: Array
    pp: Array

    __repr__ = brief("rr", "rt", "tt")


def stress_of(s: float, sigma: Array, psi: Array) -> Stress:
    """Return the Mohr-Coulomb stress of average sigma and angle psi; s = sin(delta)."""
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    return Stress(
        rr=sigma * (1 - s * c2), rt=-s * sigma * s2, tt=sigma * (1 + s * c2), pp=sigma * (1 + s)
    )


def state_at(history: History, tau: float) -> Array:
    """Return w, shape (legs, n), at any time of the march by shorter last steps."""
    last = max(int(np.searchsorted(history.tau, tau, side="right")) - 1, 0)
    w = history.w[last]
    length = (tau - float(history.tau[last])) / _PARTS
    for _ in range(_PARTS if length else 0):
        w = step(history.loop, w, rate(history.loop, w)[0], length)
    return w


def interpolated(history: History, tau: Array) -> Array:
    """Return w at increasing times ``tau`` (m,) by cubic Hermite polynomials, (m, legs, n)."""
    return hermite(history.tau, history.w, history.rate, tau)


def hermite(times: Array, values: Array, rates: Array, tau: Array) -> Array:
    """Return cubic Hermite polynomials of values (k, ...) and rates at ``tau`` (m,), (m, ...)."""
    cell = np.clip(np.searchsorted(times, tau) - 1, 0, len(times) - 2)
    shape = (-1,) + (1,) * (values.ndim - 1)
    length = (times[cell + 1] - times[cell]).reshape(shape)
    z = (tau - times[cell]).reshape(shape) / length
    rise = values[cell + 1] - values[cell]
    left, right = length * rates[cell], length * rates[cell + 1]
    cubic = left + right - 2 * rise
    return ((cubic * z + (rise - left - cubic)) * z + left) * z + values[cell]


def deviations(loop: Loop, w: Array, x: Array) -> tuple[Array, Array]:
    """Return those of log sigma and psi at x = theta / theta_w from w (..., legs, n), (..., m)."""
    plus = w[..., 0, :] @ loop.mesh.interpolation(x).T
    minus = w[..., -1, :] @ loop.mesh.interpolation(-x).T
    return 0.5 * (plus + minus), psi_factor(loop.base.hopper) * (plus - minus)


def momentum_residual(history: History, tau: float) -> float:
    """Return the largest residual of the momentum balance at one time, over that of weight.

    It is formed from the stresses, not from the Riemann variables, with a central difference in
    tau, in units of rho g:

        T_rr,tau - T_rt,theta = (2 + k) T_rr - T_tt + k (cot T_rt - T_pp) + cos theta
        T_rt,tau - T_tt,theta = (3 + k) T_rt + k cot (T_tt - T_pp)        - sin theta
    """
    loop = history.loop
    hopper, k = loop.base.hopper, loop.base.hopper.curvature
    last = min(int(np.searchsorted(history.tau, tau, side="right")), history.tau.size - 1)
    span = _DIFFERENCE * float(history.tau[last] - history.tau[last - 1])
    # Both sides of the difference from one stored state.
    start = float(history.tau[last - 1])
    middle = min(max(tau, start + span), float(history.tau[last]) - span)
    before, now, after = (
        _nodal_stress(loop, state_at(history, middle + shift)) for shift in (-span, 0.0, span)
    )

    def in_time(name: str) -> Array:
        return (getattr(after, name) - getattr(before, name)) / (2 * span)

    def in_angle(name: str) -> Array:
        slope = getattr(now, name) @ loop.derivative
        return slope - tilt(hopper, loop.state.psi) * in_time(name) if loop.base.tilted else slope

    cot = 1 / np.tan(loop.y)
    radial = (
        (2 + k) * now.rr - now.tt + k * (cot * now.rt - now.pp) + np.cos(loop.y)
        - in_time("rr") + in_angle("rt")
    )  # fmt: skip
    angular = (
        (3 + k) * now.rt + k * cot * (now.tt - now.pp) - np.sin(loop.y)
        - in_time("rt") + in_angle("tt")
    )  # fmt: skip
    return float(max(np.abs(radial).max(), np.abs(angular).max()))


def _nodal_stress(loop: Loop, w: Array) -> Stress:
    """Return the stress at theta = y of all nodes, shape (n,)."""
    plus, minus = w[0], w[-1, ::-1]
    sigma = np.exp(0.5 * (plus + minus)) / loop.state.light
    psi = loop.state.psi + psi_factor(loop.base.hopper) * (plus - minus)
    return stress_of(loop.base.hopper.s, sigma, psi)
