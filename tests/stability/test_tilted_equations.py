"""The equations of the tilted problem in closed form, against their derivation, to 40 digits.

No numerics of the package: computer algebra at random points, with d and both slopes of the radial
solution free unless a test says that the radial equations are used.
"""

from random import Random

import mpmath as mp  # type: ignore[import-untyped]
import pytest
import sympy as sp  # type: ignore[import-untyped]

from tests.stability.tilted_equations import (
    D_PSI,
    D_SIGMA,
    PSI,
    SIGMA,
    THETA,
    K,
    S,
    base_slopes,
    linearised,
    radial_equations,
    solved_for_slopes,
)

SYMBOLS = (S, K, THETA, SIGMA, PSI, D_SIGMA, D_PSI)
C2, S2, COT = sp.cos(2 * PSI), sp.sin(2 * PSI), sp.cot(THETA)
W, Q, COS2 = S + C2, S - C2, 1 - S**2
ROUNDING = mp.mpf(10) ** -34


def points(count=6, on_solution=False, k=None):
    """Yield random arguments; with slopes as the radial equations prescribe them if wished."""
    source = Random(1)
    slopes = sp.lambdify(SYMBOLS[:5], base_slopes(), "mpmath")

    def random():
        return mp.mpf(source.getrandbits(140)) / 2**140

    for _ in range(count):
        s, theta = mp.mpf(1) / 10 + 8 * random() / 10, mp.mpf(1) / 20 + random()
        # Between -singular and the singular angle pi/4 + delta/2, so on both sides of q = 0.
        psi = (2 * random() - 1) * (mp.pi / 4 + mp.asin(s) / 2)
        head = (s, 3 * random() if k is None else mp.mpf(k), theta, 1 / 20 + random(), psi)
        yield (*head, *(slopes(*head) if on_solution else (random() - 0.5, random() - 0.5)))


def assert_equal(left, right, **where):
    """Compare two matrices at random points, relative to their size."""
    with mp.workdps(40):
        both = sp.lambdify(SYMBOLS, [sp.Matrix(left), sp.Matrix(right)], "mpmath")
        for at in points(**where):
            a, b = both(*at)
            assert mp.norm(a - b) <= ROUNDING * (1 + mp.norm(a)), at


def gradient(component):
    return sp.Matrix([[component.diff(SIGMA), component.diff(PSI)]])


def along(matrix):
    """Derivative by theta along the radial solution, cotangents aside."""
    return matrix.diff(SIGMA) * D_SIGMA + matrix.diff(PSI) * D_PSI


def test_matrices_before_any_division():
    e1, e2, e0 = linearised()
    trr, ttt = SIGMA * (1 - S * C2), SIGMA * (1 + S * C2)
    d_rr, d_tt = gradient(trr), gradient(ttt)
    d_rt, d_pp = gradient(-SIGMA * S * S2), gradient(SIGMA * (1 + S))
    assert_equal(e1, sp.Matrix.vstack(d_rr, d_rt))
    assert_equal(e2, sp.Matrix.vstack(d_rt, d_tt))
    first = along(d_rt) + (2 + K) * d_rr - d_tt + K * (COT * d_rt - d_pp)
    second = along(d_tt) + (3 + K) * d_rt + K * COT * (d_tt - d_pp)
    assert_equal(e0, sp.Matrix.vstack(first, second))
    assert_equal([e2.det(), e1.det()], [2 * S * SIGMA * (S + C2), -2 * S * SIGMA * (C2 - S)])


def closed_n():
    return -sp.Matrix([[S2, 2 * S * SIGMA], [COS2 / (2 * S * SIGMA), S2]]) / W


def closed_k():
    brace = 2 * S * D_PSI * W + 2 * S * C2 + 3 * S**2 - 1 + K * S * (1 + S) * (1 + C2 + S2 * COT)
    return (
        sp.Matrix(
            [
                [-S2 + K * S * (S2 + (1 - C2) * COT), -2 * S * SIGMA * (3 + K + 2 * D_PSI)],
                [
                    brace / (2 * S * SIGMA),
                    D_SIGMA / SIGMA * W - (3 + 2 * D_PSI) * S2 + K * (W * COT - S2),
                ],
            ]
        )
        / W
    )


def closed_j():
    return -W * sp.Matrix([[0, 2 * S * SIGMA / COS2], [1 / (2 * S * SIGMA), 0]])


def closed_a():
    return sp.Matrix([[-S2, 2 * S * SIGMA], [COS2 / (2 * S * SIGMA), -S2]]) / Q


