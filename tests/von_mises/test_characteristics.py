"""Type of the equations: the characteristics by computer algebra, borders by closed forms."""

from math import asin, cos, degrees, pi, radians, sin, sqrt

import numpy as np
import pytest
import sympy as sp  # type: ignore[import-untyped]
from scipy.integrate import quad

from hopper.radial.solution import solve_radial
from hopper.von_mises.characteristics import (
    AXIS_HYPERBOLIC,
    TENSION,
    equation_type,
    slopes,
    sonic_angle,
    tangency_angle,
)
from tests.von_mises.motion import BASE, JET, linear_parts, s, stress, theta
from tests.von_mises.test_linearisation import vanishes
from tests.von_mises.witnesses import REFERENCE, SETS, cone, radial

k, m, c, q = sp.symbols("kappa m c q", real=True)


def quartic(k, c, q, m):
    return (
        c * (c + m) * k**4
        + 2 * sp.sqrt(3) * q * (c + m) * k**3
        + (4 * q**2 - c * (c + m)) * k**2
        - 2 * sp.sqrt(3) * q * (c - m) * k
        + c * (c - 2 * m)
    )


def test_quartic_is_the_symbol_of_the_equations():
    # Waves f(t - kappa theta). Stresses are one order below velocities: of them (2.10), (2.13) and
    # (2.14) hold the values, and the momentum equations hold nothing of the velocities.
    assert all(linear_parts()[n].diff(x) == 0 for n in ("2.8", "2.9") for f in "UW" for x in JET[f])
    symbol = sp.zeros(5, 5)
    for i, number in enumerate(("2.8", "2.9", "2.10", "2.14", "2.13")):
        for j, (name, (value, rate, slope)) in enumerate(JET.items()):
            part = linear_parts()[number]
            if number not in ("2.8", "2.9") and name in "SYZ":
                symbol[i, j] = part.diff(value)
            else:
                symbol[i, j] = part.diff(rate) - k * part.diff(slope)
    random = np.random.default_rng(4)
    for _ in range(3):
        at = {x: sp.Rational(int(random.integers(10, 70)), 100) for x in (*BASE, s, theta)}
        found = sp.Poly(symbol.subs(at).evalf(40).det(method="berkowitz"), k).all_coeffs()
        # The fifth power drops out.
        assert abs(found[0]) < 1e-30
        found = found[1:]
        psi = at[BASE[1]]
        expected = quartic(k, sp.cos(2 * psi), sp.sin(2 * psi), at[s] / sp.sqrt(3))
        expected = sp.Poly(expected.evalf(40), k).all_coeffs()
        assert len(found) == len(expected) == 5
        for one, other in zip(found, expected, strict=True):
            assert abs(one / found[0] - other / expected[0]) < 1e-30


def test_discriminant_of_the_biquadratic():
    # T1 + T2 and T1 - T2 over sigma: the principal stresses in the plane of flow.
    half_sum, half_difference = 1 - m * c / 2, m / 2 * sp.sqrt(12 - 3 * c**2)
    product = sp.expand(half_sum**2 - half_difference**2)
    assert sp.expand(product - (1 - m * c + m**2 * (c**2 - 3))) == 0
    in_plane = stress(1, BASE[1], 0)
    squared = ((in_plane[2] - in_plane[0]) / 2) ** 2 + in_plane[1] ** 2
    at = {m: s / sp.sqrt(3), c: sp.cos(2 * BASE[1])}
    assert vanishes((in_plane[0] + in_plane[2]) / 2 - half_sum.subs(at))
    assert vanishes(squared - (half_difference**2).subs(at))
    discriminant = (2 - c**2 + m * c) ** 2 - 4 * product
    wanted = (4 - c**2) * (sp.sqrt(3) * s - c) * (c + m)
    assert sp.expand((discriminant - wanted).subs(s, sp.sqrt(3) * m)) == 0


def test_slopes_are_the_roots_of_the_quartic():
    random = np.random.default_rng(2)
    numeric = sp.lambdify((k, c, q, m), quartic(k, c, q, m))
    factors = sp.lambdify((c, q, m), sp.Poly(quartic(k, c, q, m), k).all_coeffs())
    for _ in range(200):
        value, psi = sin(random.uniform(0.1, pi / 3)) / sqrt(3), random.uniform(-0.78, 0.78)
        at = cos(2 * psi), sin(2 * psi)
        found = slopes(np.array([at[0]]), np.array([at[1]]), value)[:, 0]
        roots = np.roots(factors(*at, value))
        distance = np.abs(found[:, None] - roots)
        assert np.all(distance.min(axis=0) < 1e-9 * np.maximum(1, np.abs(roots)))
        assert np.all(np.abs(numeric(found, *at, value)) < 1e-9 * np.maximum(1, np.abs(found)) ** 4)
        if cos(2 * psi) < 3 * value:
            assert np.isrealobj(found)
        else:
            assert found[3].imag < 0 < found[2].imag
            np.testing.assert_allclose(found[[0, 3]].conj(), found[[1, 2]], rtol=1e-12)


