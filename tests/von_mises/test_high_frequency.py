"""The law of high frequency, and the strips, lines and rays it puts the modes on."""

from math import pi, radians, sin, sqrt

import numpy as np
import pytest

from hopper.errors import ConvergenceError
from hopper.radial.grid import half_grid
from hopper.von_mises.collocation import mode_matrix, without_flow_rate
from hopper.von_mises.high_frequency import HighFrequency, high_frequency, law_on
from hopper.von_mises.linearisation import coefficients
from hopper.von_mises.strips import lines, rays, strips, zeros
from tests.von_mises.witnesses import REFERENCE, SETS, law_by_shooting, radial, reference_modes

PLAIN = [i for i, one in enumerate(REFERENCE["sets"]) if one["region"] != "mixed"]
ELLIPTIC = [i for i in PLAIN if REFERENCE["sets"][i]["region"] == "elliptic"]
HYPERBOLIC = [i for i in PLAIN if i not in ELLIPTIC]


@pytest.mark.parametrize("index", PLAIN)
def test_law_by_a_second_quadrature(index):
    solution = radial(*SETS[index])
    law = high_frequency(solution)
    phi, gamma, walls = law_by_shooting(solution)
    np.testing.assert_allclose(law.phi, phi, rtol=0, atol=1e-11)
    # Central differences of eigenvectors leave 1e-10 in Gamma.
    np.testing.assert_allclose(law.gamma, gamma, rtol=0, atol=2e-9)
    np.testing.assert_allclose(law.walls, walls, rtol=0, atol=1e-13)


@pytest.mark.parametrize("index", HYPERBOLIC)
def test_strips_of_the_reference(index):
    known = REFERENCE["sets"][index]
    found = strips(high_frequency(radial(*SETS[index])))
    error = 3 * known["strips_error"] + found.error_estimate
    assert np.all(np.abs(found.intervals - known["strips"]) < error)
    assert error < 1e-8
    np.testing.assert_allclose(found.spacing, known["spacing"], rtol=1e-11)
    assert found.upper_edge == found.intervals[-1, -1]


@pytest.mark.parametrize("index", ELLIPTIC)
def test_quadratures_of_the_reference(index):
    known = REFERENCE["sets"][index]
    law = high_frequency(radial(*SETS[index]))
    for found, name in ((law.phi, "Phi"), (law.gamma, "Gamma")):
        expected = np.array(known[name]) @ [1, 1j]
        assert np.all(np.abs(found - expected) < 1e-12 + law.error_estimate)
    # One family is the conjugate of the other.
    assert law.phi[0] == pytest.approx(law.phi[1].conjugate(), abs=1e-14)


@pytest.mark.parametrize("index", PLAIN)
def test_error_estimate_covers_the_error(index):
    solution = radial(*SETS[index])
    fine = high_frequency(solution)
    checked = 0
    for size in (10, 14, 20, 28):
        grid = half_grid(size, solution.hopper.half_angle)
        coarse = law_on(solution, grid, coefficients(solution, [grid])[0])
        if coarse.error_estimate > 1e-2:
            continue
        error = np.abs(coarse.gamma - fine.gamma).max()
        change = np.abs(coarse.phi - fine.phi).max() / abs(fine.phi[0])
        assert max(error, change) <= coarse.error_estimate + fine.error_estimate
        checked += 1
    assert checked >= 2


def test_lines_of_smooth_walls():
    law = high_frequency(radial(36, 10, 0.0))
    a, b, c, f = law.walls
    assert a * f == pytest.approx(b * c, rel=1e-12)
    found = strips(law)
    np.testing.assert_allclose(
        found.intervals, np.sort(lines(law))[:, None].repeat(2, 1), rtol=1e-12
    )
    # Narrow: kappa is constant, and the families' lines are known.
    for delta in (40, 50):
        law = high_frequency(radial(delta, 0.5, 0.0))
        m = sin(radians(delta)) / sqrt(3)
        root = sqrt(1 - 4 * (1 - 2 * m) / (1 + m))
        for line, squared in zip(lines(law), ((1 + root) / 2, (1 - root) / 2), strict=True):
            limit = (10 * m - 2) / squared - (11 * m - 1)
            assert line == pytest.approx(
                limit / (2 * (1 + m) - 4 * (1 - 2 * m) / squared), rel=1e-3
            )


