"""Sweeps of wall friction against single hoppers and against the limits of the family."""

from functools import cache
from math import radians

import numpy as np
import pytest

from hopper import Hopper, friction_limit, linear_stability, solve_radial
from hopper.domain.stability_map import GOVERNED_BY, PARITY, REGIONS, sweep_friction
from hopper.errors import (
    ConvergenceError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    WallFrictionError,
)
from hopper.problem import Geometry
from hopper.stability.collocation import PARITIES
from tests.stability.tilted_data import as_complex, read

HOPPERS = [
    ("cone", 35, 10),
    ("cone", 27, 10),
    ("cone", 30, 30),
    ("wedge", 25, 10),
    ("wedge", 38, 17),
    ("wedge", 12, 10),
]
ANGLES = np.radians(np.linspace(0.1, 40.1, 81))
VERDICTS = ["stable", "stable_symmetric_only", "unstable"]


def make(geometry, delta, half_angle):
    return Hopper(geometry, radians(delta), radians(half_angle))


def names(sweep):
    return [REGIONS[code] for code in sweep.region]


@cache
def swept(hopper):
    return sweep_friction(make(*hopper), ANGLES)


def verdict(hopper, friction_angle):
    """Region of a single hopper, its stability and its solution if it has them."""
    try:
        solution = solve_radial(hopper, friction_angle)
        found = linear_stability(solution)
    except NoRadialSolutionError:
        return "no_radial_solution", None, None
    except WallFrictionError:
        return "no_wall_angle", None, None
    except NonPositiveStressError:
        return "non_positive_stress", None, None
    except ConvergenceError:
        return "not_converged", None, None
    name = "stable" if found.stable else "unstable"
    return (
        "stable_symmetric_only" if name != "stable" and found.symmetric[0] < 0 else name,
        (found),
        solution,
    )


# Regions.


def test_each_region_occurs_where_it_must():
    # delta = 33.674 deg is neutral, the fold is at 29.8 deg; nothing happens at the tangency, 19.3.
    found = sweep_friction(make("cone", 33, 10), np.radians([0, 5, 19, 22, 29, 31, 32.9, 33.1]))
    assert names(found) == [
        "unstable",
        *4 * ["stable"],
        "no_radial_solution",
        "no_radial_solution",
        "no_wall_angle",
    ]
    # A smooth wedge needs sin(delta) > 1/3, 19.47 deg, for positive stress.
    found = sweep_friction(make("wedge", 12, 10), np.radians([0, 1, 9, 11.5, 12.1]))
    assert names(found) == [*2 * ["non_positive_stress"], *2 * ["unstable"], "no_wall_angle"]
    found = sweep_friction(make("wedge", 40, 20), np.radians([25, 39.5]))
    assert names(found) == ["stable_symmetric_only", "unstable"]
    # Too wide even for a smooth wall.
    found = sweep_friction(make("cone", 40, 70), np.radians([0, 10, 41]))
    assert names(found) == ["no_radial_solution", "no_radial_solution", "no_wall_angle"]


@pytest.mark.parametrize(
    ("seed", "number"), [(23, 12), pytest.param(24, 400, marks=pytest.mark.soak)]
)
def test_errors_of_sweeps_cover_in_random_hoppers(seed, number):
    """Against modes on finer meshes, to a five-hundredth of the error that sweeps ask for."""
    rng = np.random.default_rng(seed)
    covered = []
    for _ in range(number):
        geometry: Geometry = "cone" if rng.random() < 0.5 else "wedge"
        hopper = Hopper(geometry, rng.uniform(0.1, 1.05), np.exp(rng.uniform(-3.9, -0.16)))
        sweep = sweep_friction(hopper, np.sort(rng.uniform(0, 0.75, 12)))
        for i in np.flatnonzero(np.isfinite(sweep.abscissa)):
            try:
                solution = solve_radial(hopper, sweep.friction_angle[i])
                single = linear_stability(solution, tolerance=1e-12)
            except ConvergenceError:  # by one of the two ways, next to the limit
                continue
            error = sweep.error_estimate[i] + single.error_estimate
            covered.append(abs(sweep.abscissa[i] - single.abscissa) <= error)
    assert len(covered) > 5 * number
    assert np.mean(covered) >= 0.999


