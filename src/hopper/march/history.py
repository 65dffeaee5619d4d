"""The march on the loop: exact in what is linear, multistep in the rest.

With w_tau = L w + N(w), L the linearisation about the radial field, a step is the integral of
exp((tau + h - t) L) N(t), N extrapolated from the last steps [HO]_. Waves are in L: N is small, and
each step needs one rate.

References
----------
.. [HO] M. Hochbruck, A. Ostermann, Exponential integrators, Acta Numerica 19 (2010).
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil, factorial, log2
from typing import Literal

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.loop import Loop, linearization, rate, step

# Largest step times speed times the largest eigenvalue of the derivative: of multistep steps, which
# start by Runge-Kutta's with its limit of 2.8, and of Runge-Kutta's alone.
_COURANT, _EXPLICIT = 1.5, 2.0
# The same for the change of speed by the deviation, whose limit is .43, and the part of it that a
# new step is to have.
_STABLE, _ROOM = 0.15, 0.7
# Steps of one kind or length at least, and the part of a step that rounding of tau may leave.
_STEADY, _LAST = 16, 1e-6
# Steps that N is extrapolated from, terms of the series of phi, and norms for which they do.
_ORDER, _TERMS, _SMALL = 4, 12, 0.5
# D or A relative to the radial field's from which on a tangency, with the lines of constant tau or
# of constant theta, counts as reached.
_TANGENT = 1e-3
# Steps between two reports.
_BETWEEN = 200

End = Literal["end", "tangency", "unresolved"]
# Told what is being marched, and its tau.
Report = Callable[[str, float], object]


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


class _Stepper:
    """Steps in tau: multistep as long as the deviation changes speeds little, else Runge-Kutta."""

    def __init__(self, loop: Loop, tau_end: float) -> None:
        self.loop, self.linear, self.tau_end = loop, linearization(loop), tau_end
        self.wave = loop.mesh.radius / loop.base.hopper.half_angle
        self.speed = loop.radial[0] / loop.radial[1]
        self.length, self.steady = 0.0, _STEADY
        self.weights: Array | None = None
        # N of the last steps.
        self.past: list[Array] = []

    def advance(self, tau: float, w: Array, change: Array, speed: Array) -> tuple[float, Array]:
        """Return tau and w one step later; ``change`` is the rate of w, ``speed`` A / D."""
        self._fit(self.tau_end - tau, speed)
        self.steady += 1
        left = self.tau_end - tau - self.length
        after = self.tau_end - left if left > _LAST * self.length else self.tau_end
        if self.weights is None:
            return after, step(self.loop, w, change, self.length)
        self.past = [change.ravel() - self.linear @ w.ravel(), *self.past[: _ORDER - 1]]
        if len(self.past) < _ORDER:
            return after, step(self.loop, w, change, self.length)
        w = (np.concatenate([w.ravel(), *self.past]) @ self.weights).reshape(w.shape)
        w[:, 0] = w[::-1, -1]
        return after, w

    def _fit(self, left: float, speed: Array) -> None:
        """Choose the kind and the length of the step."""
        change = self.wave * float(np.abs(speed - self.speed).max())
        wanted = min(
            _COURANT / (self.wave * float(self.speed.max())),
            _ROOM * _STABLE / change if change else np.inf,
        )
        steady = self.steady >= _STEADY
        if self.weights is None:
            multistep = steady
        elif self.length * change <= _STABLE and not (steady and wanted > 2 * self.length):
            return
        else:
            multistep, self.steady = True, 0
        explicit = _EXPLICIT / (self.wave * float(speed.max()))
        # A step of Runge-Kutta takes four rates.
        if multistep and 4 * wanted > explicit:
            self.length = left / ceil(left / wanted)
            self.weights, self.past, self.steady = _weights(self.linear.T, self.length), [], 0
        else:
            self.length, self.weights = min(explicit, left), None


def _weights(linear: Array, length: float) -> Array:
    """Return the matrix from w and N of the last steps, end to end, to w after the next step.

    ``linear`` is transposed, and so is the matrix: shape (5 m, m). N is a polynomial of tau, and
    phi_k the integrals of exp((1 - x) z) x^(k-1) / (k-1)! over x from 0 to 1.
    """
    first, second, third, fourth, fifth = _phi(length * linear)
    steps = (second, third, fourth + third / 2, fifth + fourth + third / 3)
    # From backward differences of N to its values.
    differences = [[1, 1, 1, 1], [0, -1, -2, -3], [0, 0, 1, 3], [0, 0, 0, -1]]
    weights = np.tensordot(length * np.array(differences, dtype=float), np.stack(steps), axes=1)
    return np.concatenate([first, *weights])


def _phi(z: Array) -> list[Array]:
    """Return phi_0 = exp, phi_1, ..., phi_4 of a matrix by series, scaling and doubling [HO]_."""
    doublings = ceil(log2(max(1.0, float(np.abs(z).sum(axis=0).max()) / _SMALL)))
    z, one = z / 2**doublings, np.eye(z.shape[0])
    last = one / factorial(_TERMS + _ORDER)
    for k in range(_TERMS + _ORDER - 1, _ORDER - 1, -1):
        last = z @ last + one / factorial(k)
    phi = [last]
    for k in range(_ORDER - 1, -1, -1):
        phi.insert(0, z @ phi[0] + one / factorial(k))
    for _ in range(doublings):
        phi = [
            (phi[0] @ phi[k] + sum(phi[j] / factorial(k - j) for j in range(1, k + 1))) / 2**k
            for k in range(_ORDER + 1)
        ]
    return phi


def march_loop(loop: Loop, w: Array, tau_end: float, tell: Report | None = None) -> History:
    """March deviations ``w``, shape (legs, n), from tau = 0 to ``tau_end``, or as far as it goes.

    The ends of legs are joined first: the outflow's value counts.
    """
    w = w.copy()
    w[:, 0] = w[::-1, -1]
    stepper = _Stepper(loop, tau_end)
    tau, previous = 0.0, (0.0, 1.0)
    times, states, rates = [], [], []
    end: End = "end"
    tangency = None
    with np.errstate(all="ignore"):
        while True:
            change, speed = rate(loop, w)
            closeness = speed / loop.radial
            margin = float(closeness.min())
            if not np.isfinite(change.sum()):
                end = "unresolved"
                break
            if margin < _TANGENT:
                slope = (previous[1] - margin) / (tau - previous[0])
                _, leg, place = np.unravel_index(int(closeness.argmin()), closeness.shape)
                theta = float(loop.y[place]) * (-1 if leg else 1)
                end, tangency = "tangency", (tau + margin / slope, theta)
                break
            times.append(tau)
            states.append(w)
            rates.append(change)
            if tau == tau_end:
                break
            if tell and len(times) % _BETWEEN == 0:
                tell(f"loop of {loop.y.size} points", tau)
            previous = tau, margin
            tau, w = stepper.advance(tau, w, change, speed[0] / speed[1])
    return History(loop, np.array(times), np.array(states), np.array(rates), end, tangency)
