"""Sweeps of wall friction against single hoppers and against the borders of the domain."""

from math import radians

import numpy as np
import pytest

from hopper import Hopper, friction_limit, linear_stability, solve_radial
from hopper.domain.borders import tangency_friction
from hopper.domain.stability_map import REGIONS, sweep_friction
from hopper.errors import (
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    TangencyError,
    WallFrictionError,
)

HOPPERS = [
    ("cone", 35, 10),
    ("cone", 27, 10),
    ("cone", 30, 30),
    ("cone", 50, 30),
    ("wedge", 25, 10),
    ("wedge", 38, 17),
    ("wedge", 12, 10),
]


def make(geometry, delta, half_angle):
    return Hopper(geometry, radians(delta), radians(half_angle))


def names(sweep):
    return [REGIONS[code] for code in sweep.region]


def verdict(hopper, friction_angle):
    """Region of a single hopper, and its stability if it has one."""
    try:
        found = linear_stability(solve_radial(hopper, friction_angle))
    except TangencyError:
        return "tangent_characteristic", None
    except NoRadialSolutionError:
        return "no_radial_solution", None
    except WallFrictionError:
        return "no_wall_angle", None
    except NonPositiveStressError:
        return "non_positive_stress", None
    return "stable" if found.stable else "unstable", found


# Regions.


def test_each_region_occurs_where_it_must():
    # delta = 33.674 deg is neutral, tangency at 19.3 deg, fold at 29.8 deg.
    found = sweep_friction(make("cone", 33, 10), np.radians([0, 5, 19, 22, 29, 31, 32.9, 33.1]))
    assert names(found) == [
        "unstable",
        "stable",
        "stable",
        "tangent_characteristic",
        "tangent_characteristic",
        "no_radial_solution",
        "no_radial_solution",
        "no_wall_angle",
    ]
    # A smooth wedge needs sin(delta) > 1/3, 19.47 deg, for positive stress.
    found = sweep_friction(make("wedge", 12, 10), np.radians([0, 1, 9, 11.5, 12.1]))
    assert names(found) == [
        "non_positive_stress",
        "non_positive_stress",
        "unstable",
        "tangent_characteristic",
        "no_wall_angle",
    ]
    # Too wide even for a smooth wall.
    found = sweep_friction(make("cone", 40, 70), np.radians([0, 10, 41]))
    assert names(found) == ["no_radial_solution", "no_radial_solution", "no_wall_angle"]


@pytest.mark.parametrize("hopper", HOPPERS)
def test_sweep_agrees_with_single_hoppers(hopper):
    hopper = make(*hopper)
    angles = np.radians(np.linspace(0, 40, 20))
    found = sweep_friction(hopper, angles)
    for i, angle in enumerate(angles):
        name, single = verdict(hopper, angle)
        assert names(found)[i] == name
        values = np.array([found.abscissa[i], found.line[i], found.highest_mode[i]])
        if single is None:
            assert np.isnan([*values, found.error_estimate[i]]).all()
            continue
        highest = single.eigenvalues.real.max()
        expected = [single.abscissa, single.line.abscissa, highest]
        np.testing.assert_allclose(values, expected, rtol=0, atol=1e-9)
        assert 0 < found.error_estimate[i] < 1e-6
        assert found.abscissa[i] == max(found.line[i], found.highest_mode[i])
        assert (name == "stable") == (found.abscissa[i] < 0)
    assert np.isfinite(found.abscissa).any()
    assert np.isnan(found.abscissa).any()


@pytest.mark.parametrize("hopper", HOPPERS)
def test_sweep_does_not_depend_on_its_grid(hopper):
    hopper = make(*hopper)
    angles = np.radians(np.linspace(0, 37.4, 77))
    fine, coarse = sweep_friction(hopper, angles), sweep_friction(hopper, angles[::4])
    single = sweep_friction(hopper, angles[8:9])
    for other, chosen in ((coarse, slice(None, None, 4)), (single, slice(8, 9))):
        np.testing.assert_array_equal(other.region, fine.region[chosen])
        for name in ("abscissa", "line", "highest_mode"):
            values = getattr(other, name), getattr(fine, name)[chosen]
            np.testing.assert_allclose(*values, rtol=0, atol=1e-9)