def test_slopes_keep_their_order_beyond_the_tangency():
    psi = np.linspace(0, 0.78, 400)
    found = slopes(np.cos(2 * psi), np.sin(2 * psi), sin(radians(45)) / sqrt(3))
    assert np.all(np.diff(found, axis=0) > 0)
    # Two of either sign up to the tangency, where the third vanishes.
    vanishing = psi[np.argmax(found[2] < 0)]
    assert vanishing == pytest.approx(tangency_angle(sin(radians(45))), abs=2e-3)


def test_borders_on_the_axis():
    assert degrees(AXIS_HYPERBOLIC) == pytest.approx(
        REFERENCE["closed_forms"]["axis_type_border_deg"]
    )
    assert degrees(AXIS_HYPERBOLIC) == pytest.approx(35.2644, abs=1e-4)
    assert degrees(TENSION) == pytest.approx(REFERENCE["closed_forms"]["axis_tension_deg"])
    # T_rr = sigma (1 - 2 m) and the smallest slope vanish on the axis there.
    value = sin(TENSION) / sqrt(3)
    assert 1 - 2 * value == pytest.approx(0, abs=1e-15)
    for delta, kind in ((35.2643, "elliptic"), (35.2645, "hyperbolic"), (59.9999, "hyperbolic")):
        assert equation_type(radial(delta, 0.05, 0.0)).kind == kind
    assert equation_type(radial(60.0001, 0.05, 0.0)).kind == "tension"
    # On the axis all slopes are real from the first border on.
    one, zero = np.ones(1), np.zeros(1)
    assert np.iscomplexobj(slopes(one, zero, sin(radians(35.2643)) / sqrt(3)))
    assert np.isrealobj(slopes(one, zero, sin(radians(35.2645)) / sqrt(3)))


@pytest.mark.parametrize("index", range(len(SETS)), ids=str)
def test_type_of_the_reference(index):
    found = equation_type(radial(*SETS[index]))
    region = REFERENCE["sets"][index]["region"]
    assert found.kind == ("hyperbolic" if region == "slanted" else region)
    assert found.slanted == (region == "slanted")


@pytest.mark.parametrize(
    "border", REFERENCE["borders_phi_deg"], ids=lambda b: f"{b['half_angle']}-{b['delta']}"
)
def test_borders_in_friction(border):
    hopper = cone(border["delta"], border["half_angle"])

    def at(phi):
        return equation_type(solve_radial(hopper, radians(phi)))

    # The reference took the largest psi inside the cone on a grid: its borders at 30 deg lie too
    # high by up to 4e-5 deg.
    below, above = 1e-7 if border["half_angle"] == 10 else 5e-5, 1e-7
    phi = border["phi_elliptic_ends"]
    if phi is not None:
        assert at(phi - below).kind == "elliptic"
        assert at(phi + above).kind == "mixed"
    else:
        phi = border["phi_tangency"]
        assert not at(phi - below).slanted
        assert at(phi + above).slanted


def test_wall_borders_in_closed_form():
    # Where psi is largest at the wall, at 10 deg: the friction of the wall at the two angles.
    value = sin(radians(30))
    law = cone(30, 10).material
    mu = np.tan(law.friction_angle(radians(30), sonic_angle(value)))
    assert mu == pytest.approx(value * sqrt(1 - 3 * value**2) / (1 + value**2))
    assert mu == pytest.approx(0.2)
    mu = np.tan(law.friction_angle(radians(30), tangency_angle(value)))
    assert mu == pytest.approx(value * sqrt(1 - 4 * value**2 / 3) / (1 + 2 * value**2 / 3))
    assert np.tan(law.friction_angle(radians(30), pi / 4)) == pytest.approx(value)


def test_a_ring_inside_the_cone():
    # psi is largest inside, and falls again to 0 at a smooth wall.
    solution = radial(35.25, 30, 0.0)
    found = equation_type(solution)
    assert found.kind == "mixed"
    inner, outer = found.sonic
    assert 0 < inner < solution.psi_maximum()[0] < outer < radians(30)
    limit = sonic_angle(solution.hopper.s)
    np.testing.assert_allclose(solution.psi_at([inner, outer]), limit, atol=1e-12)


def test_spacing_of_ring_modes():
    solution = radial(30, 30, 0.3)
    found = equation_type(solution)
    value = solution.hopper.s / sqrt(3)
    assert found.sonic[0] < radians(30)

    def width(x):
        # theta = sonic + x**2 removes the square root at the sonic line.
        psi = solution.psi_at([found.sonic[0] + x**2])
        root = slopes(np.minimum(np.cos(2 * psi), 3 * value), np.sin(2 * psi), value)[:, 0]
        return float(root[3] - root[2] + root[1] - root[0]) * 2 * x

    integral = quad(width, 0, sqrt(radians(30) - found.sonic[0]), epsabs=1e-12)[0]
    assert found.ring_spacing == pytest.approx(2 * pi / integral, rel=1e-8)
    assert found.ring_spacing == pytest.approx(15.65, abs=0.005)
    assert asin(1 / sqrt(3)) == AXIS_HYPERBOLIC
