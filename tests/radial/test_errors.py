"""Every bad input is refused with a typed, one-line message that says what to change."""

import re
from math import atan, degrees, inf, nan, pi, radians, tan

import numpy as np
import pytest

from hopper import (
    Hopper,
    friction_limit,
    mass_flow_half_angle,
    solve_radial,
    solve_radial_family,
    solve_velocity,
)
from hopper.errors import (
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    WallFrictionError,
)
from hopper.problem import as_geometry
from hopper.radial.mass_flow import limiting_fields, limiting_wall_angle, mass_flow_friction_angle
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES
from tests.radial import witness

CONE = Hopper("cone", radians(30), radians(30))


def make(geometry, delta, half_angle, material=MOHR_COULOMB):
    return Hopper(geometry, radians(delta), radians(half_angle), material)


def raised(error, function, *arguments, **options):
    """Return the error that a call raises, checked to be one line."""
    with pytest.raises(error) as caught:
        function(*arguments, **options)
    assert type(caught.value) is error
    assert "\n" not in str(caught.value)
    return caught.value


# --- no wall angle -------------------------------------------------------------------------------


@pytest.mark.parametrize("branch", ["physical", "second"])
@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_wall_rougher_than_the_material(geometry, branch):
    hopper = make(geometry, 30, 10)
    error = raised(WallFrictionError, solve_radial, hopper, radians(31), branch)
    assert str(error) == (
        "wall friction angle phi = 31 deg has no wall angle: a Mohr-Coulomb material with delta = "
        "30 deg transmits at most phi = 30 deg; lower phi (or mu) or raise delta"
    )


def test_wall_rougher_than_the_material_von_mises():
    error = raised(WallFrictionError, solve_radial, make("cone", 30, 10, VON_MISES), radians(28))
    assert "a von Mises material with delta = 30 deg transmits at most phi = 27.575 deg" in str(
        error
    )


# --- beyond the largest friction -----------------------------------------------------------------


@pytest.mark.parametrize("branch", ["physical", "second"])
@pytest.mark.parametrize(
    ("delta", "half_angle", "excess"),
    [
        (30, 30, 1e-6),
        (30, 30, 1e-3),
        (30, 30, 0.1),
        (40, 15, 1e-2),
        (27.43, 29.97, 0.05),
        (29.7, 6.7, 1e-4),
        (33.4, 6.2, 1e-3),
        (45, 6, 1e-2),
    ],
)
def test_friction_beyond_the_fold(delta, half_angle, excess, branch):
    hopper = make("cone", delta, half_angle)
    fold = friction_limit(hopper)
    assert fold.end == "fold"
    phi = fold.friction_angle + excess
    if phi < hopper.delta:
        error = raised(NoRadialSolutionError, solve_radial, hopper, phi, branch)
        assert str(error) == (
            f"no radial solution at phi = {degrees(phi):.6g} deg (mu = {tan(phi):.6g}): the "
            f"largest friction that has one is phi = {degrees(fold.friction_angle):.6g} deg "
            f"(mu = {tan(fold.friction_angle):.6g}), the family of solutions folds there; "
            "lower the wall friction"
        )
        assert error.largest_friction_angle == fold.friction_angle


def test_friction_of_figure_3_2_beyond_the_fold():
    error = raised(NoRadialSolutionError, solve_radial, CONE, atan(0.36))
    assert "largest friction that has one is phi = 19.7406 deg (mu = 0.358852)" in str(error)


def test_friction_beyond_the_mass_flow_limit():
    hopper = make("cone", 60, 10)
    limit = mass_flow_friction_angle(hopper)
    error = raised(NoRadialSolutionError, solve_radial, hopper, limit + 0.01)
    assert f"phi = {degrees(limit):.6g} deg" in str(error)
    assert "the stress on the axis vanishes there; lower the wall friction" in str(error)
    assert error.largest_friction_angle == pytest.approx(limit, abs=1e-6)


def test_friction_beyond_an_interior_singularity():
    hopper = make("cone", 50, 45, VON_MISES)
    error = raised(NoRadialSolutionError, solve_radial, hopper, radians(15))
    assert "psi reaches its singular angle inside the hopper there" in str(error)


INTERIOR = [
    make("cone", 24.8, 30),
    make("cone", 25.4, 30),
    make("cone", 25, 45),
    make("cone", 50, 45, VON_MISES),
    make("cone", 45, 45, VON_MISES),
    make("cone", 40, 45, VON_MISES),
]


