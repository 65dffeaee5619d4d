"""A time-stepper of the tilted wave system in wedges, for data of both parities at once.

Upwind discontinuous Galerkin in the travel time tau (d tau = d theta / c, both speeds 1), in the
Riemann variables a + b and a - b, where a = sigma1 / rho, rho = 2 s sigma / cos(delta), b = psi1;
fourth-order Runge-Kutta steps down the hopper, T = -t'. Upwinding damps what the mesh does not
resolve, so no sawtooth outlives the modes. The radial solution is integrated along.
"""

from math import cos

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp
from scipy.sparse import csr_array

from tests.stability.tilted_equations import compiled
from tests.stability.tilted_witnesses import base


def _travel(member, count):
    """Return the travel time to the wall and (theta, sigma, psi) at any tau in [0, tau_w]."""
    hopper = member.hopper
    f = compiled(hopper.curvature)

    def slopes(_, y):
        speed = (hopper.s + np.cos(2 * y[2])) / cos(hopper.delta)
        return speed * np.array([1, *f(hopper.s, *y)[:2]])

    def at_wall(_, y):
        return y[0] - hopper.half_angle

    at_wall.terminal = True  # type: ignore[attr-defined]
    done = solve_ivp(
        slopes, (0, 100), [0, member.sigma_axis, 0], "DOP853",
        events=at_wall, dense_output=True, rtol=1e-12, atol=1e-14,
    )  # fmt: skip
    return done.t[-1], done.sol


def _sources(member, sol, tau):
    """Return the 2 x 2 matrices, shape (n, 2, 2), of the terms without slopes in (a, b)_T.

    a_T = -b_tau - c (K u)_2 and b_T = -a_tau - (c sigma' / sigma) a - (c / rho) (K u)_1,
    with u = (rho a, b).
    """
    hopper = member.hopper
    f, s = compiled(hopper.curvature), hopper.s
    matrices = []
    for side, (theta, sigma, psi) in zip(np.sign(tau), sol(np.abs(tau)).T, strict=True):
        d_sigma, _, *_, k11, k12, k21, k22 = f(s, side * theta, sigma, side * psi)
        c, rho = (s + cos(2 * psi)) / cos(hopper.delta), 2 * s * sigma / cos(hopper.delta)
        matrices.append([
            [-c * k21 * rho, -c * k22], [-c * (d_sigma / sigma + k11), -c * k12 / rho]
        ])  # fmt: skip
    return np.array(matrices)


def wave_operator(solution, elements=24, degree=4):
    """Return L of d(r, l)/dT = L (r, l), r = a + b and l = a - b at Gauss points, and the step.

    Each of r, l is ordered by elements from -tau_w to tau_w.
    """
    member = base(solution)
    assert member.hopper.geometry == "wedge", "both parities exist in wedges only"
    tau_w, sol = _travel(member, elements)
    x, weight = legendre.leggauss(degree + 1)
    size = 2 * tau_w / elements
    left = -tau_w + size * np.arange(elements)
    tau = (left[:, None] + size * (x + 1) / 2).ravel()
    # Lagrange polynomials of the Gauss points: slopes at them, values at both ends.
    to_coefficients = np.linalg.inv(legendre.legvander(x, degree))
    slope = legendre.legval(x, legendre.legder(np.eye(degree + 1))).T @ to_coefficients
    low, high = (legendre.legvander(np.array([end]), degree)[0] @ to_coefficients for end in (-1.0, 1.0))
    n = degree + 1
    total = elements * n
    transport = np.zeros((2 * total, 2 * total))
    for e in range(elements):
        here = slice(e * n, (e + 1) * n)
        for wave in (0, 1):
            # r enters at the low end from the element before, l at the high end from that after.
            own, far, step = ((low, high, -1), (high, low, 1))[wave]
            block = slice(wave * total + here.start, wave * total + here.stop)
            transport[block, block] += (-1) ** (wave + 1) * slope * 2 / size
            lift = (own / weight)[:, None] * 2 / size
            transport[block, block] -= lift * own
            neighbour, other = e + step, wave
            if not 0 <= neighbour < elements:
                # psi1 = 0 at the wall: one wave becomes the other, read at the same end.
                neighbour, other, far = e, 1 - wave, own
            source = slice(other * total + neighbour * n, other * total + (neighbour + 1) * n)
            transport[block, source] += lift * far
    (aa, ab), (ba, bb) = np.moveaxis(_sources(member, sol, tau), 0, -1)
    mix = np.block([
        [np.diag(aa + ba + ab + bb), np.diag(aa + ba - ab - bb)],
        [np.diag(aa - ba + ab - bb), np.diag(aa - ba - ab + bb)],
    ]) / 2  # fmt: skip
    return csr_array(transport + mix), size / (2 * degree + 1) / 2


def growth_rate(solution, settle, until, elements=24, degree=4, seed=0):
    """Return the mean rate of log of the norm over T in [settle, until], from random data."""
    operator, step = wave_operator(solution, elements, degree)
    y = np.random.default_rng(seed).standard_normal(operator.shape[0])
    times, sizes, scale = [], [], 0.0
    for number in range(round(until / step)):
        k1 = operator @ y
        k2 = operator @ (y + step / 2 * k1)
        k3 = operator @ (y + step / 2 * k2)
        k4 = operator @ (y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        norm = float(np.linalg.norm(y))
        y, scale = y / norm, scale + np.log(norm)
        if number * step > settle:
            times.append(number * step)
            sizes.append(scale)
    return np.polyfit(times, sizes, 1)[0]
