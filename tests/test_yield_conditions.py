"""Yield conditions and the wall law, from the stress components."""

from math import acos, asin, atan, degrees, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from hopper import yield_condition
from hopper.errors import InvalidParameterError, WallFrictionError
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.radial import witness

MODELS = {"mohr-coulomb": MOHR_COULOMB, "von-mises": VON_MISES}
PSI = np.linspace(-1.5, 1.5, 61)
each_model = pytest.mark.parametrize("model", MODELS)
each_delta = pytest.mark.parametrize("delta", [radians(d) for d in (3, 20, 45, 80)])


def stress(model, s):
    """Components over sigma by the formulas of the module, with the condition's numbers."""
    law, c2 = MODELS[model], np.cos(2 * PSI)
    rr, tt = 1 - law.radial * s * c2, 1 + law.angular * s * c2
    return rr, tt, -s * np.sin(2 * PSI), 1 + law.hoop * s + law.hoop_cosine * s * c2


@each_model
@each_delta
def test_components_are_the_paper_s(model, delta):
    expected, _ = witness.components(model, sin(delta), PSI)
    np.testing.assert_allclose(stress(model, sin(delta)), expected, rtol=0, atol=1e-15)


@each_delta
def test_mohr_coulomb_stress_satisfies_its_yield_condition(delta):
    rr, tt, rt, pp = stress("mohr-coulomb", sin(delta))
    yielding = (rr - tt) ** 2 + 4 * rt**2 - sin(delta) ** 2 * (rr + tt) ** 2
    assert np.abs(yielding).max() < 4e-15
    # Haar and von Karman: the hoop stress is the major principal stress.
    major = [np.linalg.eigvalsh([[a, c], [c, b]])[1] for a, b, c in zip(rr, tt, rt, strict=True)]
    np.testing.assert_allclose(pp, major, atol=2e-15)


@each_delta
def test_von_mises_stress_satisfies_its_yield_condition(delta):
    rr, tt, rt, pp = stress("von-mises", sin(delta))
    mean = (rr + tt + pp) / 3
    np.testing.assert_allclose(mean, 1, atol=1e-15)
    yielding = (rr - mean) ** 2 + (tt - mean) ** 2 + (pp - mean) ** 2 + 2 * rt**2
    assert np.abs(yielding - 2 * sin(delta) ** 2 * mean**2).max() < 4e-15
    # Levy's flow rule with a radial velocity.
    np.testing.assert_array_equal(tt, pp)


@each_model
@each_delta
@pytest.mark.parametrize("fraction", [0.0, 1e-6, 0.3, 0.9, 0.999])
def test_wall_angle_satisfies_the_law_of_sliding_friction(model, delta, fraction):
    law = MODELS[model]
    phi = fraction * law.largest_friction_angle(delta)
    psi = law.wall_angle(delta, phi)
    (_, tt, rt, _), _ = witness.components(model, sin(delta), psi)
    assert abs(rt + tan(phi) * tt) < 1e-15
    assert law.friction_angle(delta, psi) == pytest.approx(phi, rel=1e-14, abs=1e-15)
    # Close to the steepest psi the root moves as a square root.
    assert psi == pytest.approx(witness.wall_angle(model, sin(delta), phi), abs=2e-13)


def test_wall_angle_formulas_of_the_paper():
    delta, mu = radians(35), 0.2
    phi = atan(mu)
    assert MOHR_COULOMB.wall_angle(delta, phi) == pytest.approx(
        (phi + asin(sin(phi) / sin(delta))) / 2, abs=1e-15
    )
    inclination = atan(mu / sqrt(3))
    assert VON_MISES.wall_angle(delta, phi) == pytest.approx(
        (inclination + asin(sqrt(3) * sin(inclination) / sin(delta))) / 2, abs=1e-15
    )


@each_model
@each_delta
def test_largest_friction_angle_is_the_maximum_over_psi(model, delta):
    s, law = sin(delta), MODELS[model]
    steepest = minimize_scalar(
        lambda psi: -witness.friction_angle(model, s, psi), bounds=(0, pi / 2), method="bounded"
    )
    largest = law.largest_friction_angle(delta)
    # At a maximum an error of 1e-5 in psi is one of 1e-10 in phi.
    assert largest == pytest.approx(-steepest.fun, abs=1e-9)
    assert law.wall_angle(delta, largest) == pytest.approx(steepest.x, abs=1e-4)


@each_delta
def test_largest_mohr_coulomb_friction_is_the_internal_friction(delta):
    assert MOHR_COULOMB.largest_friction_angle(delta) == pytest.approx(delta, rel=1e-14)


@each_model
@each_delta
def test_singular_angle_is_where_the_radial_equations_degenerate(model, delta):
    s, law = sin(delta), MODELS[model]

    def determinant(psi):
        (_, tt, rt, _), (tt_psi, rt_psi) = witness.components(model, s, psi)
        return rt * tt_psi - rt_psi * tt

    singular = law.singular_angle(delta)
    assert abs(determinant(singular)) < 1e-15
    assert np.all(determinant(np.linspace(0, singular - 1e-6, 99)) > 0)
    published = {"mohr-coulomb": pi / 4 + delta / 2, "von-mises": pi / 2 - acos(s / sqrt(3)) / 2}
    assert singular == pytest.approx(published[model], abs=1e-15)
    # The wall as rough as the material is singular itself.
    assert law.wall_angle(delta, law.largest_friction_angle(delta)) == pytest.approx(
        singular, abs=1e-7
    )


@each_model
def test_wall_rougher_than_the_material(model):
    law, delta = MODELS[model], radians(30)
    largest = law.largest_friction_angle(delta)
    law.wall_angle(delta, largest * (1 - 1e-9))
    message = (
        rf"phi = {degrees(largest * 1.0001):.6g} deg has no wall angle: a {law.name} material "
        rf"with delta = 30 deg transmits at most phi = {degrees(largest):.6g} deg; lower phi"
    )
    with pytest.raises(WallFrictionError, match=message):
        law.wall_angle(delta, largest * 1.0001)


@pytest.mark.parametrize("name", MODELS)
def test_condition_by_name(name):
    assert yield_condition(name) is MODELS[name]


@pytest.mark.parametrize("name", ["tresca", "Mohr-Coulomb", "", None, ["mohr-coulomb"]])
def test_unknown_condition(name):
    with pytest.raises(
        InvalidParameterError, match=r"model = .* is unknown: use mohr-coulomb or von-mises"
    ):
        yield_condition(name)
