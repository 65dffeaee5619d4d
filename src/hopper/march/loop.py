"""The equations on the unfolded loop: collocation in y, rates in tau.

Advanced is the deviation w = W - W0 from the radial field. It is continuous around the loop, also
where walls join its legs; there its slope jumps, so every leg has its own polynomial.
"""

from dataclasses import dataclass

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.base import Base, BaseState, base_state
from hopper.march.equations import psi_factor
from hopper.march.mapped import Mesh, mesh


@dataclass(frozen=True, eq=False)
class Loop:
    """A discrete loop of ``legs`` legs (1 or 2), each with the points of ``mesh``.

    ``derivative`` leads from values on a leg, from the left, to their slopes by y. The other arrays
    are those of :func:`rate`: ``operator`` leads from all w to the deviations of psi and
    log(1 / sigma) and to w_y; N = n + l / sigma, A and D are linear in tan(psi), ``constant`` and
    ``by_t`` have the coefficients of n, l, A, D; ``radial`` is [A, D] of the radial field,
    ``balance`` its N / A and what rounding leaves of its rate.
    """

    base: Base
    legs: int
    mesh: Mesh
    state: BaseState
    derivative: Array
    operator: Array
    constant: Array
    by_t: Array
    radial: Array
    balance: tuple[Array, Array]

    __repr__ = brief("legs", "y deg")

    @property
    def y(self) -> Array:
        """Points of a leg, radians, shape (n,)."""
        return self.state.y


def make_loop(base: Base, n: int, legs: int) -> Loop:
    """Return the loop with ``n`` points on each leg, n even."""
    points = mesh(n)
    half_angle = base.hopper.half_angle
    state = base_state(base, half_angle * points.x)
    derivative = np.ascontiguousarray(points.derivative.T / half_angle)
    itself = np.eye(legs * n)
    partner = itself[::-1]
    operator = np.hstack(
        [
            psi_factor(base.hopper) * (itself - partner),
            -0.5 * (itself + partner),
            np.kron(np.eye(legs), derivative),
        ]
    )
    at = state.at
    rows = [
        (at.n0, at.n1), (at.l0, at.l1), (at.cos_eta, -at.sin_eta), (at.d0, at.d1)
    ]  # fmt: skip
    constant, by_t = (np.stack([np.full((legs, n), row[i]) for row in rows]) for i in (0, 1))
    none = np.zeros((legs, n))
    numerator, radial = _terms(constant, by_t, state, none, none)
    source = numerator / radial[0]
    balance = source, numerator - radial[0] * source
    return Loop(
        base, legs, points, state, derivative, operator, constant, by_t, radial, balance
    )  # fmt: skip


def rate(loop: Loop, w: Array) -> tuple[Array, Array]:
    """Return w_tau, shape (legs, n), exactly 0 for w = 0, and [A, D], shape (2, legs, n)."""
    change, speed = _free_rate(loop, w)
    # What leaves a leg enters its partner.
    change[:, 0] = change[::-1, -1]
    return change, speed


def corner_defect(loop: Loop, w: Array) -> float:
    """Return by how much w_tau differs on both sides of the walls, over the largest w_tau.

    Unless it vanishes a kink of the stress leaves the corner of top and wall.
    """
    change, _ = _free_rate(loop, w)
    largest = float(np.abs(change).max())
    return float(np.abs(change[:, 0] - change[::-1, -1]).max()) / largest if largest else 0.0


def _free_rate(loop: Loop, w: Array) -> tuple[Array, Array]:
    odd, even, slope = (w.ravel() @ loop.operator).reshape(3, *w.shape)
    numerator, speed = _terms(loop.constant, loop.by_t, loop.state, odd, even)
    source, rounding = loop.balance
    return (numerator - speed[0] * (source + slope) - rounding) / speed[1], speed


def _terms(
    constant: Array, by_t: Array, state: BaseState, odd: Array, even: Array
) -> tuple[Array, Array]:
    """Return N and [A, D] where psi and log(1 / sigma) are ``odd`` and ``even`` off the state's."""
    terms = constant + by_t * np.tan(state.psi + odd)
    return terms[0] + state.light * np.exp(even) * terms[1], terms[2:]


def linearization(loop: Loop) -> Array:
    """Return d w_tau / dw at w = 0, shape (m, m), m = legs n, legs one after the other."""
    t, light = np.tan(loop.state.psi), loop.state.light
    source, (a, d) = loop.balance[0], loop.radial
    by_odd = (1 + t**2) * (loop.by_t[0] + light * loop.by_t[1] - source * loop.by_t[2])
    by_even = light * (loop.constant[1] + loop.by_t[1] * t)
    factors = np.stack([by_odd, by_even, -a]) / d
    parts = loop.operator.T.reshape(3, a.size, a.size)
    matrix: Array = (factors.reshape(3, -1, 1) * parts).sum(axis=0)
    rows = matrix.reshape(*a.shape, -1)
    rows[:, 0] = rows[::-1, -1]
    return matrix


def jacobian(loop: Loop) -> Array:
    """Return the same for joined legs, shape (m, m), m = legs (n - 1).

    The first value of each leg is left out: it is the last one of its partner.
    """
    shape = loop.legs, loop.y.size
    by_w = linearization(loop).T.reshape(*shape, *shape)
    by_w[::-1, -1] += by_w[:, 0]
    size = shape[0] * (shape[1] - 1)
    return by_w[:, 1:, :, 1:].reshape(size, size).T


def step(loop: Loop, w: Array, first: Array, length: float) -> Array:
    """Return w one step of the classical Runge-Kutta method later; ``first`` is its rate now."""
    second = rate(loop, w + (length / 2) * first)[0]
    third = rate(loop, w + (length / 2) * second)[0]
    fourth = rate(loop, w + length * third)[0]
    return w + (length / 6) * (first + 2 * (second + third) + fourth)
