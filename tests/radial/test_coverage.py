"""Errors that cover: random hoppers against an independent solution in extended precision."""

from math import floor, log10, radians

import numpy as np
import pytest

from hopper import Hopper, friction_limit, solve_radial
from hopper.errors import NoRadialSolutionError
from hopper.problem import Geometry
from hopper.radial.mass_flow import mass_flow_friction_angle
from hopper.radial.pieces import has_mass_flow_limit
from tests.radial import random_hoppers, taylor
from tests.reliability import Figure, record


def coverage(name, seed, sample):
    """Return the part of the solutions whose error the claim covers; record it by distance."""
    claim = np.array([solution.error_estimate for solution in sample.solutions])
    error = random_hoppers.errors(sample.solutions)
    decided = np.isfinite(error)
    covered = error <= claim
    decade = np.array([floor(log10(distance)) for distance in sample.distances])
    print(f"seed {seed}: {claim.size} solutions, {sample.refused} not resolved")
    found: dict[str, Figure] = {
        "seed": seed, "solutions": claim.size, "hoppers not resolved": sample.refused
    }  # fmt: skip
    for one in np.unique(decade):
        here = (decade == one) & decided
        undecided = np.sum((decade == one) & ~decided)
        words = f"{covered[here].sum()} of {here.sum()}, undecided {undecided}"
        print(f"  1e{one}: {words}")
        found[f"covered at a distance of 1e{one} to 1e{one + 1} from the limit"] = words
    for i in np.flatnonzero(decided & ~covered):
        print(f"  not covered: {sample.solutions[i]!r}, true error {error[i]:.2g}")
    assert decided.mean() > 0.9
    if claim.size > _MANY:
        record(name, _WHAT, found)
    return covered[decided].mean()


_MANY = 100
_WHAT = (
    "Error estimates of radial solutions against solutions by Taylor series in 80-bit arithmetic, "
    "by the distance of the wall friction from its limit, relative to it."
)


@pytest.mark.parametrize(
    ("seed", "number"), [(1601, 15), pytest.param(1602, 1100, marks=pytest.mark.soak)]
)
def test_errors_cover_in_random_hoppers(seed, number):
    rng = np.random.default_rng(seed)
    chosen = list(random_hoppers.hoppers(rng, number))
    sample = random_hoppers.solve(chosen, 1 - rng.uniform(0, 1, number))
    assert coverage("errors_of_random_hoppers", seed, sample) >= 0.99
    assert sample.refused <= 0.02 * number


# Grids with and without points at a kink took turns in the first three; sigma_0 is large in others.
FOUND: list[tuple[Geometry, float, float, float]] = [
    ("wedge", 62.6099, 53.8004, 47.9143), ("wedge", 59.7916, 33.2542, 52.6624),
    ("cone", 23.5952, 40.4961, 20.4013), ("wedge", 15.0377, 27.6323, 6.1916),
    ("wedge", 15.6837, 14.2028, 2.45916), ("wedge", 16.7073, 38.6706, 5.2245),
]  # fmt: skip


def test_errors_cover_where_random_hoppers_once_exceeded_them():
    solutions = [
        solve_radial(Hopper(geometry, radians(delta), radians(half_angle)), radians(phi))
        for geometry, delta, half_angle, phi in FOUND
    ]
    claim = np.array([solution.error_estimate for solution in solutions])
    assert np.all(random_hoppers.errors(solutions) <= claim)
    assert claim.max() < 1e-12


@pytest.mark.parametrize(
    ("seed", "number", "kinds"),
    [
        (1603, 12, ("cone",)),
        pytest.param(1604, 350, tuple(random_hoppers.KINDS), marks=pytest.mark.soak),
    ],
)
def test_errors_cover_next_to_the_limit(seed, number, kinds):
    rng = np.random.default_rng(seed)
    chosen = list(random_hoppers.hoppers(rng, number, kinds))
    sample = random_hoppers.solve(chosen, 10 ** rng.uniform(-10, -3, number))
    assert coverage("errors_next_to_the_limit", seed, sample) >= 0.95
    # Where psi is singular inside von Mises cones, kinks as sharp as that are not resolved.
    assert sample.refused <= 0.15 * number


@pytest.mark.parametrize(
    ("seed", "number"), [(1605, 12), pytest.param(1606, 2000, marks=pytest.mark.soak)]
)
def test_limits_of_random_cones(seed, number):
    """Folds lie where shooting has them, and no member needs more friction than the limit."""
    print(f"seed {seed}")
    limits = []
    for hopper in random_hoppers.hoppers(np.random.default_rng(seed), number, ("cone",)):
        try:
            limits.append((hopper, friction_limit(hopper)))
        except NoRadialSolutionError:
            continue  # too wide for any wall
    for hopper, limit in limits:
        if has_mass_flow_limit(hopper):
            assert limit.friction_angle >= mass_flow_friction_angle(hopper)
    folds = [(hopper, limit) for hopper, limit in limits if limit.end == "fold"]
    _, phi = taylor.fold([hopper for hopper, _ in folds], [limit.tau for _, limit in folds])
    covered = [
        bool(abs(limit.friction_angle - shot) <= limit.error_estimate)
        for (_, limit), shot in zip(folds, phi, strict=True)
    ]
    print(f"  {len(limits)} limits, {sum(covered)} of {len(covered)} folds covered")
    if number > _MANY:
        figures: dict[str, Figure] = {
            "seed": seed, "limits": len(limits), "folds": len(folds), "covered": sum(covered)
        }  # fmt: skip
        record("limits_of_random_cones", "Folds against shooting in 80-bit arithmetic.", figures)
    assert np.mean(covered) >= 0.99
    flat = [(hopper, limit) for hopper, limit in limits if limit.end in ("fold", "axis")]
    factors = np.geomspace(0.1, 20, 25)
    chosen = [hopper for hopper, _ in flat for _ in factors]
    tau = np.array([limit.tau * factor for _, limit in flat for factor in factors])
    at = taylor.batch(chosen)
    psi = taylor.shoot(at, tau)[1][-1]
    singular = [hopper.material.singular_angle(hopper.delta) for hopper in chosen]
    shot = np.where(psi < singular, taylor.friction_angle(at, psi), -1).reshape(len(flat), -1)
    for (hopper, limit), largest in zip(flat, shot.max(axis=1), strict=True):
        assert largest <= limit.friction_angle + limit.error_estimate, repr(hopper)