@pytest.mark.parametrize("hopper", HOPPERS)
def test_sweep_agrees_with_single_hoppers(hopper):
    found, regions = swept(hopper), names(swept(hopper))
    for i in range(0, ANGLES.size, 6):
        name, single, solution = verdict(make(*hopper), ANGLES[i])
        assert regions[i] == name
        values = np.array([found.abscissa[i], found.symmetric[i], found.line[i]])
        if single is None:
            assert np.isnan([*values, found.error_estimate[i], found.psi_max[i]]).all()
            assert found.governed_by[i] == found.parity[i] == 0
            continue
        expected = [single.abscissa, single.symmetric[0], single.line.abscissa]
        np.testing.assert_allclose(values, expected, rtol=0, atol=found.error_estimate[i] + 1e-9)
        if single.asymmetric is None:
            assert np.isnan(found.asymmetric[i])
        else:
            assert found.asymmetric[i] == pytest.approx(
                single.asymmetric[0], abs=found.error_estimate[i] + 1e-9
            )
        assert 0 < found.error_estimate[i] < 1e-5
        assert GOVERNED_BY[found.governed_by[i]] == single.governed_by
        assert PARITY[found.parity[i]] == (single.parity or "none")
        assert found.abscissa[i] == np.nanmax([found.symmetric[i], found.asymmetric[i]])
        assert found.abscissa[i] >= found.line[i]
        # On the nodes only: those of the single one are as many.
        assert found.psi_max[i] == pytest.approx(solution.psi_maximum()[1], abs=1e-9)
    assert np.isfinite(found.abscissa).any()
    assert np.isnan(found.abscissa).any()


@pytest.mark.parametrize("hopper", HOPPERS)
def test_sweep_does_not_depend_on_its_grid(hopper):
    fine = swept(hopper)
    coarse, single = (sweep_friction(make(*hopper), ANGLES[i]) for i in (slice(None, None, 9), [8]))
    for other, chosen in ((coarse, slice(None, None, 9)), (single, [8])):
        for name in ("region", "governed_by", "parity"):
            np.testing.assert_array_equal(getattr(other, name), getattr(fine, name)[chosen])
        tolerance = np.nan_to_num(fine.error_estimate[chosen] + other.error_estimate) + 1e-9
        for name in ("abscissa", "symmetric", "asymmetric", "line"):
            values, expected = getattr(other, name), getattr(fine, name)[chosen]
            np.testing.assert_array_equal(np.isnan(values), np.isnan(expected))
            # Those that do not govern are known to 1e-5.
            loose = 0 if name == "abscissa" else 1e-5 * np.maximum(1, np.abs(expected))
            assert np.all(~(np.abs(values - expected) > tolerance + loose))


@pytest.mark.parametrize("hopper", HOPPERS)
def test_regions_end_at_the_limit_of_friction(hopper):
    """Verdicts everywhere up to it, but for less than half a percent of delta or so before it."""
    found = np.array(names(swept(hopper)))
    limit = friction_limit(make(*hopper))
    assert limit.end in ("fold", "wall")
    known = np.isin(found, [*VERDICTS, "non_positive_stress"])
    below = limit.friction_angle > ANGLES
    assert not known[~below].any()
    assert np.all(known[limit.friction_angle - radians(0.3) > ANGLES])
    assert set(found[below & ~known]) <= {"not_converged"}
    rough = radians(hopper[1]) < ANGLES
    np.testing.assert_array_equal(found == "no_wall_angle", rough)
    beyond = (limit.friction_angle < ANGLES) & ~rough
    np.testing.assert_array_equal(found == "no_radial_solution", beyond)


CASES = [
    case
    for case in read("tilted_reference")
    if case["branch"] == "physical" and case["geometry"] == "wedge"
]


@pytest.mark.parametrize("case", CASES[::3], ids=lambda c: f"{c['delta_deg']}-{c['phi_deg']:.4g}")
def test_parities_of_wedges_by_shooting(case):
    """Both suprema, what governs and its parity, for hoppers on their own."""
    hopper = make("wedge", case["delta_deg"], case["half_angle_deg"])
    found = sweep_friction(hopper, [radians(case["phi_deg"])])
    shot = {parity: as_complex(case[parity]).real.max() for parity in PARITIES}
    for parity, highest in shot.items():
        supremum = max(highest, case["line"])
        loose = 1e-5 * max(1, abs(supremum))
        assert getattr(found, parity)[0] == pytest.approx(supremum, abs=loose)
    assert found.line[0] == pytest.approx(case["line"], abs=1e-8)
    highest = max(case["line"], *shot.values())
    assert abs(found.abscissa[0] - highest) <= found.error_estimate[0] + 1e-11
    governor = max(PARITIES, key=lambda parity: shot[parity])
    assert PARITY[found.parity[0]] == ("none" if highest == case["line"] else governor)


