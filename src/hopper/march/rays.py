"""First crossing by Jacobians along characteristics through the fields of the loop.

Along a characteristic of W, with y for its time, the derivatives Q and P of its tau and w by its
label obey linear equations that stay regular where slopes of W become infinite: neighbours cross
where Q = 0. All of tau, w, Q and P are continuous at walls. Only the partner V and its rate are
taken from the loop, where they stay smooth for longer than W does.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hopper.arrays import Array, Mask
from hopper.march.base import base_state
from hopper.march.crossing import lowest
from hopper.march.equations import psi_factor, ray_slopes
from hopper.march.history import History

# Change of Q in one step, over its first value, beyond which its zero is not resolved.
_JUMP = 0.25
# Iterations of the trapezoidal rule at the axis, and the change at which they end.
_ITERATIONS, _CHANGE = 40, 1e-13
_NEWTON_STEPS = 8
# The axis of a cone, over theta_w, for what is evaluated there and not used.
_AXIS = 1e-7
# Time after the first crossing found for which other rays are followed.
_MARGIN = 0.01


@dataclass(frozen=True, eq=False)
class _Course:
    """Stations 0, 1, ..., 2 m of a leg, half a step apart, and what rays meet there.

    ``radial`` has the radial field's psi, 1 / sigma, N / A and n1, l0, l1, d0, d1 there,
    ``partner`` and ``partner_rate`` the deviation of V and its rate at the times of the march,
    (k, legs, 2 m + 1). m is odd: the axis is in the middle of a step.
    """

    history: History
    y: Array
    radial: Array
    partner: Array
    partner_rate: Array

    @property
    def step(self) -> float:
        """Length of a step in y, radians."""
        return float(self.y[2] - self.y[0])


@dataclass(frozen=True, eq=False)
class _Rays:
    """Rays with (tau, w, Q, P) in ``values`` (4, R), each at a ``station`` of a ``leg``."""

    values: Array
    leg: NDArray[np.intp]
    station: NDArray[np.intp]


def first_crossing_of_rays(history: History, steps: int) -> Array | None:
    """Return (tau, theta, family) of the first crossing in a march on the loop, or None.

    Parameters
    ----------
    history : History
        Of the march; it may go on behind the crossing, where it has no meaning.
    steps : int
        Of a ray from wall to wall, odd; as many rays start from each leg.
    """
    course = _course(history, steps)
    found: dict[int, Array] = {}
    with np.errstate(all="ignore"):
        rays = _start(course)
        scale = np.abs(rays.values[2])
        alive = np.ones(scale.size, dtype=bool)
        while alive.any():
            after = _advanced(course, rays)
            alive &= np.isfinite(after).all(axis=0) & (after[0] >= rays.values[0])
            crossed = alive & (after[2] >= 0)
            for ray in np.flatnonzero(crossed & (after[2] - rays.values[2] < _JUMP * scale)):
                found[int(ray)] = _zero(course, rays, after, int(ray))
            # Rays near the first one to cross may still cross before it.
            latest = min([float(history.tau[-1]), *(each[0] + _MARGIN for each in found.values())])
            alive &= ~crossed & (after[0] <= latest)
            rays = _moved(course, rays, np.where(alive, after, [[0.0], [0.0], [-1.0], [0.0]]))
    return _first(found, scale.size)


def _course(history: History, steps: int) -> _Course:
    loop, half_angle = history.loop, history.loop.base.hopper.half_angle
    x = np.linspace(-1, 1, 2 * steps + 1)
    x[steps] = _AXIS
    state = base_state(loop.base, half_angle * x)
    at = state.at
    shown = loop.mesh.interpolation(-x).T
    return _Course(
        history=history,
        y=half_angle * x,
        radial=np.stack(
            [state.psi, state.light, state.numerator / state.a, at.n1, at.l0, at.l1, at.d0, at.d1]
        ),
        partner=history.w[:, ::-1] @ shown,
        partner_rate=history.rate[:, ::-1] @ shown,
    )


def _start(course: _Course) -> _Rays:
    """Return rays that start at all whole steps of all legs at tau = 0, their labels y there."""
    loop, legs = course.history.loop, course.history.loop.legs
    station = np.tile(np.arange(0, course.y.size - 1, 2), legs)
    leg = np.repeat(np.arange(legs), station.size // legs)
    shown = loop.mesh.interpolation(course.y / loop.base.hopper.half_angle).T
    first = course.history.w[0]
    w, w_by_y = ((each @ shown)[leg, station] for each in (first, first @ loop.derivative))
    rays = _Rays(np.stack([0 * w, w, 0 * w, 0 * w]), leg, station)
    slopes = _slopes(course, rays.values, leg, station)
    # At y held, a ray that starts a little further on is there earlier.
    return _Rays(np.stack([0 * w, w, -slopes[0], w_by_y - slopes[1]]), leg, station)


def _slopes(
    course: _Course, values: Array, leg: NDArray[np.intp], station: NDArray[np.intp]
) -> Array:
    """Return the derivatives by y of (tau, w, Q, P) of rays at stations, shape (4, R)."""
    tau, w, q, p = values
    loop = course.history.loop
    factor = psi_factor(loop.base.hopper)
    psi, light, source, n1, l0, l1, d0, d1 = course.radial[:, station]
    v, v_rate = _partner(course, tau, leg, station)
    t = np.tan(psi + factor * (w - v))
    at = replace(loop.state.at, n1=n1, l0=l0, l1=l1, d0=d0, d1=d1)
    slope = ray_slopes(at, t, light * np.exp(-0.5 * (w + v)))
    # Derivatives of t and of log light by the label, V changing with tau.
    t_by_label = factor * (1 + t**2) * (p - v_rate * q)
    light_by_label = -0.5 * (p + v_rate * q)
    return np.stack(
        [
            slope.tau,
            slope.w - source,
            slope.tau_by_t * t_by_label,
            slope.w_by_t * t_by_label + slope.w_by_light * light_by_label,
        ]
    )


def _partner(
    course: _Course, tau: Array, leg: NDArray[np.intp], station: NDArray[np.intp]
) -> tuple[Array, Array]:
    """Return the deviation of V and its rate by cubic Hermite polynomials in tau, shape (R,)."""
    times = course.history.tau
    cell = np.clip(np.searchsorted(times, tau) - 1, 0, times.size - 2)
    length = times[cell + 1] - times[cell]
    z = (tau - times[cell]) / length
    low, high = (course.partner[cell + i, leg, station] for i in (0, 1))
    left, right = (length * course.partner_rate[cell + i, leg, station] for i in (0, 1))
    cubic = left + right - 2 * (high - low)
    square = high - low - left - cubic
    value = ((cubic * z + square) * z + left) * z + low
    return value, ((3 * cubic * z + 2 * square) * z + left) / length


def _advanced(course: _Course, rays: _Rays) -> Array:
    """Return (tau, w, Q, P) one step further, by the classical Runge-Kutta method."""
    leg, station, step = rays.leg, rays.station, course.step
    first = _slopes(course, rays.values, leg, station)
    second = _slopes(course, rays.values + step / 2 * first, leg, station + 1)
    third = _slopes(course, rays.values + step / 2 * second, leg, station + 1)
    fourth = _slopes(course, rays.values + step * third, leg, station + 2)
    after: Array = rays.values + step / 6 * (first + 2 * (second + third) + fourth)
    if course.history.loop.base.hopper.curvature:
        before_axis = station == course.y.size // 2 - 1
        after[:, before_axis] = _across_axis(course, rays, first, before_axis)
    return after


def _across_axis(course: _Course, rays: _Rays, first: Array, which: Mask) -> Array:
    """Return (tau, w, Q, P) behind the axis of a cone by the trapezoidal rule.

    It takes the pole's two sides alike. The pole's part of the slopes of w and P, which plain
    iteration makes converge slowly, is -1/2 of their deviation over y.
    """
    leg, station, step = rays.leg[which], rays.station[which] + 2, course.step
    start, slope = rays.values[:, which], first[:, which]
    after = start + step * slope
    after[[1, 3]] = start[[1, 3]]
    relaxation = np.array([[1.0], [1 / 1.5], [1.0], [1 / 1.5]])
    for _ in range(_ITERATIONS):
        change = start + step / 2 * (slope + _slopes(course, after, leg, station)) - after
        after = after + relaxation * change
        if not np.abs(change).max() > _CHANGE:
            break
    return after


def _moved(course: _Course, rays: _Rays, values: Array) -> _Rays:
    """Return the rays at the next step's station; what leaves a leg enters its partner."""
    station = rays.station + 2
    out = station == course.y.size - 1
    leg = np.where(out, course.history.loop.legs - 1 - rays.leg, rays.leg)
    return _Rays(values, leg, np.where(out, 0, station))


