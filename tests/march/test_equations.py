"""The Riemann form against the equations of motion, by computer algebra and at random states."""

from functools import lru_cache
from math import pi, radians

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest
import sympy as sp  # type: ignore[import-untyped]

from hopper.march.base import base_of, base_state, base_table, radial_fields, tilt_height
from hopper.march.equations import both_families, coefficients, psi_factor, ray_slopes, terms, tilt
from hopper.problem import Hopper
from tests.march.witnesses import BEYOND, base

DIGITS = 40


@lru_cache(maxsize=2)
def balance(k):
    """Return the radial and angular balance of forces as functions of numbers.

    From the divergence of a stress T = r T(tau, theta), tau = -log r, in spherical (k = 1) or plane
    polar coordinates. Arguments: s, theta, log sigma, psi, and both's slopes by tau and theta.
    """
    tau, theta, s = sp.symbols("tau theta s")
    log_sigma, psi = (sp.Function(name)(tau, theta) for name in ("l", "p"))
    c2, s2 = sp.cos(2 * psi), sp.sin(2 * psi)
    trr, ttt, trt, tpp = (
        sp.exp(log_sigma) * part for part in (1 - s * c2, 1 + s * c2, -s * s2, 1 + s)
    )

    def by_r(scaled):
        """d/dr of r times a function of tau = -log r."""
        return scaled - sp.diff(scaled, tau)

    cot = sp.cot(theta)
    radial = (
        by_r(trr) + sp.diff(trt, theta) + (1 + k) * trr - ttt - k * tpp + k * cot * trt
        + sp.cos(theta)
    )  # fmt: skip
    angular = (
        by_r(trt) + sp.diff(ttt, theta) + (2 + k) * trt + k * cot * (ttt - tpp) - sp.sin(theta)
    )
    names = sp.symbols("L P Lt Pt Ly Py")
    fields = (log_sigma, psi)
    slopes = [sp.diff(each, by) for by in (tau, theta) for each in fields]
    places = dict(zip([*slopes, *fields], [names[i] for i in (2, 3, 4, 5, 0, 1)], strict=True))
    numbers = [each.subs(places) for each in (radial, angular)]
    return sp.lambdify((s, theta, *names), numbers, "mpmath")


def riemann(k, s, theta, log_sigma, psi, log_sigma_y, psi_y, slope):
    """Return the rates of log sigma and psi by the Riemann form as the module states it."""
    mp = mpmath.mp
    delta = mp.asin(s)
    eta = mp.pi / 4 - delta / 2

    def family(y, angle, h):
        t = mp.tan(angle)
        a = mp.cos(eta) - t * mp.sin(eta)
        d = mp.sin(eta) + t * mp.cos(eta) - h * a
        n = (
            (1 - k * s) * (mp.cos(eta) + t * mp.sin(eta)) - (3 + k) * s * a
            - 2 * k * s * t * mp.cos(eta) * mp.cot(y)
            + (mp.cos(eta - y) + t * mp.sin(eta - y)) / mp.exp(log_sigma)
        ) / mp.cos(delta)  # fmt: skip
        return n, a, d

    factor = 2 * mp.tan(delta)
    n, a, d = family(theta, psi, slope)
    plus = (n - a * (log_sigma_y + factor * psi_y)) / d
    n, a, d = family(-theta, -psi, -slope)
    minus = (n + a * (log_sigma_y - factor * psi_y)) / d
    return (plus + minus) / 2, (plus - minus) / (2 * factor)


@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("tilted", [False, True])
def test_riemann_form_is_the_balance_of_forces(k, tilted):
    """Rates by the Riemann form leave no force unbalanced, to 30 digits, in tilted time as well."""
    rng = np.random.default_rng(4)
    with mpmath.workdps(DIGITS):
        for _ in range(5):
            s, theta, log_sigma, psi, ly, py, h = map(mpmath.mpf, rng.uniform(0.1, 0.3, 7))
            h = h if tilted else mpmath.mpf(0)
            lt, pt = riemann(k, s, theta, log_sigma, psi, ly, py, h)
            # At r held, tilted time changes with theta by -h'.
            residual = balance(k)(s, theta, log_sigma, psi, lt, pt, ly - h * lt, py - h * pt)
            assert max(abs(each) for each in residual) < mpmath.mpf(10) ** (8 - DIGITS)


