"""How far down a hopper the stress has settled to the radial field, for good."""

from math import ceil

import numpy as np

from hopper.arrays import Array
from hopper.march.base import radial_fields, tilt_height
from hopper.march.fields import deviations, interpolated, stress_of
from hopper.march.history import History
from hopper.march.loop import Loop, jacobian
from hopper.spectral import chebyshev

# Samples per loop time, and angles on each half of the hopper.
_PER_LOOP, _ANGLES = 128, 40
# Loop times after the last passage of a level in which it must not be passed again.
_WAIT = 3
# Part of the largest eigenvalue up to which eigenvalues of a loop count as resolved.
_RESOLVED = 0.25


def loop_time(loop: Loop) -> float:
    """Return the tau that a wave on the radial field takes from wall to wall."""
    points = chebyshev.nodes(2 * loop.y.size)
    slowness = loop.mesh.interpolation(points) @ (loop.state.d / loop.state.a)
    weights = chebyshev.clenshaw_curtis_weights(points.size)
    return float(loop.base.hopper.half_angle * (weights @ slowness))


def linear_growth(loop: Loop) -> float:
    """Return the largest growth rate of resolved small deviations, per unit of tau."""
    values = np.linalg.eigvals(jacobian(loop))
    modulus = np.abs(values)
    return float(values[modulus < _RESOLVED * modulus.max()].real.max())


def settled_radius(
    coarse: History, fine: History, tau_end: float, level: float
) -> tuple[float, float] | None:
    """Return r / r_top from which on all stresses stay within ``level`` of the radial field's.

    The measure is the largest |T_ij - T0_ij| / sigma0 over the hopper and the components, its last
    passage of the level counts. As norms oscillate with the loop time, it must be some loop times
    before ``tau_end``: None if it is not. The error, second, is what the passage shifts by if the
    measure is wrong by what two meshes, whose errors fall like their spacing, tell: in a cone a
    kink that is focused on the axis has a peak there, which coarse meshes cut off.
    """
    loop, other = fine.loop, coarse.loop
    x = np.linspace(0 if loop.legs == 1 else -1, 1, _ANGLES + 1)
    loops = tau_end / loop_time(loop)
    tau = np.linspace(0, tau_end, ceil(_PER_LOOP * loops) + 1)
    distance = distances(fine, tau, x)
    factor = other.y.size / (loop.y.size - other.y.size)
    error = factor * np.abs(distance - distances(coarse, tau, x))
    latest = tau_end * (1 - _WAIT / loops)
    height = tilt_height(loop.base, loop.base.hopper.half_angle * x)
    radius, *others = (
        _radius(tau, each, level, latest, height)
        for each in (distance, distance - error, distance + error)
    )
    if radius == max(others) == 0.0:
        return None
    return radius, max(abs(each - radius) for each in others)


def _radius(tau: Array, distance: Array, level: float, latest: float, height: Array) -> float:
    """Return the r / r_top that (times, angles) of ``distance`` tell; 0 if it is not reached."""
    # Tilted time meets each angle at its own depth.
    passage = np.array([_last_passage(tau, each, level) for each in distance.T])
    return float(np.exp(-passage - height).min()) if passage.max() <= latest else 0.0


def distances(history: History, tau: Array, x: Array) -> Array:
    """Return the largest |T_ij - T0_ij| / sigma0 of components at tau (m,) and x (n,), (m, n)."""
    base, hopper = history.loop.base, history.loop.base.hopper
    even, odd = deviations(history.loop, interpolated(history, tau), x)
    _, psi = radial_fields(base, hopper.half_angle * x)
    radial = stress_of(hopper.s, np.ones_like(psi), psi)
    now = stress_of(hopper.s, np.exp(even), psi + odd)
    parts = ["rr", "rt", "tt"] + ["pp"] * hopper.curvature
    return np.max([np.abs(getattr(now, p) - getattr(radial, p)) for p in parts], axis=0)


def _last_passage(tau: Array, distance: Array, level: float) -> float:
    """Return the time after which ``distance`` stays below ``level``; inf if it does not."""
    beyond = np.flatnonzero(distance >= level)
    if beyond.size == 0:
        return 0.0
    last = int(beyond[-1])
    if last == tau.size - 1:
        return np.inf
    part = (distance[last] - level) / (distance[last] - distance[last + 1])
    return float(tau[last] + part * (tau[last + 1] - tau[last]))