@pytest.mark.parametrize("hopper", INTERIOR)
def test_interior_limit_separates_the_trajectories_of_the_witness(hopper):
    limit = friction_limit(hopper)
    assert limit.end == "interior"
    assert limit.error_estimate < 1e-9
    (model, k, s), wall = witness.describe(hopper), np.array([hopper.half_angle])
    reached = []
    for distance in (1e-3, 1e-5, 1e-7, 1e-9):
        tau = limit.tau * (1 - distance)
        _, psi = witness.shoot(model, k, s, 1 / tau, wall, 1e-11)
        reached.append(witness.friction_angle(model, s, psi[0]))
    # The closer to the saddle, the closer at the wall: by a power of the distance in tau, the
    # ratio of the saddle's rates.
    missing = limit.friction_angle - np.array(reached)
    assert np.all(missing > 0)
    factors = missing[1:] / missing[:-1]
    assert np.all(factors < 0.9)
    assert abs(factors[2] - factors[1]) < abs(factors[1] - factors[0]) + 1e-3
    # The slightest excess of tau drives psi into its singular angle inside the hopper.
    with pytest.raises(AssertionError):
        witness.shoot(model, k, s, 1 / (limit.tau * (1 + 1e-9)), wall, 1e-11)


@pytest.mark.parametrize("hopper", INTERIOR)
def test_critical_point_is_the_same_in_every_wider_hopper(hopper):
    wider = Hopper("cone", hopper.delta, hopper.half_angle + radians(3), hopper.material)
    assert friction_limit(wider).tau == pytest.approx(friction_limit(hopper).tau, rel=1e-9)


@pytest.mark.parametrize(("delta", "half_angle", "phi"), [(24.2, 30, 23), (24.6, 30, 23)])
def test_wall_is_the_limit_where_there_is_no_critical_point(delta, half_angle, phi):
    hopper = make("cone", delta, half_angle)
    limit = friction_limit(hopper)
    assert limit.end == "wall"
    assert limit.friction_angle == pytest.approx(radians(delta), rel=1e-12)
    assert solve_radial(hopper, radians(phi)).error_estimate < 1e-6


@pytest.mark.parametrize(
    ("hopper", "phi"),
    [
        (CONE, radians(10)),  # below the mass-flow limit
        (make("wedge", 35, 10), radians(10)),
        (make("cone", 30, 30, VON_MISES), radians(10)),
    ],
)
def test_no_second_solution(hopper, phi):
    error = raised(NoRadialSolutionError, solve_radial, hopper, phi, "second")
    assert f"phi = {degrees(phi):.6g} deg has no second solution" in str(error)
    assert "use branch = physical" in str(error)
    assert error.largest_friction_angle == friction_limit(hopper).friction_angle


@pytest.mark.parametrize(("delta", "half_angle"), [(70, 60), (70, 50), (36.75, 58)])
def test_hopper_too_wide_for_a_smooth_wall(delta, half_angle):
    hopper = make("cone", delta, half_angle)
    message = (
        f"no radial solution at half_angle = {half_angle:.6g} deg, delta = {delta:.6g} deg, "
        "even for a smooth wall: lower half_angle"
    )
    for function, arguments in (
        (solve_radial, (hopper, 0.0)),
        (solve_radial, (hopper, 0.1)),
        (solve_radial, (hopper, 0.0, "second")),
        (solve_radial_family, (hopper, 0.1)),
        (friction_limit, (hopper,)),
    ):
        error = raised(NoRadialSolutionError, function, *arguments)
        assert str(error) == message
        assert error.largest_friction_angle is None
    # Over the whole family, shot outwards, psi is negative at the wall.
    model, k, s = witness.describe(hopper)
    theta = np.linspace(0.01, hopper.half_angle, 100)
    for sigma_axis in np.geomspace(1 / (5 * s - 1), 1e-3, 15):
        assert witness.shoot(model, k, s, sigma_axis, theta)[1, -1] < -0.04


def test_hopper_just_narrow_enough_for_a_smooth_wall():
    assert solve_radial(make("cone", 70, 45), 0.0).sigma_axis > 0


# --- stress that is not positive -----------------------------------------------------------------

SMOOTH_BOUNDS = [
    ("wedge", MOHR_COULOMB, degrees(np.arcsin(1 / 3))),
    ("cone", MOHR_COULOMB, degrees(np.arcsin(1 / 5))),
    # psi = 0 and uniform stress solve the equations without gravity at 1 = 8 s / sqrt(3).
    ("cone", VON_MISES, degrees(np.arcsin(np.sqrt(3) / 8))),
]


