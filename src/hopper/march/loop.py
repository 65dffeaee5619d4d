"""The march on the unfolded loop: collocation in y, Runge-Kutta in tau.

Advanced is the deviation w = W - W0 from the radial field. It is continuous around the loop, also
where walls join its legs; there its slope jumps, so every leg has its own polynomial.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.base import Base, BaseState, base_state
from hopper.march.equations import psi_factor, terms
from hopper.march.mapped import Mesh, mesh

# Step times speed times the largest eigenvalue of the derivative. Runge-Kutta's limit is 2.8.
_COURANT = 2.0
# D or A relative to the radial field's from which on a tangency, with the lines of constant tau or
# of constant theta, counts as reached.
_TANGENT = 1e-3
# Size of a deviation that counts as infinitesimal.
_SMALL = 1e-6

# Steps between two reports.
_BETWEEN = 200

End = Literal["end", "tangency", "unresolved"]
# Told what is being marched, and its tau.
Report = Callable[[str, float], object]


@dataclass(frozen=True, eq=False)
class Loop:
    """A discrete loop of ``legs`` legs (1 or 2), each with the points of ``mesh``."""

    base: Base
    legs: int
    mesh: Mesh
    state: BaseState
    derivative: Array
    psi_factor: float

    __repr__ = brief("legs", "y deg")

    @property
    def y(self) -> Array:
        """Points of a leg, radians, shape (n,)."""
        return self.state.y


@dataclass(frozen=True, eq=False)
class History:
    """Deviations w and rates w_tau, shapes (m, legs, n), at times ``tau`` (m,), and their end.

    The march ended at the wanted time, at a tangency (``tangency``: tau, theta), or where values
    ceased to be numbers.
    """

    loop: Loop
    tau: Array
    w: Array
    rate: Array
    end: End
    tangency: tuple[float, float] | None

    __repr__ = brief("tau", "end")


def make_loop(base: Base, n: int, legs: int) -> Loop:
    """Return the loop with ``n`` points on each leg, n even."""
    points = mesh(n)
    half_angle = base.hopper.half_angle
    return Loop(
        base=base,
        legs=legs,
        mesh=points,
        state=base_state(base, half_angle * points.x),
        derivative=np.ascontiguousarray(points.derivative.T / half_angle),
        psi_factor=psi_factor(base.hopper),
    )


def rate(loop: Loop, w: Array) -> tuple[Array, Array, Array]:
    """Return w_tau, exactly 0 for w = 0, A and D, each of shape (legs, n)."""
    change, a, d = _free_rate(loop, w)
    # What leaves a leg enters its partner.
    change[:, 0] = change[::-1, -1]
    return change, a, d


def corner_defect(loop: Loop, w: Array) -> float:
    """Return by how much w_tau differs on both sides of the walls, over the largest w_tau.

    Unless it vanishes a kink of the stress leaves the corner of top and wall.
    """
    change, _, _ = _free_rate(loop, w)
    largest = float(np.abs(change).max())
    return float(np.abs(change[:, 0] - change[::-1, -1]).max()) / largest if largest else 0.0


def _free_rate(loop: Loop, w: Array) -> tuple[Array, Array, Array]:
    state = loop.state
    v = w[::-1, ::-1]
    t = np.tan(state.psi + loop.psi_factor * (w - v))
    light = state.light * np.exp(-0.5 * (w + v))
    numerator, a, d = terms(state.at, t, light)
    change = (numerator - (a / state.a) * state.numerator - a * (w @ loop.derivative)) / d
    return change, a, d


def jacobian(loop: Loop) -> Array:
    """Return d w_tau / dw at w = 0, shape (m, m), m = legs (n - 1), by central differences.

    The first value of each leg is left out: it is the last one of its partner.
    """
    shape = loop.legs, loop.y.size
    columns = []
    for unit in np.eye(loop.legs * loop.y.size):
        w = _SMALL * unit.reshape(shape)
        columns.append((rate(loop, w)[0] - rate(loop, -w)[0]) / (2 * _SMALL))
    by_w = np.array(columns).reshape(*shape, *shape)
    by_w[::-1, -1] += by_w[:, 0]
    size = shape[0] * (shape[1] - 1)
    return by_w[:, 1:, :, 1:].reshape(size, size).T


def step(loop: Loop, w: Array, first: Array, length: float) -> Array:
    """Return w one step of the classical Runge-Kutta method later; ``first`` is its rate now."""
    second = rate(loop, w + (length / 2) * first)[0]
    third = rate(loop, w + (length / 2) * second)[0]
    fourth = rate(loop, w + length * third)[0]
    return w + (length / 6) * (first + 2 * (second + third) + fourth)


def march_loop(loop: Loop, w: Array, tau_end: float, tell: Report | None = None) -> History:
    """March deviations ``w``, shape (legs, n), from tau = 0 to ``tau_end``, or as far as it goes.

    The ends of legs are joined first: the outflow's value counts.
    """
    w = w.copy()
    w[:, 0] = w[::-1, -1]
    tau, previous = 0.0, (0.0, 1.0)
    times, states, rates = [], [], []
    reach = _COURANT * loop.base.hopper.half_angle / loop.mesh.radius
    end: End = "end"
    tangency = None
    with np.errstate(all="ignore"):
        while True:
            change, a, d = rate(loop, w)
            closeness = np.minimum(d / loop.state.d, a / loop.state.a)
            margin = float(closeness.min())
            if not np.isfinite(change).all():
                end = "unresolved"
                break
            if margin < _TANGENT:
                slope = (previous[1] - margin) / (tau - previous[0])
                leg, place = np.unravel_index(int(closeness.argmin()), closeness.shape)
                theta = float(loop.y[place]) * (-1 if leg else 1)
                end, tangency = "tangency", (tau + margin / slope, theta)
                break
            times.append(tau)
            states.append(w)
            rates.append(change)
            if tau >= tau_end:
                break
            if tell and len(times) % _BETWEEN == 0:
                tell(f"loop of {loop.y.size} points", tau)
            previous = tau, margin
            length = min(reach / float((a / d).max()), tau_end - tau)
            w = step(loop, w, change, length)
            tau = tau_end if length == tau_end - tau else tau + length
    return History(loop, np.array(times), np.array(states), np.array(rates), end, tangency)