@pytest.mark.parametrize(("geometry", "k"), [("wedge", 0), ("cone", 1)])
@pytest.mark.parametrize("tilted", [False, True])
def test_code_is_the_riemann_form(geometry, k, tilted):
    hopper = Hopper(geometry, radians(35), radians(40))
    rng = np.random.default_rng(5)
    theta, psi = rng.uniform(0.05, 0.6, 20), rng.uniform(-0.3, 0.3, 20)
    log_sigma, ly, py = rng.uniform(-1, 1, (3, 20))
    h = tilt(hopper, rng.uniform(-0.3, 0.3, 20)) if tilted else np.zeros(20)
    light, t, factor = np.exp(-log_sigma), np.tan(psi), 1 / (2 * psi_factor(hopper))
    n, a, d = terms(coefficients(hopper, theta, h), t, light)
    plus = (n - a * (ly + factor * py)) / d
    slopes = ray_slopes(coefficients(hopper, theta, h), t, light)
    np.testing.assert_allclose([slopes.tau, slopes.w], [d / a, n / a], rtol=1e-14)
    n, a, d = terms(coefficients(hopper, -theta, -h), -t, light)
    minus = (n + a * (ly - factor * py)) / d
    rates = (plus + minus) / 2, (plus - minus) / (2 * factor)
    for i in range(20):
        s = mpmath.mpf(hopper.s)
        exact = riemann(k, s, theta[i], log_sigma[i], psi[i], ly[i], py[i], h[i])
        assert rates[0][i] == pytest.approx(float(exact[0]), rel=1e-11, abs=1e-11)
        assert rates[1][i] == pytest.approx(float(exact[1]), rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_both_families_at_once(geometry):
    hopper = Hopper(geometry, radians(35), radians(40))
    rng = np.random.default_rng(6)
    theta, t = rng.uniform(0.05, 0.6, 20), rng.uniform(-0.3, 0.3, 20)
    light = rng.uniform(0.3, 3, 20)
    flat = np.zeros(20)
    plus = ray_slopes(coefficients(hopper, theta, flat), t, light)
    minus = ray_slopes(coefficients(hopper, -theta, flat), -t, light)
    np.testing.assert_allclose(
        both_families(hopper, theta, t, light),
        [plus.tau, minus.tau, plus.w, minus.w],
        rtol=1e-12,
        atol=1e-12,
    )


@pytest.mark.parametrize("tilted", [False, True])
def test_derivatives_of_ray_slopes(tilted):
    """By central differences."""
    hopper = Hopper("cone", radians(35), radians(40))
    theta, t, light = np.array([0.2, 0.5]), np.array([0.1, -0.2]), np.array([0.7, 1.6])
    at = coefficients(hopper, theta, tilt(hopper, 0.5 * t) if tilted else 0 * t)
    slopes, step = ray_slopes(at, t, light), 1e-5

    def difference(name, by_t, by_light):
        after = ray_slopes(at, t + by_t * step, light * np.exp(by_light * step))
        before = ray_slopes(at, t - by_t * step, light * np.exp(-by_light * step))
        return (getattr(after, name) - getattr(before, name)) / (2 * step)

    np.testing.assert_allclose(slopes.tau_by_t, difference("tau", 1, 0), rtol=1e-8)
    np.testing.assert_allclose(slopes.w_by_t, difference("w", 1, 0), rtol=1e-8)
    np.testing.assert_allclose(slopes.w_by_light, difference("w", 0, 1), rtol=1e-8)


@pytest.mark.parametrize("case", [("wedge", 38, 17, 0.12), ("cone", 38, 17, 0.12), BEYOND])
def test_radial_field_is_steady(case):
    """W0_y = N / A, against the slopes of the radial solution."""
    under = base(*case)
    theta = under.hopper.half_angle * np.linspace(0.02, 1, 50)
    sigma, _, dsigma, dpsi = under.solution.fields(theta)
    factor = 1 / (2 * psi_factor(under.hopper))
    for y, sign in ((theta, 1), (-theta, -1)):
        state = base_state(under, y)
        expected = sign * (dsigma / sigma + sign * factor * dpsi)
        np.testing.assert_allclose(state.numerator / state.a, expected, rtol=1e-9, atol=1e-9)


def test_nonlinearity_and_speeds_of_the_page():
    """a+ = cot(eta + psi) and da+/dR+ = -1 / (4 tan(delta) sin(eta + psi)**2)."""
    hopper = Hopper("wedge", radians(35), radians(20))
    eta, psi = pi / 4 - hopper.delta / 2, np.linspace(-0.3, 0.4, 9)
    at = coefficients(hopper, 0 * psi + 0.1, 0 * psi)
    slopes = ray_slopes(at, np.tan(psi), 1 + 0 * psi)
    np.testing.assert_allclose(slopes.tau, np.tan(eta + psi), rtol=1e-13)
    by_w = slopes.tau_by_t * (1 + np.tan(psi) ** 2) * psi_factor(hopper)
    nonlinearity = -1 / (4 * np.tan(hopper.delta) * np.sin(eta + psi) ** 2)
    np.testing.assert_allclose(-by_w / slopes.tau**2, nonlinearity, rtol=1e-12)


def test_height_of_tilted_time():
    """h' by differences of h; and base speeds are +-(s + cos 2 psi) / cos(delta)."""
    under = base(*BEYOND)
    assert under.tilted
    theta, step = np.array([0.03, 0.1, 0.16]), 1e-4
    _, psi = radial_fields(under, theta)
    slope = (tilt_height(under, theta + step) - tilt_height(under, theta - step)) / (2 * step)
    np.testing.assert_allclose(slope, tilt(under.hopper, psi), rtol=1e-6)
    state = base_state(under, theta)
    speed = (under.hopper.s + np.cos(2 * psi)) / np.cos(under.hopper.delta)
    np.testing.assert_allclose(state.a / state.d, speed, rtol=1e-12)
    untilted = base_of(base("cone", 38, 17, 0.12).solution)
    assert not untilted.tilted
    assert np.all(tilt_height(untilted, theta) == 0)


@pytest.mark.parametrize("case", [("wedge", 38, 17, 0.12), BEYOND])
def test_table_of_the_radial_field(case):
    under = base(*case)
    theta = np.random.default_rng(7).uniform(0, under.hopper.half_angle, 200)
    sigma, psi = radial_fields(under, theta)
    at = base_table(under)(theta)
    np.testing.assert_allclose(at[0], psi, atol=1e-11)
    np.testing.assert_allclose(at[1], 1 / sigma, rtol=1e-11)
