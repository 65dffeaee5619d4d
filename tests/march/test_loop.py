"""The march on the loop: exact cases, published fields, orders, linear modes."""

from dataclasses import replace
from math import atan, degrees, radians, tan

import numpy as np
import pytest

from hopper.evidence.motion import stress
from hopper.march import history
from hopper.march.base import base_of, radial_fields, tilt_height
from hopper.march.fields import deviations, interpolated, momentum_residual, state_at, stress_of
from hopper.march.history import march_loop
from hopper.march.loop import corner_defect, jacobian, linearization, make_loop, rate, step
from hopper.march.mapped import mesh
from hopper.march.tops import Top, bump_of_psi, bump_of_sigma, one_sided_bump, scaled
from hopper.stability.modes import linear_stability
from hopper.yield_conditions import MOHR_COULOMB
from tests.march.witnesses import (
    BEYOND,
    REFERENCE,
    base,
    base_of_case,
    linear_mode,
    mode_as_top,
    on_loop,
    top_of_case,
)

HOPPERS = [("wedge", 38, 17, 0.12), ("cone", 38, 17, 0.12), BEYOND]
X = np.linspace(0, 1, 21)


def published(under, history, tau):
    """sigma at x = 0, 1/2, 1 and psi at 1/2."""
    x = np.array([0.0, 0.5, 1.0])
    even, odd = deviations(history.loop, state_at(history, tau), x)
    sigma, psi = radial_fields(under, under.hopper.half_angle * x)
    return np.array([*(sigma * np.exp(even)), psi[1] + odd[1]])


@pytest.mark.parametrize("case", HOPPERS)
@pytest.mark.parametrize("legs", [1, 2])
def test_radial_field_is_balanced_exactly(case, legs):
    loop = make_loop(base(*case), 48, legs)
    assert np.all(rate(loop, np.zeros((legs, 48)))[0] == 0.0)
    history = march_loop(loop, np.zeros((legs, 48)), 0.1)
    assert history.end == "end"
    assert np.all(history.w == 0.0)


@pytest.mark.parametrize("case", REFERENCE["fields"], ids=lambda case: case["geometry"])
def test_published_fields(case):
    """Table of fields at tau = .25; two meshes say how far ours can be from it."""
    under, top, tau = base_of_case(case), top_of_case(case), case["tau"]
    coarse, fine = (published(under, on_loop(under, top, points, tau), tau) for points in (96, 128))
    error = np.abs(fine - coarse).max()
    assert error < 3e-6
    expected = [case[key] for key in ("sigma_axis", "sigma_half", "sigma_wall", "psi_half")]
    assert np.abs(fine - expected).max() < error + case["error"]


def test_published_fields_in_tilted_time():
    history = on_loop(base(*BEYOND), bump_of_sigma(0.2), 96, 0.1)
    values = [0.0556068664, 0.0832764805, 0.1511555159, 0.4907536875]
    np.testing.assert_allclose(published(base(*BEYOND), history, 0.1), values, rtol=0, atol=1e-9)


def test_published_fields_without_symmetry():
    under = base("wedge", 38, 17, 0.12)
    history = on_loop(under, one_sided_bump(0.1), 128, 0.1)
    walls = np.array([-1.0, 1.0])
    even, odd = deviations(history.loop, state_at(history, 0.1), walls)
    sigma, _ = radial_fields(under, under.hopper.half_angle * walls)
    np.testing.assert_allclose(sigma * np.exp(even), [0.70668349, 0.77317567], atol=3e-8)
    np.testing.assert_allclose(odd, 0, atol=1e-14)


