"""The linearised equations against the equations of motion, by computer algebra."""

import numpy as np
import pytest
import sympy as sp  # type: ignore[import-untyped]

from tests.von_mises.motion import BASE, JET, linear_parts, mu, s, stress, theta

(S, S_t, Sd), (Y, Y_t, Yd), (Z, _, Zd), (U, U_t, Ud), (W, W_t, Wd) = (JET[k] for k in "SYZUW")
sigma, psi, sigma_slope, psi_slope = BASE
m, c, q = s / sp.sqrt(3), sp.cos(2 * psi), sp.sin(2 * psi)
l, h, cot = sigma_slope / sigma, sp.sqrt(12) * q / c, sp.cot(theta)  # noqa: E741


def stresses(S, Y):
    """R, Q, B of the module's docstring."""
    return (
        (1 - 2 * m * c) * S + 4 * m * q * Y,
        -s * q * S - 2 * s * c * Y,
        (1 + m * c) * S - 2 * m * q * Y,
    )


def slope(of):
    """d/dtheta of a form in S, Y, Z, W with coefficients in psi."""
    return sum(of.diff(x) * x_slope for x, x_slope in ((S, Sd), (Y, Yd), (Z, Zd), (psi, psi_slope)))


R, Q, B = stresses(S, Y)
R_t, Q_t, _ = stresses(S_t, Y_t)
MOMENTUM_R = R_t + 3 * R + slope(Q) + (l + cot) * Q - 2 * B
MOMENTUM_T = Q_t + 4 * Q + slope(B + s * Z) + l * (B + s * Z) + 2 * s * cot * Z
CONTINUITY = U_t + Wd + (cot - h) * W
FLOW = W_t - 3 * W + Ud - sp.sqrt(3) * q / c * U_t + 4 * sp.sqrt(3) / c**2 * Y
HOOP = Z - c / sp.sqrt(12) * (Wd - (h + cot) * W)


def vanishes(expression):
    """Whether an expression is zero, by algebra at random points to 40 digits."""
    terms = sp.Add.make_args(sp.expand(expression))
    symbols = sorted(expression.free_symbols, key=str)
    random = np.random.default_rng(3)
    for _ in range(4):
        at = {x: sp.Rational(int(random.integers(10, 90)), 100) for x in symbols}
        values = [term.subs(at).evalf(40) for term in terms]
        if abs(sum(values)) > sum(abs(value) for value in values) * sp.Float(10) ** -35:
            return False
    return True


@pytest.mark.parametrize(
    ("number", "multiple", "form"),
    [("2.8", sigma, MOMENTUM_R), ("2.9", sigma, MOMENTUM_T), ("2.10", -1, CONTINUITY)],
)
def test_momentum_and_continuity(number, multiple, form):
    assert vanishes(linear_parts()[number] - multiple * form)
    # The comparison can fail.
    assert not vanishes(linear_parts()[number] - multiple * (form + S_t * U / 1000))


def test_flow_rule():
    # (2.13) is the equation for Z.
    assert vanishes(linear_parts()["2.13"] + 2 * s * sigma * HOOP)
    # (2.14) is the last equation once Z and the divergence are taken from the others.
    rule = linear_parts()["2.14"].subs(Z, c / sp.sqrt(12) * (Wd - (h + cot) * W))
    rule = rule - sigma * m * c * FLOW
    assert vanishes(sp.expand(rule).subs(Wd, -U_t - (cot - h) * W))


def test_the_yield_condition_holds_off_the_radial_flow():
    omega = sp.Symbol("omega", real=True)
    trr, trt, ttt, tpp = stress(sigma, psi, omega)
    p = (trr + ttt + tpp) / 3
    square = (trr - p) ** 2 + (ttt - p) ** 2 + (tpp - p) ** 2 + 2 * trt**2 - 2 * s**2 * p**2
    assert sp.simplify(p - sigma) == 0
    assert vanishes(square)


def test_wall_law():
    # mu is that of the radial flow; S drops out.
    friction = s * q / (1 + m * c)
    law = linear_parts()["2.15"].subs(mu, friction)
    assert vanishes(law.diff(S))
    assert vanishes(law.subs(Y, s * q * Z / (2 * (c + m))))