@pytest.mark.parametrize("hopper", HOPPERS)
def test_regions_end_at_the_borders(hopper):
    hopper = make(*hopper)
    angles = np.radians(np.linspace(0.1, 40.1, 161))
    found = np.array(names(sweep_friction(hopper, angles)))
    tangency, limit = tangency_friction(hopper), friction_limit(hopper)
    assert limit.end in ("fold", "wall")
    verdicts = np.isin(found, ["stable", "unstable", "non_positive_stress"])
    np.testing.assert_array_equal(verdicts, angles < tangency)
    tangent = (angles >= tangency) & (angles <= limit.friction_angle)
    np.testing.assert_array_equal(found == "tangent_characteristic", tangent)
    rough = angles > hopper.delta
    np.testing.assert_array_equal(found == "no_wall_angle", rough)
    beyond = (angles > limit.friction_angle) & ~rough
    np.testing.assert_array_equal(found == "no_radial_solution", beyond)
    assert "not_converged" not in found


@pytest.mark.parametrize("skipped", [[], [0.0], [0.0, 25.0]])
@pytest.mark.parametrize(
    ("delta", "half_angle", "angle"), [(34.54545454545455, 10, 31), (29.454545454545453, 45, 23)]
)
def test_beyond_the_fold_there_is_no_solution_whatever_came_before(
    delta, half_angle, angle, skipped
):
    # Newton's iteration finds something there that does not converge with the mesh.
    angles = np.radians([*(a for a in skipped if a < angle), angle])
    assert names(sweep_friction(make("cone", delta, half_angle), angles))[-1] == (
        "no_radial_solution"
    )


def test_a_limit_that_is_not_resolved_spoils_no_verdicts():
    # The fold of so narrow a cone is not resolved.
    hopper = make("cone", 30, 2)
    angles = np.radians(np.append(np.linspace(0, 20, 60)[:-1], 20))
    found = sweep_friction(hopper, angles)
    tangency = tangency_friction(hopper)
    verdicts = np.isin(names(found), ["stable", "unstable"])
    np.testing.assert_array_equal(verdicts, angles < tangency)


@pytest.mark.parametrize(
    ("geometry", "delta", "half_angle"),
    [("cone", 4, 10), ("cone", 10, 10), ("cone", 27, 10), ("cone", 7, 30), ("wedge", 7, 10)],
)
def test_a_wall_as_rough_as_the_material(geometry, delta, half_angle):
    # phi = delta, to rounding: psi at the wall is singular, and nothing is claimed there.
    hopper = make(geometry, delta, half_angle)
    around = names(sweep_friction(hopper, np.radians([delta - 0.5, delta, delta + 0.5])))
    assert around[1] in ("tangent_characteristic", "no_wall_angle", "not_converged")
    assert around[2] == "no_wall_angle"
    assert around[0] == verdict(hopper, radians(delta - 0.5))[0]


def test_empty_sweeps():
    found = sweep_friction(make("cone", 35, 10), [])
    assert found.region.shape == found.abscissa.shape == (0,)


# Refusals.


@pytest.mark.parametrize("angles", [[0.2, 0.1], [0.1, 0.1], [0.0, 0.2, 0.1]])
def test_angles_that_do_not_increase(angles):
    with pytest.raises(InvalidParameterError, match="must increase: sort and remove repeated ones"):
        sweep_friction(make("cone", 35, 10), angles)


@pytest.mark.parametrize("angles", [[-0.1, 0.1], [0.1, np.pi / 2], [0.1, np.nan], [np.nan]])
def test_angles_out_of_range(angles):
    with pytest.raises(InvalidParameterError, match="friction_angle"):
        sweep_friction(make("cone", 35, 10), angles)


def test_friction_curve_of_the_paper():
    # Figure 4.4: stable throughout at delta = 35 deg in a cone, unstable in a wedge.
    angles = np.arctan(np.linspace(0, 0.35, 8))
    for geometry, expected in (("cone", "stable"), ("wedge", "unstable")):
        found = sweep_friction(make(geometry, 35, 10), angles)
        assert set(names(found)) == {expected}