@pytest.mark.parametrize("case", HOPPERS[:2])
def test_tilted_time_shows_the_same_stress(case):
    """A march, met on r = r_top exp(-.1 - h), goes on from there in tilted time."""
    under = base(*case)
    tilted = base_of(under.solution, tilted=True)
    history = on_loop(under, bump_of_sigma(0.1), 128, 0.4)

    def at(x, tau):
        """Deviations on the surface tau + h."""
        times = tau + tilt_height(tilted, under.hopper.half_angle * x)
        points = [
            deviations(history.loop, state_at(history, time), np.array([place]))
            for place, time in zip(x, times, strict=True)
        ]
        return np.array(points)[:, :, 0].T

    assert np.ptp(tilt_height(tilted, under.hopper.half_angle * X)) > 0.02
    later = on_loop(tilted, Top("met", True, lambda _, x: tuple(at(x, 0.1))), 128, 0.1)
    found = np.stack(deviations(later.loop, later.w[-1], X))
    assert np.abs(found - at(X, 0.2)).max() < 2e-7


def test_two_legs_of_a_symmetric_top_are_one():
    under, top = base("wedge", 38, 17, 0.12), bump_of_sigma(0.1)
    one = on_loop(under, top, 64, 0.2)
    loop = make_loop(under, 64, 2)
    two = march_loop(loop, np.repeat(one.w[0], 2, axis=0), 0.2)
    np.testing.assert_allclose(two.w[-1], np.repeat(one.w[-1], 2, axis=0), rtol=0, atol=1e-13)


@pytest.mark.parametrize("case", HOPPERS)
def test_error_falls_geometrically_with_the_mesh(case):
    under, top = base(*case), bump_of_sigma(0.1)
    states = [
        np.stack(deviations((h := on_loop(under, top, n, 0.15)).loop, h.w[-1], X))
        for n in (32, 48, 64, 128)
    ]
    errors = [np.abs(state - states[-1]).max() for state in states[:-1]]
    # One order every 16 points, until steps in time count.
    assert errors[1] < errors[0] / 5
    assert errors[2] < errors[1] / 3
    assert errors[2] < 3e-6


def test_steps_in_tau_are_of_fourth_order():
    under = base("cone", 38, 17, 0.12)
    loop = make_loop(under, 48, 1)
    start = on_loop(under, bump_of_sigma(0.2), 48, 0.0).w[0]

    def after(steps):
        w, length = start, 0.1 / steps
        for _ in range(steps):
            w = step(loop, w, rate(loop, w)[0], length)
        return w

    coarse, middle, fine = (after(steps) for steps in (100, 200, 400))
    ratio = np.abs(coarse - middle).max() / np.abs(middle - fine).max()
    assert 12 < ratio < 20


@pytest.mark.parametrize("case", HOPPERS)
def test_steps_of_both_kinds_agree(case, monkeypatch):
    """Multistep steps about the linearisation, and Runge-Kutta's of all of the equations."""
    under, top = base(*case), bump_of_sigma(0.1)
    found = on_loop(under, top, 96, 0.2)
    with monkeypatch.context() as short:
        short.setattr(history, "_COURANT", history._COURANT / 2)
        finer = on_loop(under, top, 96, 0.2)
    monkeypatch.setattr(history, "_STABLE", 1e-12)
    monkeypatch.setattr(history, "_EXPLICIT", history._EXPLICIT / 2)
    other = on_loop(under, top, 96, 0.2)
    error = np.abs(found.w[-1] - finer.w[-1]).max()
    assert error < 2e-7
    assert np.abs(found.w[-1] - other.w[-1]).max() < 1.5 * error


@pytest.mark.parametrize("case", HOPPERS)
@pytest.mark.parametrize("legs", [1, 2])
def test_linearisation_against_differences_of_rates(case, legs):
    loop, size = make_loop(base(*case), 24, legs), 1e-5
    matrix = linearization(loop)
    for place in (0, 5, 23, matrix.shape[0] - 1):
        unit = np.zeros(matrix.shape[0])
        unit[place] = size
        up, down = (rate(loop, sign * unit.reshape(legs, -1))[0] for sign in (1, -1))
        slope = (up - down).ravel() / (2 * size)
        np.testing.assert_allclose(
            slope, matrix[:, place], rtol=0, atol=1e-6 * np.abs(matrix).max()
        )