@pytest.mark.parametrize(("geometry", "material", "bound"), SMOOTH_BOUNDS)
@pytest.mark.parametrize("half_angle", [5, 25, 45])
def test_least_internal_friction_of_a_smooth_wall(geometry, material, bound, half_angle):
    above = solve_radial(make(geometry, bound + 1e-3, half_angle, material), 0.0)
    assert above.sigma.min() > 0
    assert above.sigma_axis > 100
    below = make(geometry, bound - 1e-3, half_angle, material)
    error = raised(NonPositiveStressError, solve_radial, below, 0.0)
    assert "average stress is not positive at phi = 0 deg" in str(error)
    assert f"a smooth wall needs delta > {bound:.4f} deg" in str(error)
    assert str(error).endswith("raise delta")


@pytest.mark.parametrize(
    ("geometry", "material", "delta", "half_angle"),
    [
        ("wedge", MOHR_COULOMB, 15, 10),
        ("wedge", MOHR_COULOMB, 18, 40),
        ("cone", MOHR_COULOMB, 10, 20),
        ("cone", VON_MISES, 10, 20),
    ],
)
def test_least_wall_friction_of_a_weak_material(geometry, material, delta, half_angle):
    hopper = make(geometry, delta, half_angle, material)
    error = raised(NonPositiveStressError, solve_radial, hopper, 0.0)
    named = re.search(r"this delta needs phi > ([0-9.]+) deg", str(error))
    assert named is not None
    phi = radians(float(named[1]))
    assert solve_radial(hopper, phi * (1 + 1e-4)).sigma.min() > 0
    raised(NonPositiveStressError, solve_radial, hopper, phi * (1 - 1e-4))


@pytest.mark.parametrize(
    ("geometry", "material", "delta", "half_angle"),
    [("wedge", MOHR_COULOMB, 8, 50), ("cone", MOHR_COULOMB, 6, 59), ("cone", VON_MISES, 5, 68)],
)
@pytest.mark.parametrize("fraction", [0.0, 0.5, 0.9])
def test_material_too_weak_for_any_wall(geometry, material, delta, half_angle, fraction):
    hopper = make(geometry, delta, half_angle, material)
    phi = fraction * material.largest_friction_angle(hopper.delta)
    error = raised(NonPositiveStressError, solve_radial, hopper, phi)
    assert "average stress is not positive" in str(error)
    assert "raise delta" in str(error)


# --- values out of range and of the wrong type ---------------------------------------------------

NOT_AN_ANGLE = [nan, inf, -inf, -0.1, pi / 2, 30.0]
NOT_A_NUMBER = ["0.5", None, 1j, [0.5, 0.6], np.array([0.5, 0.6])]


@pytest.mark.parametrize("name", ["delta", "half_angle"])
@pytest.mark.parametrize("value", [*NOT_AN_ANGLE, 0.0])
def test_hopper_angle_out_of_range(name, value):
    angles = {"delta": 0.5, "half_angle": 0.5, name: value}
    error = raised(InvalidParameterError, Hopper, "cone", **angles)
    assert str(error) == (
        f"{name} = {degrees(value):.6g} deg is out of range: it must lie in (0, 90) deg"
    )


@pytest.mark.parametrize("name", ["delta", "half_angle"])
@pytest.mark.parametrize("value", NOT_A_NUMBER)
def test_hopper_angle_of_the_wrong_type(name, value):
    angles = {"delta": 0.5, "half_angle": 0.5, name: value}
    error = raised(InvalidParameterError, Hopper, "cone", **angles)
    assert re.fullmatch(rf"{name} = .* is not a number: give radians", str(error))


def test_angles_may_be_numpy_scalars_and_integers():
    assert Hopper("cone", np.float64(0.5), 1) == Hopper("cone", 0.5, 1.0)


@pytest.mark.parametrize("geometry", ["Cone", "slot", "", None, 3, ["cone"]])
def test_unknown_geometry(geometry):
    for function, arguments in ((Hopper, (geometry, 0.5, 0.5)), (as_geometry, (geometry,))):
        error = raised(InvalidParameterError, function, *arguments)
        assert str(error) == f"geometry = {geometry!r} is unknown: use wedge or cone"


def test_geometry_by_name():
    assert [as_geometry(name) for name in ("wedge", "cone")] == ["wedge", "cone"]


