"""Hoppers, published values and second ways shared by the tests of the march."""

import json
from functools import lru_cache
from math import atan, radians
from pathlib import Path

import numpy as np

from hopper.march.base import Base, base_of
from hopper.march.history import History, march_loop
from hopper.march.loop import make_loop
from hopper.march.tops import Top, bump_of_psi, bump_of_sigma, riemann_deviation
from hopper.problem import Geometry, Hopper
from hopper.radial.grid import half_grid
from hopper.radial.solution import solve_radial
from hopper.spectral import chebyshev
from hopper.stability.collocation import Parity, mode_grid, tilted_matrix
from hopper.stability.tilted import tilt

# First crossings, fields and thresholds of a prototype of the march (discontinuous Galerkin and
# net, each checked against the other); `error` is what they differ by.
REFERENCE = json.loads((Path(__file__).parents[1] / "data/march_breakdown.json").read_text())
BEYOND = ("cone", 35, 10, 0.48)


@lru_cache(maxsize=64)
def base(geometry: Geometry, delta: float, half_angle: float, mu: float) -> Base:
    """Return the base of a hopper given in degrees."""
    return base_of(solve_radial(Hopper(geometry, radians(delta), radians(half_angle)), atan(mu)))


def base_of_case(case) -> Base:
    return base(case["geometry"], case["delta_deg"], case["half_angle_deg"], case["mu"])


def top_of_case(case) -> Top:
    return {"S": bump_of_sigma, "A": bump_of_psi}[case["data"]](case["eps"])


def name_of_case(case) -> str:
    return "-".join(str(case[key]) for key in ("geometry", "delta_deg", "data", "eps"))


def on_loop(under: Base, top: Top, points: int, tau_end: float) -> History:
    """March a top on the loop."""
    loop = make_loop(under, points, 1 if top.symmetric else 2)
    w = riemann_deviation(under, top, loop.mesh.x)
    return march_loop(loop, np.stack([w[0], w[1, ::-1]])[: loop.legs], tau_end)


def linear_mode(solution, eigenvalue: complex, parity: Parity = "symmetric"):
    """Return the mode nearest to an eigenvalue, as a function of base, x and tau.

    The function returns the deviations of log sigma and psi of a mode whose largest sigma1 is 1 at
    tau = 0. Collocation finds the mode in tilted time.
    """
    m, centred = 40, parity == "asymmetric"
    grid = mode_grid(solution, m, parity)
    values, vectors = np.linalg.eig(tilted_matrix(solution, m, parity))
    which = int(np.argmin(np.abs(values - eigenvalue)))
    inner = np.split(vectors[:, which], [m - centred])
    parts = np.append(np.zeros(int(centred)), inner[0]), np.append(inner[1], 0)
    parities: tuple[chebyshev.Parity, ...] = ("odd", "even") if centred else ("even", "odd")
    _, height = tilt(solution, m)

    def at(under: Base, x, tau: float = 0.0):
        theta = under.hopper.half_angle * x
        h = half_grid(m, under.hopper.half_angle).interpolation(theta, "even") @ height
        size = np.exp(values[which] * (tau - h)) / np.abs(parts[0]).max()
        sigma1, psi1 = (
            size * (grid.interpolation(theta, parity) @ part)
            for parity, part in zip(parities, parts, strict=True)
        )
        sigma, _, _, _ = under.solution.fields(np.abs(theta))
        return (sigma1 / sigma).real, psi1.real

    return at


def mode_as_top(mode, size: float, symmetric: bool) -> Top:
    """Return ``size`` times a :func:`linear_mode` as a top."""

    def deviation(under: Base, x):
        even, odd = mode(under, x)
        return size * even, size * odd

    return Top("mode", symmetric, deviation)