def test_solved_for_the_slopes():
    n, k = solved_for_slopes()
    assert_equal(n, closed_n())
    assert_equal(k, closed_k())


def test_tilted_time():
    """J in closed form, its speeds, and F' = J K where w = s + cos 2psi has cancelled."""
    n, k, j = closed_n(), closed_k(), closed_j()
    assert_equal(j * (n + S2 / W * sp.eye(2)), sp.eye(2))
    assert_equal([j.trace(), j.det()], [0, -(W**2) / COS2])
    brace = 2 * S * D_PSI * W + 2 * S * C2 + 3 * S**2 - 1 + K * S * (1 + S) * (1 + C2 + S2 * COT)
    f = j * k
    assert_equal([f[0, 0], f[1, 1]], [-brace / COS2, 3 + K + 2 * D_PSI])


def test_both_characteristics_lie_on_either_side_of_the_tilted_surfaces():
    """Slopes dt/dtheta of characteristics are the eigenvalues of N, of t' = const they are -h'."""
    n, slope = closed_n(), -S2 / W
    assert_equal([n.trace() / 2], [slope])
    assert_equal([(n - slope * sp.eye(2)).det()], [-COS2 / W**2])


def test_section_3_is_the_same_problem_divided_by_the_singular_matrix():
    """A = N^-1 and F = N^-1 K are A and B + kC of section 3, slopes left free."""
    a = closed_a()
    b = sp.Matrix(
        [
            [(2 * S * D_PSI + 3 * S - C2) / Q, 2 * S * D_SIGMA / Q],
            [-(1 + D_PSI) * S2 / (SIGMA * Q), 3 + 2 * D_PSI - D_SIGMA / SIGMA * S2 / Q],
        ]
    )
    c = sp.Matrix(
        [
            [S * (S2 * COT + C2 + 1) / Q, 2 * S * SIGMA * COT / Q],
            [-(1 + S) * ((1 - C2) * COT + S2) / (2 * SIGMA * Q), (Q - S2 * COT) / Q],
        ]
    )
    assert_equal(a * closed_n(), sp.eye(2))
    assert_equal(closed_n() * (b + K * c), closed_k())


def test_both_forms_of_the_line_have_the_same_integrand():
    k, a, j, cos = closed_k(), closed_a(), closed_j(), sp.sqrt(COS2)
    f = a * k
    rho = 2 * S * SIGMA / cos
    p = (f[0, 0] + f[1, 1]) / 2
    q = (f[0, 1] / rho + rho * f[1, 0]) / 2
    assert_equal([(p * cos + q * S2) / W], [(j * k).trace() / 2 * cos / W])


def test_moving_along_the_family_solves_the_equations_without_time():
    """So psi1 vanishes at the wall for lambda = 0 where psi_w is stationary along the family."""
    equations = sp.Matrix(radial_equations())
    _, e2, e0 = linearised()
    assert_equal(equations.jacobian([D_SIGMA, D_PSI]), e2)
    assert_equal(equations.jacobian([SIGMA, PSI]), e0)


@pytest.mark.parametrize("direction", ["vertical", "sideways"])
def test_moving_the_apex_is_a_mode_with_eigenvalue_one(direction):
    """The field moved by a constant vector: grad(r sigma) and grad(psi + theta) along it, over r.

    Sideways only in wedges, where moving keeps the flow plane.
    """
    cos, sin = sp.cos(THETA), sp.sin(THETA)
    if direction == "vertical":
        u = sp.Matrix([cos * SIGMA - sin * D_SIGMA, -sin * (1 + D_PSI)])
    else:
        u = sp.Matrix([sin * SIGMA + cos * D_SIGMA, cos * (1 + D_PSI)])
    slopes = sp.Matrix(base_slopes())
    u = u.subs({D_SIGMA: slopes[0], D_PSI: slopes[1]})
    u_theta = u.diff(THETA) + u.diff(SIGMA) * D_SIGMA + u.diff(PSI) * D_PSI
    n, k = closed_n(), closed_k()
    assert_equal(u_theta, (n - k) * u, on_solution=True, k=0 if direction == "sideways" else None)


def test_slope_at_the_apex():
    """psi'(0) of the radial solution, the page's limit: put psi = p theta, theta -> 0."""
    p = sp.Symbol("p")
    slope = sp.limit(base_slopes()[1].subs(PSI, p * THETA), THETA, 0)
    solved = sp.solve(sp.Eq(slope, p), p)[0]
    expected = (1 + (1 - 3 * S - 2 * K * S) * SIGMA) / ((2 + 2 * K) * S * SIGMA)
    assert_equal([solved], [expected])
