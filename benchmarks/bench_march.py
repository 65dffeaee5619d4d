"""One unit of tau at an error of 1e-6, and crossings to 1e-5.

The march on the loop against two others on the same equations for the deviation from the radial
field, both by solve_ivp at the tolerance that just reaches the error: upwind differences of third
order with one-sided stencils at the walls, on their best mesh, extrapolated by their order, and
Chebyshev collocation. Times are processor times, the least of a few runs.
"""

from collections.abc import Callable
from math import atan, radians
from statistics import median
from time import process_time

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from hopper import Hopper, solve_radial
from hopper.march.base import Base, base_of, base_state
from hopper.march.equations import psi_factor, terms
from hopper.march.fields import deviations
from hopper.march.history import march_loop
from hopper.march.loop import make_loop
from hopper.march.outcome import first_crossing
from hopper.march.tops import bump_of_sigma, riemann_deviation
from hopper.problem import Geometry
from hopper.spectral import chebyshev

Array = NDArray[np.float64]
EPS, TAU, ERROR = 0.05, 1.0, 1e-6
X = np.linspace(0, 1, 21)
UPWIND = (42, 62, 82, 122, 162, 242, 322, 402)
# geometry, delta, half angle (deg), mu, eps: cases with published crossings.
CROSSINGS: tuple[tuple[Geometry, float, float, float, float], ...] = (
    ("wedge", 35, 10, 0, 0.1),
    ("wedge", 38, 17, 0.12, 0.1),
    ("wedge", 45, 10, 0, 0.1),
    ("wedge", 45, 15, 0.2, 0.2),
    ("cone", 30, 10, 0, 0.2),
    ("cone", 38, 17, 0.12, 0.3),
    ("cone", 40, 20, 0.2, 0.4),
)


def base(geometry: Geometry, delta: float, half_angle: float, mu: float) -> Base:
    return base_of(solve_radial(Hopper(geometry, radians(delta), radians(half_angle)), atan(mu)))


def seconds(task: Callable[[], object], repeats: int = 3) -> float:
    times = []
    for _ in range(repeats):
        start = process_time()
        task()
        times.append(process_time() - start)
    return min(times)


def on_loop(under: Base, points: int) -> Array:
    loop = make_loop(under, points, 1)
    history = march_loop(loop, riemann_deviation(under, bump_of_sigma(EPS), loop.mesh.x)[:1], TAU)
    return np.stack(deviations(loop, history.w[-1], X))


def by_lines(under: Base, x: Array, derivative: Callable[[Array], Array], rtol: float) -> Array:
    """March w at points x by solve_ivp; what flows out of the wall flows in at the other."""
    state = base_state(under, under.hopper.half_angle * x)
    factor = psi_factor(under.hopper)

    def rate(_: float, w: Array) -> Array:
        w = w.copy()
        w[0] = w[-1]
        v = w[::-1]
        t = np.tan(state.psi + factor * (w - v))
        light = state.light * np.exp(-0.5 * (w + v))
        numerator, a, d = terms(state.at, t, light)
        change: Array = (numerator - (a / state.a) * state.numerator - a * derivative(w)) / d
        change[0] = change[-1]
        return change

    start = riemann_deviation(under, bump_of_sigma(EPS), x)[0]
    done = solve_ivp(rate, (0, TAU), start, method="RK45", rtol=rtol, atol=rtol * EPS)
    end: Array = done.y[:, -1]
    return end


def upwind(under: Base, points: int) -> Array:
    x = np.linspace(-1, 1, points)
    h = under.hopper.half_angle * (x[1] - x[0])

    def derivative(w: Array) -> Array:
        slope = np.empty_like(w)
        slope[2:-1] = (2 * w[3:] + 3 * w[2:-1] - 6 * w[1:-2] + w[:-3]) / (6 * h)
        slope[0] = (-11 * w[0] + 18 * w[1] - 9 * w[2] + 2 * w[3]) / (6 * h)
        slope[1] = (-2 * w[0] - 3 * w[1] + 6 * w[2] - w[3]) / (6 * h)
        slope[-1] = (11 * w[-1] - 18 * w[-2] + 9 * w[-3] - 2 * w[-4]) / (6 * h)
        return slope

    w = by_lines(under, x, derivative, 1e-7)
    # Nodes that all meshes of 40 k + 2 points nearly have: interpolated between neighbours.
    plus, minus = (np.array([_cubic(x, w, place) for place in sign * X]) for sign in (1, -1))
    return np.stack([0.5 * (plus + minus), psi_factor(under.hopper) * (plus - minus)])


def _cubic(x: Array, w: Array, place: float) -> float:
    first = int(np.clip(np.searchsorted(x, place) - 3, 0, x.size - 6))
    near = slice(first, first + 6)
    return float(np.polyval(np.polyfit(x[near] - place, w[near], 5), 0.0))


def collocation(under: Base, points: int) -> Array:
    x = chebyshev.nodes(points)
    matrix = chebyshev.differentiation_matrix(points) / under.hopper.half_angle
    w = by_lines(under, x, lambda values: matrix @ values, 1e-7)
    plus, minus = (chebyshev.interpolation_matrix(points, sign * X) @ w for sign in (1, -1))
    return np.stack([0.5 * (plus + minus), psi_factor(under.hopper) * (plus - minus)])


def first_good(method: Callable[[int], Array], sizes: tuple[int, ...], exact: Array) -> int | None:
    for size in sizes:
        if np.abs(method(size) - exact).max() <= ERROR:
            return size
    return None


def compare(geometry: Geometry, delta: float, half_angle: float, mu: float) -> None:
    """Print times of the three methods in one hopper."""
    under = base(geometry, delta, half_angle, mu)
    exact = on_loop(under, 160)
    own = first_good(lambda n: on_loop(under, n), (16, 20, 24, 32, 40, 48, 64, 80, 96, 128), exact)
    assert own is not None
    ours = seconds(lambda: on_loop(under, own))
    hopper = f"{geometry} {delta:g}/{half_angle:g}/{mu:g}"
    print(f"{hopper}: loop of {own} points: {ours:.2f} s per unit of tau")
    size = first_good(lambda n: collocation(under, n), (16, 20, 24, 32, 48, 64, 80, 96, 128), exact)
    if size is not None:
        other = seconds(lambda: collocation(under, size))
        print(f"  Chebyshev collocation, {size} points: {other:.2f} s, {other / ours:.1f} x")
    points = first_good(lambda n: upwind(under, n), UPWIND, exact)
    finest = points or UPWIND[-1]
    time = seconds(lambda: upwind(under, finest))
    more = 1.0
    if points is None:
        more = float((np.abs(upwind(under, finest) - exact).max() / ERROR) ** (1 / 3))
    other = time * more**2
    print(f"  upwind differences, {finest * more:.0f} points: {other:.2f} s, {other / ours:.0f} x")


def main() -> None:
    """Print times and ratios."""
    compare("wedge", 50, 15, 0.1)
    compare("wedge", 45, 15, 0.2)
    compare("cone", 50, 15, 0.1)
    compare("cone", 38, 17, 0.12)
    times = []
    for *hopper, eps in CROSSINGS:
        under = base(*hopper)  # type: ignore[arg-type]
        start = process_time()
        found = first_crossing(under, bump_of_sigma(eps), 2.0)
        times.append(process_time() - start)
        assert found.crossing is not None
        told = f"{found.crossing.tau:.6f} +- {found.crossing.error:.0e}"
        print(f"{hopper}, eps {eps:g}: tau_b {told} in {times[-1]:.1f} s")
    print(f"median {median(times):.1f} s (at most 10)")


if __name__ == "__main__":
    main()
