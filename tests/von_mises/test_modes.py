"""Low modes of two meshes against the reference and a second discretisation; their errors."""

from math import radians

import numpy as np
import pytest

from hopper.errors import ConvergenceError, HopperError, InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.solution import solve_radial
from hopper.von_mises.collocation import mode_matrix, without_flow_rate
from hopper.von_mises.modes import LEAST_MODES, SIZES, low_modes, modes_on
from tests.stability.witnesses import partner_distances
from tests.von_mises.witnesses import SETS, cone, galerkin_modes, radial, reference_modes


@pytest.mark.parametrize("index", range(len(SETS)), ids=str)
def test_modes_of_the_reference_within_both_errors(index):
    expected, errors = reference_modes(index)
    found = low_modes(radial(*SETS[index]))
    assert found.resolved_to(1e-9) >= LEAST_MODES
    count = min(len(found.eigenvalues), len(expected))
    # The same modes in the same order: none missed, none added.
    distances = np.abs(found.eigenvalues[:count] - expected[:count])
    assert np.all(distances < found.errors[:count] + 3 * errors[:count])
    assert np.all(found.errors[:LEAST_MODES] < 1e-9 * np.abs(expected[:LEAST_MODES]) + 1e-9)
    assert np.all(np.diff(np.abs(found.eigenvalues)) > 0)
    assert np.all(found.eigenvalues.imag >= 0)


@pytest.mark.parametrize("index", [1, 3, 5, 6, 8, 10])
def test_modes_are_all_of_those_of_a_second_discretisation(index):
    solution = radial(*SETS[index])
    found = low_modes(solution)
    galerkin = galerkin_modes(solution, 34)
    galerkin = np.delete(galerkin, np.argmin(np.abs(galerkin)))
    largest = np.abs(found.eigenvalues[-1]) * (1 + 1e-6)
    within = galerkin[(galerkin.imag > -1e-9) & (np.abs(galerkin) < largest)]
    assert len(within) == len(found.eigenvalues)
    distances = np.abs(within[:, None] - found.eigenvalues).min(axis=0)
    # Both may err: by what one says, and the rounding of the other.
    assert np.all(distances < found.errors + 1e-9 * np.abs(found.eigenvalues))
    assert partner_distances(within, found.eigenvalues).max() < 1e-5


def random_flows(seed, count):
    """Radial flows of random cones with psi up to 40 degrees."""
    random = np.random.default_rng(seed)
    while count:
        delta, half_angle, phi = random.uniform([13, 3, 0], [59.5, 32, 30])
        try:
            solution = solve_radial(cone(delta, half_angle), radians(phi))
        except HopperError:
            continue
        if solution.psi_maximum()[1] < radians(40):
            count -= 1
            yield solution


def test_errors_cover():
    checked = 0
    for solution in random_flows(3, 16):
        fine = np.linalg.eigvals(without_flow_rate(mode_matrix(solution, 58)))
        for size in SIZES[1:6]:
            modes = modes_on(solution, size)
            distance = np.abs(fine[:, None] - modes.eigenvalues[:10]).min(axis=0)
            # The finer mesh has rounding errors of its own.
            rounding = 1e-11 * np.maximum(1, np.abs(modes.eigenvalues[:10]))
            assert np.all(distance <= modes.errors[:10] + rounding)
            checked += len(distance)
    assert checked > 300


def test_accuracy_for_the_number_of_points():
    # 28 half nodes for 1e-10 and 20 for 1e-6 in the six lowest modes, at 10 deg and psi < 40 deg.
    for delta, phi in (
        (20, 12),
        (30, 22),
        (38, 28),
        (42, 20),
        (50, 24),
        (55, 16),
        (36, 5),
        (25, 21),
    ):
        solution = solve_radial(cone(delta, 10), radians(phi))
        assert solution.psi_maximum()[1] < radians(40)
        meshes = [
            np.linalg.eigvals(without_flow_rate(mode_matrix(solution, n))) for n in (44, 28, 20)
        ]
        lowest = meshes[0][np.argsort(np.abs(meshes[0]))][:11]
        lowest = lowest[lowest.imag >= 0][:6]
        for mesh, error in zip(meshes[1:], (1e-10, 1e-6), strict=True):
            distance = np.abs(mesh[:, None] - lowest).min(axis=0)
            assert np.all(distance < error * np.maximum(1, np.abs(lowest)))


def test_matching_stops_at_the_first_mode_without_partner():
    solution = radial(50, 30, 0.3)
    coarse, fine = modes_on(solution, 19), modes_on(solution, 48)
    assert 0 < len(coarse.eigenvalues) < len(fine.eigenvalues)
    # What the raw matrix holds beyond is not near the spectrum.
    raw = np.linalg.eigvals(without_flow_rate(mode_matrix(solution, 48)))
    assert raw.real.max() > fine.eigenvalues.real.max() + 1


def test_a_hint_saves_meshes_and_changes_nothing_else():
    solution = radial(40, 10, 0.1)
    plain, hinted = low_modes(solution), low_modes(solution, first=30)
    assert hinted.size == 30
    count = len(plain.eigenvalues)
    assert np.all(np.abs(hinted.eigenvalues[:count] - plain.eigenvalues) < plain.errors)


def test_a_tolerance_saves_meshes():
    solution = radial(40, 30, 0.2)
    rough, fine = (low_modes(solution, tolerance) for tolerance in (1e-6, 1e-10))
    assert rough.size < fine.size
    assert rough.resolved_to(1e-6) >= LEAST_MODES
    assert fine.resolved_to(1e-10) >= LEAST_MODES
    count = len(rough.eigenvalues)
    distances = np.abs(rough.eigenvalues - fine.eigenvalues[:count])
    assert np.all(distances < rough.errors + fine.errors[:count])


def test_bad_input():
    for tolerance in (0, 1e-5, float("nan"), "fine"):
        with pytest.raises(InvalidParameterError, match=r"^tolerance = "):
            low_modes(radial(40, 10, 0.1), tolerance)  # type: ignore[arg-type]
    with pytest.raises(InvalidParameterError, match="size = 20 half nodes: give one of"):
        low_modes(radial(40, 10, 0.1), first=20)
    with pytest.raises(InvalidParameterError, match="size = 12 half nodes"):
        modes_on(radial(40, 10, 0.1), 12)
    coulomb = solve_radial(Hopper("cone", radians(40), radians(10)), 0.1)
    with pytest.raises(InvalidParameterError, match="use model = von-mises"):
        low_modes(coulomb)


def test_modes_next_to_the_singular_flow_are_refused():
    solution = solve_radial(cone(40, 10), radians(32.7))
    with pytest.raises(
        ConvergenceError, match=r"only \d+ modes resolved .* lower the wall friction"
    ):
        low_modes(solution)