@pytest.mark.parametrize("case", HOPPERS)
def test_momentum_balance_of_the_stresses(case):
    """By differences in tau, without the Riemann form; and it can fail."""
    under = base(*case)
    residuals = [
        momentum_residual(on_loop(under, bump_of_sigma(0.1), n, 0.2), 0.15) for n in (48, 96)
    ]
    assert residuals[1] < 1e-5
    assert residuals[1] < residuals[0] / 2
    history = on_loop(under, bump_of_sigma(0.1), 96, 0.2)
    loop = history.loop
    wrong = replace(history, loop=replace(loop, by_t=1.01 * loop.by_t))
    assert momentum_residual(wrong, 0.15) > 100 * residuals[1]


def test_stress_is_that_of_the_yield_condition():
    sigma, psi, s = np.array([0.4, 1.2]), np.array([-0.2, 0.3]), 0.6
    expected = stress(MOHR_COULOMB, s, sigma, psi)
    found = stress_of(s, sigma, psi)
    for part in ("rr", "rt", "tt", "pp"):
        np.testing.assert_allclose(getattr(found, part), getattr(expected, part), rtol=1e-15)


def test_dense_output():
    """Between steps the Hermite polynomial and a shorter step agree."""
    history = on_loop(base("cone", 38, 17, 0.12), bump_of_sigma(0.1), 64, 0.1)
    tau = np.array([0.01234, 0.05, 0.0777])
    exact = np.array([state_at(history, each) for each in tau])
    np.testing.assert_allclose(interpolated(history, tau), exact, rtol=0, atol=2e-7)
    assert np.all(state_at(history, 0.1) == history.w[-1])


# Small deviations against the linearised equations.


@pytest.mark.parametrize("case", [*HOPPERS[:2], ("wedge", 35, 10, 0.0), ("cone", 40, 20, 0.2)])
@pytest.mark.parametrize("which", [0, 1])
def test_small_deviations_are_linear_modes(case, which):
    """For eps = 1e-7 they follow exp(lambda tau), to what the deviation squared leaves."""
    under, size, tau = base(*case), 1e-7, 0.5
    eigenvalue = linear_stability(under.solution).eigenvalues[which]
    mode = linear_mode(under.solution, eigenvalue)
    history = on_loop(under, mode_as_top(mode, size, symmetric=True), 64, tau)
    found = np.stack(deviations(history.loop, history.w[-1], X))
    expected = size * np.stack(mode(under, X, tau))
    scale = size * max(1.0, float(np.exp(eigenvalue.real * tau)))
    assert np.abs(found - expected).max() < 3e-5 * scale


def test_small_deviations_without_symmetry():
    """sigma1 odd, psi1 even, in a wedge; the eigenvalue is published."""
    under, size, tau = base("wedge", 45, 30, tan(radians(15))), 1e-7, 1.0
    mode = linear_mode(under.solution, -0.2953342981 + 5.5191492336j, "asymmetric")
    history = on_loop(under, mode_as_top(mode, size, symmetric=False), 64, tau)
    x = np.linspace(-1, 1, 41)
    found = np.stack(deviations(history.loop, history.w[-1], x))
    assert np.abs(found - size * np.stack(mode(under, x, tau))).max() < 3e-5 * size


@pytest.mark.parametrize(
    ("case", "legs", "eigenvalues"),
    [
        # Of the linearised equations by shooting; tilted time, no symmetry, and both.
        (BEYOND, 1, [-5.33033683 + 22.88109997j, -23.07021083]),
        (("wedge", 40, 20, tan(radians(25))), 2, [0.6649132978 + 7.0893728106j]),
        (("wedge", 45, 30, tan(radians(15))), 2, [-0.2953342981 + 5.5191492336j]),
    ],
)
def test_eigenvalues_of_the_loop(case, legs, eigenvalues):
    values = np.linalg.eigvals(jacobian(make_loop(base(*case), 64, legs)))
    for each in eigenvalues:
        assert np.abs(values - each).min() < 1e-6