def _zero(course: _Course, rays: _Rays, after: Array, ray: int) -> Array:
    """Return (tau, theta, family) where Q of a ray vanishes in its next step."""
    one, leg = slice(ray, ray + 1), rays.leg[ray]
    place = rays.station[one]
    ends = np.stack([rays.values[[0, 2], ray], after[[0, 2], ray]])
    slopes = course.step * np.stack(
        [
            _slopes(course, rays.values[:, one], rays.leg[one], place)[[0, 2], 0],
            _slopes(course, after[:, one], rays.leg[one], place + 2)[[0, 2], 0],
        ]
    )
    rise = ends[1] - ends[0]
    cubic = slopes[0] + slopes[1] - 2 * rise
    powers = np.stack([cubic, rise - slopes[0] - cubic, slopes[0], ends[0]])
    root = guess = -ends[0, 1] / rise[1]
    for _ in range(_NEWTON_STEPS):
        root -= np.polyval(powers[:, 1], root) / np.polyval(np.polyder(powers[:, 1]), root)
    if not 0 <= root <= 1:
        root = guess
    y = float(course.y[rays.station[ray]]) + root * course.step
    legs = course.history.loop.legs
    family = -1.0 if (y < 0 if legs == 1 else leg == 1) else 1.0
    return np.array([np.polyval(powers[:, 0], root), family * y, family])


def _first(found: dict[int, Array], rays: int) -> Array | None:
    """Return the first crossing among those whose neighbours cross as well, if there are any."""
    joined = {
        ray: each
        for ray, each in found.items()
        if (ray - 1) % rays in found and (ray + 1) % rays in found
    }
    among = joined or found
    if not among:
        return None
    return lowest(found, min(among, key=lambda ray: among[ray][0]), rays)
