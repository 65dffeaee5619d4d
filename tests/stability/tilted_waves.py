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


def _travel(member):
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


def _transport(elements, size, degree):
    """Return the upwind matrix of r_T = -r_tau, l_T = l_tau between reflecting walls.

    r = a + b runs to larger tau, l = a - b to smaller; each has elements of Gauss points.
    """
    x, weight = legendre.leggauss(degree + 1)
    to_coefficients = np.linalg.inv(legendre.legvander(x, degree))
    slope = legendre.legval(x, legendre.legder(np.eye(degree + 1))).T @ to_coefficients
    ends = legendre.legvander(np.array([-1.0, 1.0]), degree) @ to_coefficients
    n = degree + 1
    matrix = np.zeros((2, elements, n, 2, elements, n))
    for e in range(elements):
        for wave, step in ((0, -1), (1, 1)):
            # A wave enters through this end, from the far end of the element before it; at the
            # wall, where psi1 = 0, the other wave turns into it.
            entry, far = ends[wave], ends[1 - wave]
            lift = (entry / weight)[:, None]
            matrix[wave, e, :, wave, e] += step * slope - lift * entry
            if 0 <= e + step < elements:
                matrix[wave, e, :, wave, e + step] += lift * far
            else:
                matrix[wave, e, :, 1 - wave, e] += lift * entry
    return matrix.reshape(2 * elements * n, -1) * 2 / size


def wave_operator(solution, elements=24, degree=4):
    """Return L of d(r, l)/dT = L (r, l) as a sparse array, and a stable step of T."""
    member = base(solution)
    assert member.hopper.geometry == "wedge", "both parities exist in wedges only"
    tau_w, sol = _travel(member)
    size = 2 * tau_w / elements
    middles = -tau_w + size * (np.arange(elements) + 0.5)
    tau = (middles[:, None] + size / 2 * legendre.leggauss(degree + 1)[0]).ravel()
    (aa, ab), (ba, bb) = np.moveaxis(_sources(member, sol, tau), 0, -1)
    mix = np.block([
        [np.diag(aa + ba + ab + bb), np.diag(aa + ba - ab - bb)],
        [np.diag(aa - ba + ab - bb), np.diag(aa - ba - ab + bb)],
    ]) / 2  # fmt: skip
    # Courant number 1 / (2 degree + 1) is the usual bound of Runge-Kutta methods; half of it.
    return csr_array(_transport(elements, size, degree) + mix), size / (2 * degree + 1) / 2


def growth_rate(solution, settle, until, elements=12, degree=4, seed=0):
    """Return the mean rate of log of the norm over T in [settle, until] and an error, random data.

    The norm of a pair of modes beats; the fit weighs the window by sine squared, which averages
    that out. The error is the spread between fits of the whole window and of two thirds of it.
    """
    operator, step = wave_operator(solution, elements, degree)
    y = np.random.default_rng(seed).standard_normal(operator.shape[0])
    times = step * np.arange(1, round(until / step))
    logs, scale = [], 0.0
    for _ in times:
        k1 = operator @ y
        k2 = operator @ (y + step / 2 * k1)
        k3 = operator @ (y + step / 2 * k2)
        k4 = operator @ (y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        norm = np.linalg.norm(y)
        y, scale = y / norm, scale + np.log(norm)
        logs.append(scale)

    def fit(start, end):
        inside = (times > start) & (times < end)
        weight = np.sin(np.pi * (times[inside] - start) / (end - start))
        return np.polyfit(times[inside], np.array(logs)[inside], 1, w=weight)[0]

    third = (until - settle) / 3
    fits = [fit(settle, until), fit(settle + third, until), fit(settle, until - third)]
    return fits[0], max(fits) - min(fits)