def test_deviation_from_the_linear_mode_is_quadratic():
    """(march - eps mode) / eps**2 tends to a limit with an O(eps) change."""
    under, tau = base("wedge", 38, 17, 0.12), 0.3
    eigenvalue = linear_stability(under.solution).eigenvalues[1]
    mode = linear_mode(under.solution, eigenvalue)

    def excess(size):
        history = on_loop(under, mode_as_top(mode, size, symmetric=True), 64, tau)
        found = np.stack(deviations(history.loop, history.w[-1], X))
        return (found - size * np.stack(mode(under, X, tau))) / size**2

    large, middle, small = (excess(size) for size in (4e-3, 2e-3, 1e-3))
    assert np.abs(small).max() > 0.05
    first, second = np.abs(large - middle).max(), np.abs(middle - small).max()
    assert first / second == pytest.approx(2, rel=0.15)


@pytest.mark.parametrize("case", [("cone", 38, 17, 0.12), ("cone", 40, 20, 0.2)])
def test_return_to_the_radial_field_at_the_linear_rate(case):
    """A finite deviation's part along the first wave ends as exp(lambda tau)."""
    under, points = base(*case), 64
    history = on_loop(under, bump_of_sigma(0.1), points, 5.0)
    first = linear_stability(under.solution).eigenvalues[1]
    assert first.imag > 0
    values, left = np.linalg.eig(jacobian(history.loop).T)
    along = left[:, np.argmin(np.abs(values - first))]
    amplitude = np.abs(interpolated(history, np.array([4.0, 5.0]))[:, 0, 1:] @ along)
    assert np.log(amplitude[1] / amplitude[0]) == pytest.approx(first.real, abs=2e-5)


def test_corner_compatibility():
    under = base("cone", 38, 17, 0.12)
    smooth = on_loop(under, bump_of_psi(0.1), 64, 0.0)
    assert corner_defect(smooth.loop, smooth.w[0]) < 1e-7
    kinked = on_loop(under, scaled(0.5), 64, 0.0)
    assert corner_defect(kinked.loop, kinked.w[0]) > 0.1


def test_tangency_ends_the_march():
    """A light top in a wedge of theta_w > delta: at tau = .056, before any crossing."""
    under = base("wedge", 25, 45, 0.15)
    coarse, fine = (on_loop(under, bump_of_sigma(-2.0), n, 0.2) for n in (128, 192))
    assert coarse.end == fine.end == "tangency"
    assert coarse.tangency is not None
    assert fine.tangency is not None
    assert fine.tangency[0] == pytest.approx(0.056, abs=5e-4)
    assert fine.tangency[0] == pytest.approx(coarse.tangency[0], abs=2e-4)
    # At a node psi is at its limit there, but for a last step, which changes it by a degree.
    even, odd = deviations(fine.loop, fine.w[-1], fine.loop.mesh.x)
    _, psi = radial_fields(under, fine.loop.y)
    assert np.isfinite(even).all()
    assert 44 - 12.5 < degrees(np.abs(psi + odd).max()) <= 45 - 12.5


def test_mesh_differentiates_and_interpolates():
    points = mesh(64)
    wave = np.sin(7 * points.x + 1)
    np.testing.assert_allclose(points.derivative @ wave, 7 * np.cos(7 * points.x + 1), atol=1e-5)
    x = np.linspace(-1, 1, 33)
    np.testing.assert_allclose(points.interpolation(x) @ wave, np.sin(7 * x + 1), atol=1e-6)
    np.testing.assert_allclose(points.x, -points.x[::-1], rtol=0, atol=1e-16)


def test_friction_of_the_wall_is_kept():
    under = base("cone", 38, 17, 0.12)
    history = on_loop(under, bump_of_sigma(0.1), 64, 0.2)
    _, odd = deviations(history.loop, history.w[-1], np.array([1.0]))
    _, psi = radial_fields(under, np.array([under.hopper.half_angle]))
    phi = MOHR_COULOMB.friction_angle(under.hopper.delta, float(psi[0] + odd[0]))
    assert phi == pytest.approx(atan(0.12), abs=1e-12)
