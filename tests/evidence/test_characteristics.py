"""Characteristics of the full steady equations, against closed forms and another formulation."""

from math import pi, radians, sin, sqrt

import numpy as np
import pytest

from hopper.evidence.characteristics import characteristic_normals, real_characteristics
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES

STATES = [(10, 0.1), (30, 0.0), (30, 0.4), (50, 0.2), (75, 0.0), (75, 0.78)]


def modulo(angles):
    """Angles of directions, which do not tell +e from -e."""
    return np.sort((np.real(angles) + 1e-9) % pi)


@pytest.mark.parametrize(("delta", "psi"), STATES)
def test_mohr_coulomb_in_closed_form(delta, psi):
    # Slip lines of the stress lie pi/4 - delta/2 off the major principal direction, which is psi
    # off the normal to e_r; those of the velocity, of no extension, pi/4 off it.
    major = pi / 2 + psi
    found = characteristic_normals(MOHR_COULOMB, sin(radians(delta)), psi)
    lines = [
        major + sign * angle for sign in (1, -1) for angle in (pi / 4 - radians(delta) / 2, pi / 4)
    ]
    np.testing.assert_allclose(np.abs(found.imag), 0, atol=1e-9)
    np.testing.assert_allclose(modulo(found), modulo(np.array(lines) + pi / 2), atol=1e-8)
    assert real_characteristics(MOHR_COULOMB, sin(radians(delta)), psi) == 4


def other_determinant(s, psi, angle):
    """Determinant for (p, psi, Lode angle, v_r, v_theta) of (2.8)-(2.10), (2.13), (2.14)."""

    def deviator(tilt, lode):
        # Principal deviators of J2 = 1; the first two lie in the plane, tilted by psi.
        first, hoop, second = (
            2 / sqrt(3) * np.cos(lode + shift) for shift in (0, 2 * pi / 3, -2 * pi / 3)
        )
        mean, half = (first + second) / 2, (first - second) / 2
        return np.array(
            [mean - half * np.cos(2 * tilt), mean + half * np.cos(2 * tilt), hoop,
             -half * np.sin(2 * tilt)]
        )  # fmt: skip

    # T_tt = T_pp: the Lode angle of a radial field, given its tilt, by bisection.
    target = np.array([-2 * np.cos(2 * psi), np.cos(2 * psi), np.cos(2 * psi),
                       -sqrt(3) * np.sin(2 * psi)]) / sqrt(3)  # fmt: skip
    mean, half = (target[0] + target[1]) / 2, np.hypot((target[0] - target[1]) / 2, target[3])
    tilt = np.arctan2(-target[3], (target[1] - target[0]) / 2) / 2
    first = mean + half
    lode = np.arccos(first * sqrt(3) / 2)
    lode = min((lode, -lode), key=lambda x: np.abs(deviator(tilt, x) - target).max())
    base = deviator(tilt, lode)
    assert np.abs(base - target).max() < 1e-12
    step = 1e-6
    by_tilt, by_lode = (
        (deviator(tilt + step * a, lode + step * b) - deviator(tilt - step * a, lode - step * b))
        / (2 * step)
        for a, b in ((1, 0), (0, 1))
    )
    xr, xt = np.cos(angle), np.sin(angle)
    matrix = np.zeros((5, 5))
    for column, change in enumerate((np.array([1, 1, 1, 0]) + s * base, s * by_tilt, s * by_lode)):
        rr, tt, _, rt = change
        matrix[:2, column] = xr * rr + xt * rt, xr * rt + xt * tt
    matrix[2, 3:] = xr, xt
    # V0 = base: (2.13) V_pp D_tt = V_tt D_pp and (2.14) V_rt D_tt = V_tt D_rt, linearised.
    matrix[3, 3:] = 0, xt * base[2]
    matrix[4, 3:] = -xt / 2 * base[1], -xr / 2 * base[1] + xt * base[3]
    for column, change in ((1, by_tilt), (2, by_lode)):
        matrix[3, column] = base[2] * change[1] - base[1] * change[2]
        matrix[4, column] = base[3] * change[1] - base[1] * change[3]
    return np.linalg.det(matrix)


@pytest.mark.parametrize(("delta", "psi"), STATES)
def test_von_mises_against_another_formulation(delta, psi):
    s = sin(radians(delta))
    # Both are quartics in the direction: equal up to a factor, so the ratio to a product over the
    # roots is constant.
    normals = characteristic_normals(VON_MISES, s, psi)
    angles = np.linspace(0.05, pi, 23)
    product = np.array([np.prod(np.sin(angle - normals)) for angle in angles])
    other = np.array([other_determinant(s, psi, angle) for angle in angles])
    scale = other[np.argmax(np.abs(product))] / product[np.argmax(np.abs(product))]
    np.testing.assert_allclose(product * scale, other, atol=1e-6 * np.abs(other).max())


def test_von_mises_changes_type():
    s = sin(radians(30))
    assert real_characteristics(VON_MISES, s, 0.0) == 0
    assert real_characteristics(VON_MISES, s, 0.5) == 4
    assert real_characteristics(VON_MISES, sin(radians(75)), 0.0) == 2