def modes_between(solution, n, low, high):
    """Eigenvalues with low < Im < high that n and n + 6 half nodes agree on to 1e-7."""
    meshes = [np.linalg.eigvals(without_flow_rate(mode_matrix(solution, k))) for k in (n, n + 6)]
    coarse, fine = (z[(z.imag > low) & (z.imag < high)] for z in meshes)
    distance = np.abs(fine[:, None] - coarse).min(axis=1)
    return fine[distance < 1e-7 * np.abs(fine)]


def test_smooth_lines_by_extrapolation():
    # In 1 / Im**2: Re(lambda) of the modes of each family goes to its line.
    solution = radial(45, 20, 0.0)
    law = high_frequency(solution)
    modes = modes_between(solution, 74, 60, 400)
    for line, other in (lines(law), lines(law)[::-1]):
        mine = modes[np.abs(modes.real - line) < np.abs(modes.real - other)]
        assert len(mine) > 6
        terms = np.vander(1 / mine.imag**2, 4, increasing=True)
        assert np.linalg.lstsq(terms, mine.real)[0][0] == pytest.approx(line, abs=1e-5)


@pytest.mark.parametrize(
    "hopper", [(45, 20, 0.1), (40, 30, 0.2), (50, 10, 0.2), (30, 30, 0.1), (25, 10, 0.1)]
)
def test_modes_approach_roots_of_the_law_like_one_over_lambda(hopper):
    solution = radial(*hopper)
    law = high_frequency(solution)
    period = 2 * pi / abs(law.phi[0])
    modes = modes_between(solution, 64, 4 * period, 14 * period)
    # Of the upper strip or the two rays; those of the lower strip are further from their limit.
    if np.isrealobj(law.phi):
        modes = modes[np.abs(modes.real - strips(law).upper_edge) < 1]
    assert len(modes) >= 8
    gap = np.abs(modes) * np.abs(law.nearest_roots(modes) - modes)
    assert gap.max() < 2 * np.median(gap)
    # One over the first power: the mean of the far half is that of the near one within a quarter.
    gap = gap[np.argsort(np.abs(modes))]
    halves = [half.mean() for half in np.array_split(gap, 2)]
    assert halves[1] == pytest.approx(halves[0], rel=0.25)


@pytest.mark.parametrize("hopper", [(40, 10, 0.1), (45, 20, 0.1)])
def test_high_modes_fill_the_upper_strip(hopper):
    solution = radial(*hopper)
    found = strips(high_frequency(solution))
    low, high = found.intervals[-1]
    modes = modes_between(solution, 74, 8 * found.spacing[0], 22 * found.spacing[0])
    modes = modes[np.abs(modes.real - high) < 2]
    assert len(modes) >= 10
    # They overshoot by the order of 1 / lambda, and are found near both edges.
    slack = 4 / modes.imag.min()
    assert modes.real.min() > low - slack
    assert modes.real.max() < high + slack


@pytest.mark.parametrize("index", ELLIPTIC)
def test_modes_of_elliptic_flows_run_along_rays(index):
    solution = radial(*SETS[index])
    law = high_frequency(solution)
    found = rays(law)
    assert found.slope == pytest.approx(abs(law.phi[0].imag / law.phi[0].real))
    assert found.step[0].real > 0 > found.step[1].real
    modes, _ = reference_modes(index)
    for start, step in zip(found.start, found.step, strict=True):
        points = start + step * np.arange(12)
        # They are roots of the law, better and better.
        value, slope = law.residual(points[6:])
        assert np.all(np.abs(value / slope) < 1e-2 / np.abs(points[6:]))
        # And the highest mode of the reference on this side lies next to one.
        mine = modes[np.sign(modes.real) == np.sign(step.real)][-1]
        assert np.abs(points - mine).min() < 1