@pytest.mark.parametrize("material", ["von-mises", None, 3])
def test_material_of_the_wrong_type(material):
    error = raised(InvalidParameterError, Hopper, "cone", 0.5, 0.5, material)
    assert str(error).startswith("material = ")


def test_von_mises_wedge():
    error = raised(InvalidParameterError, Hopper, "wedge", 0.5, 0.5, VON_MISES)
    assert str(error) == ("model = von-mises is formulated for cones only: use geometry = cone")


@pytest.mark.parametrize("function", [solve_radial, mass_flow_half_angle])
@pytest.mark.parametrize("phi", NOT_AN_ANGLE)
def test_friction_angle_out_of_range(function, phi):
    error = raised(InvalidParameterError, function, CONE, phi)
    assert str(error) == (
        f"friction_angle = {degrees(phi):.6g} deg is out of range: it must lie in [0, 90) deg"
    )


@pytest.mark.parametrize("function", [solve_radial, mass_flow_half_angle])
@pytest.mark.parametrize("phi", NOT_A_NUMBER)
def test_friction_angle_of_the_wrong_type(function, phi):
    error = raised(InvalidParameterError, function, CONE, phi)
    assert re.fullmatch(r"friction_angle = .* is not a number: give radians", str(error))


@pytest.mark.parametrize("branch", ["Physical", "first", "", None, 2, ["second"]])
def test_unknown_branch(branch):
    error = raised(InvalidParameterError, solve_radial, CONE, 0.1, branch)
    assert str(error) == f"branch = {branch!r} is unknown: use one of physical, second, third"


@pytest.mark.parametrize("sigma_axis", [nan, inf, 0.0, -1.0, *NOT_A_NUMBER])
def test_axis_stress_that_is_not_a_positive_number(sigma_axis):
    error = raised(InvalidParameterError, solve_radial_family, CONE, sigma_axis)
    assert re.fullmatch(r"sigma_axis = .* must be a positive number", str(error))


@pytest.mark.parametrize("factor", [1.01, 10, 1e6])
def test_axis_stress_above_that_of_a_smooth_wall(factor):
    smooth = solve_radial(CONE, 0.0).sigma_axis
    error = raised(NoRadialSolutionError, solve_radial_family, CONE, factor * smooth)
    assert f"1 / sigma_axis must be at least {1 / smooth:.6g} (smooth wall)" in str(error)
    assert solve_radial_family(CONE, smooth / 1.01).friction_angle > 0


SOLUTION = solve_radial(CONE, 0.1)
THETA_TAKERS = [SOLUTION.fields, SOLUTION.psi_at, solve_velocity(SOLUTION).at]


@pytest.mark.parametrize("function", THETA_TAKERS)
@pytest.mark.parametrize("theta", [0.6, -0.6, [0.1, 0.53], nan, [0.1, inf], "wall", None, 1j])
def test_angle_outside_the_hopper(function, theta):
    error = raised(InvalidParameterError, function, theta)
    assert "theta" in str(error)


@pytest.mark.parametrize("theta", [0.0, [0.1, -0.1], nan, inf, "wall", None])
def test_angle_at_which_the_limiting_fields_do_not_exist(theta):
    error = raised(InvalidParameterError, limiting_fields, CONE, theta)
    assert "theta" in str(error)


@pytest.mark.parametrize(
    ("function", "argument"),
    [
        (limiting_fields, 0.1),
        (limiting_wall_angle, None),
        (mass_flow_friction_angle, None),
        (mass_flow_half_angle, 0.1),
    ],
)
def test_mass_flow_limit_of_other_hoppers(function, argument):
    arguments = () if argument is None else (argument,)
    for hopper in (make("wedge", 40, 20), make("cone", 40, 20, VON_MISES)):
        error = raised(InvalidParameterError, function, hopper, *arguments)
        assert str(error) == (
            "the mass-flow limit is known in closed form for Mohr-Coulomb cones only: "
            "use geometry = cone and model = mohr-coulomb"
        )
    error = raised(InvalidParameterError, function, make("cone", 19.4, 20), *arguments)
    assert str(error) == (
        "delta = 19.4 deg has no mass-flow limit: it needs delta >= 19.4712 deg (sin delta >= 1/3)"
    )


def test_mass_flow_half_angle_of_a_wall_rougher_than_the_material():
    error = raised(WallFrictionError, mass_flow_half_angle, CONE, radians(31))
    assert "transmits at most phi = 30 deg" in str(error)