def test_symmetric_disturbances_only():
    found = sweep_friction(make("wedge", 40, 20), np.radians([10, 25]), "symmetric")
    assert names(found) == ["stable", "stable"]
    assert np.isnan(found.asymmetric).all()
    np.testing.assert_array_equal(found.abscissa, found.symmetric)
    assert "asymmetric" not in [PARITY[code] for code in found.parity]


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
    angles = np.radians(np.linspace(0, 29, 30))
    found = names(sweep_friction(make("cone", 30, 2), angles))
    assert set(found[:25]) <= set(VERDICTS)


def test_no_verdict_by_modes_that_are_not_resolved():
    """psi is singular inside at 23.74 degrees: modes crowd before, and nothing is claimed."""
    found = names(sweep_friction(make("cone", 25, 30), np.radians([20, 23.45, 23.7, 23.9])))
    assert found == ["unstable", "not_converged", "not_converged", "no_radial_solution"]


@pytest.mark.parametrize(
    ("geometry", "delta", "half_angle"),
    [("cone", 4, 10), ("cone", 10, 10), ("cone", 27, 10), ("cone", 7, 30), ("wedge", 7, 10)],
)
def test_a_wall_as_rough_as_the_material(geometry, delta, half_angle):
    # phi = delta, to rounding: psi at the wall is singular, and nothing is claimed there.
    hopper = make(geometry, delta, half_angle)
    around = names(sweep_friction(hopper, np.radians([delta - 0.5, delta, delta + 0.5])))
    assert around[1] in ("no_wall_angle", "not_converged", "no_radial_solution")
    assert around[2] == "no_wall_angle"
    assert around[0] == verdict(hopper, radians(delta - 0.5))[0]


def test_empty_sweeps():
    found = sweep_friction(make("cone", 35, 10), [])
    assert found.region.shape == found.abscissa.shape == found.psi_max.shape == (0,)


def test_friction_curve_of_the_paper():
    # Figure 4.4: stable throughout at delta = 35 deg in a cone, unstable in a wedge.
    angles = np.arctan(np.linspace(0, 0.35, 8))
    for geometry, expected in (("cone", "stable"), ("wedge", "unstable")):
        found = sweep_friction(make(geometry, 35, 10), angles)
        assert set(names(found)) == {expected}


def test_abscissa_falls_and_rises_to_zero_at_the_fold():
    """Cone 35/10, as the paper says of its Figure 4.4; Re(lambda) goes like the root there."""
    hopper = make("cone", 35, 10)
    limit = friction_limit(hopper).friction_angle
    distance = np.array([0.2, 1e-2, 1e-4, 1e-6, 1e-8])
    found = sweep_friction(hopper, [0.0, *(limit * (1 - distance))])
    assert found.abscissa[0] > found.abscissa[1] < found.abscissa[2] < found.abscissa[3] < 0
    order = np.log(found.abscissa[4] / found.abscissa[5]) / np.log(100)
    assert order == pytest.approx(0.5, abs=0.02)
    assert [GOVERNED_BY[code] for code in found.governed_by[4:]] == 2 * ["real mode"]


# Refusals.


@pytest.mark.parametrize("angles", [[0.2, 0.1], [0.1, 0.1], [0.0, 0.2, 0.1]])
def test_angles_that_do_not_increase(angles):
    with pytest.raises(InvalidParameterError, match="must increase: sort and remove repeated ones"):
        sweep_friction(make("cone", 35, 10), angles)


@pytest.mark.parametrize("angles", [[-0.1, 0.1], [0.1, np.pi / 2], [0.1, np.nan], [np.nan]])
def test_angles_out_of_range(angles):
    with pytest.raises(InvalidParameterError, match="friction_angle"):
        sweep_friction(make("cone", 35, 10), angles)


def test_cones_know_symmetric_disturbances_only():
    with pytest.raises(InvalidParameterError, match="singular at the apex of a cone"):
        sweep_friction(make("cone", 35, 10), [0.1], "any")