def test_zeros_of_exponential_sums():
    random = np.random.default_rng(7)
    x = np.linspace(-40, 40, 400_001)
    seen = set()
    for _ in range(60):
        rates = [0.0, *np.sort(random.uniform(0.2, 2, 3))]
        terms = list(zip(random.normal(size=4), random.uniform(-3, 3, 4), strict=True))
        found = np.array(zeros(terms, rates))
        exponents = np.array([g + w * x for (_, g), w in zip(terms, rates, strict=True)])
        values = np.array([c for c, _ in terms]) @ np.exp(exponents - exponents.max(axis=0))
        changes = np.flatnonzero(values[1:] * values[:-1] < 0)
        inside = found[np.abs(found) < 40]
        assert len(inside) == len(changes)
        assert np.all(np.abs(inside - x[changes]) < 4e-4)
        seen.add(len(inside))
    assert seen >= {0, 1, 2, 3}
    assert zeros([(1.0, 0.0), (0.0, 0.0)], [0.0, 1.0]) == []
    assert zeros([(2.0, 1.0), (-2.0, 0.0)], [0.0, 1.0]) == [pytest.approx(1.0)]


def test_edges_are_zeros_of_the_law_with_real_waves():
    for index in HYPERBOLIC:
        law = high_frequency(radial(*SETS[index]))
        a, b, c, f = law.walls
        for x in strips(law).intervals.ravel():
            wave_a, wave_b = np.exp(x * law.phi + law.gamma)
            least = min(
                abs(a + i * wave_a * b + j * wave_b * c + i * j * wave_a * wave_b * f)
                / (abs(a) + wave_a * abs(b) + wave_b * abs(c) + wave_a * wave_b * abs(f))
                for i in (1, -1)
                for j in (1, -1)
            )
            assert least < 1e-10


def test_strips_contain_the_roots_of_the_law():
    # Dense sampling of the phases of both waves, independent of the edges.
    law = high_frequency(radial(40, 10, 0.1))
    found = strips(law)
    guesses = found.intervals[-1].mean() + 1j * np.linspace(1e4, 1.1e4, 4000)
    roots = law.nearest_roots(guesses)
    roots = roots[np.isfinite(roots)]
    inside = [
        (low - 1e-9 <= roots.real) & (roots.real <= high + 1e-9) for low, high in found.intervals
    ]
    assert np.all(inside[0] | inside[1])
    upper = roots[inside[1]].real
    low, high = found.intervals[1]
    # Filled to a hundredth of its width.
    assert upper.min() - low < 0.01 * (high - low)
    assert high - upper.max() < 0.01 * (high - low)


def test_logarithm_at_the_border_of_type():
    # 9.77, 5.87, 2.42, .98 at delta = 35.27, 35.3, 35.5, 36 deg.
    edges = [strips(high_frequency(radial(d, 10, 0.1))).upper_edge for d in (35.27, 35.3, 35.5, 36)]
    np.testing.assert_allclose(edges, [9.77, 5.87, 2.42, 0.98], atol=0.006)


def test_flows_of_mixed_type_have_no_law():
    with pytest.raises(ConvergenceError, match="changes its type inside the cone"):
        high_frequency(radial(30, 30, 0.3))


def test_roots_that_newton_does_not_reach_are_not_a_number():
    law = HighFrequency(np.array([1.0, 0.5]), np.zeros(2), np.array([1.0, 0, 0, 0]), 0.0)
    assert np.all(np.isnan(law.nearest_roots(np.array([1 + 5j]))))
