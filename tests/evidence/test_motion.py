"""Stress, strain rate and the laws of section 2, against computer algebra and closed forms."""

from math import atan, degrees, pi, radians, sqrt

import numpy as np
import pytest
import sympy as sp  # type: ignore[import-untyped]

from hopper import Hopper, radial_solutions, solve_radial, solve_velocity
from hopper.errors import InvalidParameterError
from hopper.evidence import motion
from hopper.radial.velocity import decay_exponent
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.stability.witnesses import derived_coefficients, radial


def field(geometry="cone", law=MOHR_COULOMB, mu=0.2, delta=30, half_angle=30):
    return solve_radial(Hopper(geometry, radians(delta), radians(half_angle), law), atan(mu))


def stress_of(solution):
    hopper = solution.hopper
    return motion.stress(hopper.material, hopper.s, solution.sigma, solution.psi)


@pytest.mark.parametrize("k", [0, 1])
def test_strain_rate_by_computer_algebra(k):
    r, theta = sp.symbols("r theta", positive=True)
    u = sp.Function("u")(theta)
    v = -u * r ** (-1 - k)
    # V = -(grad v + grad v^T) / 2 in polar or spherical coordinates, v along r only.
    expected = [-v.diff(r), -v / r, -k * v / r, -v.diff(theta) / r / 2]
    slope = u.diff(theta)
    values = [float(e.subs(slope, 0.7).subs(u, 1.3).subs(r, 1)) for e in expected]
    found = motion.strain_rate(np.array([1.3]), np.array([0.7]), k)
    np.testing.assert_allclose(np.ravel(found), values, rtol=1e-14)
    assert np.sum(found[:3]) == pytest.approx(0, abs=1e-15), "incompressible, (2.3)"


def test_principal_stresses_of_mohr_coulomb_are_closed_form():
    solution = field()
    s, sigma = solution.hopper.s, solution.sigma
    expected = np.stack([sigma * (1 - s), sigma * (1 + s), sigma * (1 + s)], axis=1)
    np.testing.assert_allclose(motion.principal_stresses(stress_of(solution)), expected, rtol=1e-13)


@pytest.mark.parametrize("law", [MOHR_COULOMB, VON_MISES])
def test_a_wrong_stress_does_not_yield(law):
    solution = field(law=law)
    t, s = stress_of(solution), solution.hopper.s
    assert np.abs(motion.yield_residual(law, s, t)).max() < 1e-14
    wrong = t._replace(rt=1.01 * t.rt)
    assert np.abs(motion.yield_residual(law, s, wrong)).max() > 1e-4


@pytest.mark.parametrize(
    ("geometry", "law"), [("cone", MOHR_COULOMB), ("wedge", MOHR_COULOMB), ("cone", VON_MISES)]
)
def test_checks_of_a_field(geometry, law):
    solution = field(geometry, law, mu=0.25)
    check = motion.check_field(solution)
    assert check.exponent == pytest.approx(decay_exponent(solution), rel=1e-12)
    assert check.exponent_spread < 1e-12
    assert check.wall_mu == pytest.approx(0.25, rel=1e-12)
    assert check.hoop_residual < 1e-13
    assert check.psi_max == solution.psi_maximum()[1]
    assert np.isnan(check.ratio_residual) == (law == VON_MISES)


def test_levys_flow_rule():
    solution = field(law=VON_MISES)
    good = motion.levy_factor(solution, solve_velocity(solution))
    assert good.defect < 1e-10
    # chi = sqrt(3) u / (sigma s cos 2psi), by hand from (2.7) and (3.2).
    theta = np.linspace(0, solution.hopper.half_angle, 2001)
    sigma, psi, _, _ = solution.fields(theta)
    u = solve_velocity(solution).at(theta)
    chi = sqrt(3) * u / (sigma * solution.hopper.s * np.cos(2 * psi))
    assert good.least == pytest.approx(chi.min(), rel=1e-4)
    other = solve_velocity(field(law=VON_MISES, mu=0.1))
    assert motion.levy_factor(solution, other).defect > 1e-2
    with pytest.raises(InvalidParameterError, match="Levy's flow rule belongs to model = von"):
        motion.levy_factor(field(), other)


def test_only_von_mises_couples_stress_to_velocity():
    assert motion.velocity_coupling(field(), radial_only=False) == 0
    solution = field(law=VON_MISES)
    assert motion.velocity_coupling(solution, radial_only=True) == 0
    half_angle, theta = solution.hopper.half_angle, solution.theta
    # (2.13) by finite differences.
    step = 1e-7
    v_t = step * np.sin(pi * theta / half_angle)
    dv_t = step * pi / half_angle * np.cos(pi * theta / half_angle)
    ratio = (-1 + v_t / np.tan(theta)) / (dv_t - 1)
    expected = np.abs(ratio - 1).max() / step
    found = motion.velocity_coupling(solution, radial_only=False)
    assert found == pytest.approx(expected, rel=1e-5)
    assert found > 1


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_linearised_agrees_with_computer_algebra(geometry):
    solution = radial(geometry, 38, 17, 0.12)
    theta = np.linspace(0.2, 1, 9) * solution.hopper.half_angle
    found = motion.linearised(solution, theta, solution.hopper.curvature)
    for mine, derived in zip(found, derived_coefficients(solution, theta), strict=True):
        assert np.abs(mine - derived).max() < 1e-12 * np.abs(derived).max()


def test_the_number_of_solutions():
    hopper = Hopper("cone", radians(30), radians(30))
    assert [len(radial_solutions(hopper, atan(mu))) for mu in (0, 0.2, 0.356)] == [1, 1, 2]
    first, second = radial_solutions(hopper, atan(0.356))
    assert (first.branch, second.branch) == ("physical", "second")
    assert first.sigma_axis > second.sigma_axis
    for solution in (first, second):
        assert motion.check_field(solution).wall_mu == pytest.approx(0.356, rel=1e-10)
    assert degrees(second.psi_maximum()[1]) > 45
    von_mises = Hopper("cone", radians(30), radians(30), VON_MISES)
    assert len(radial_solutions(von_mises, atan(0.356))) == 1
