"""The paper's way to the abscissa: right for the flow's parity, wrong for both together."""

from functools import lru_cache

import numpy as np
import pytest
from scipy.linalg import eigvals

from hopper import Hopper, linear_stability, solve_radial
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.stability.paper_abscissa import paper_abscissa
from hopper.stability.paper_matrix import half_matrix, paper_matrix
from tests.stability.witnesses import radial

TOLERANCE = 1e-3
CASES = [("wedge", 0.0), ("wedge", 0.1), ("cone", 0.0), ("cone", 0.1), ("cone", 0.3)]


@pytest.mark.parametrize(("geometry", "mu"), CASES)
def test_physical_variant_meets_the_line_and_the_low_modes(geometry, mu):
    solution = radial(geometry, 35, 10, mu)
    found = paper_abscissa(solution, 400, 200, TOLERANCE)
    expected = linear_stability(solution, "symmetric", count=4)
    if expected.governed_by != "line":
        assert abs(found.physical - expected.abscissa) < 1e-10
        return
    # Modes approach the line from below like Im(lambda)**-2. Of the n / pi = 127 modes that pi
    # points per wavelength resolve at least 80 are kept: up to 40 spacings.
    third = expected.eigenvalues[3]
    distance = expected.abscissa - third.real
    bound = distance * (third.imag / (40 * expected.line.spacing)) ** 2
    assert 0 < expected.abscissa - found.physical < bound
    assert bound < 1e-4


@pytest.mark.parametrize(("geometry", "mu"), CASES)
def test_variant_as_worded_is_the_algorithm_on_the_whole_matrix(geometry, mu):
    solution = radial(geometry, 35, 10, mu)
    fine, coarse = (eigvals(paper_matrix(solution, n)) for n in (200, 100))
    first = sorted(fine, key=abs)[: int(200 / np.pi * 2)]
    agreed = [z for z in first if np.abs(coarse - z).min() < TOLERANCE * abs(z)]
    found = paper_abscissa(solution, 200, 100, TOLERANCE).as_worded
    # Rounding of eigenvalues of condition 1e3; the next candidate is further away.
    assert abs(found - max(z.real for z in agreed)) < 1e-10


@lru_cache(maxsize=1)
def cone_with_friction():
    """delta = 35 deg, half angle 10 deg, phi = 0.1: the line governs."""
    return solve_radial(Hopper("cone", np.radians(35), np.radians(10)), 0.1)


def test_variant_as_worded_is_wrong_for_cones_with_friction():
    solution = cone_with_friction()
    expected = linear_stability(solution, "symmetric")
    assert expected.abscissa == pytest.approx(-1.568, abs=5e-4)
    found = paper_abscissa(solution, 400, 200, TOLERANCE)
    assert found.as_worded == pytest.approx(-0.42, abs=5e-3)
    assert found.physical == pytest.approx(expected.abscissa, abs=2e-6)
    # Finer meshes do not mend it.
    assert paper_abscissa(solution, 600, 300, TOLERANCE).as_worded > found.as_worded + 0.2


def test_why_it_is_wrong():
    # The eigenvalue belongs to the mirrored half, whose modes are not smooth at the apex.
    solution = cone_with_friction()
    worded = paper_abscissa(solution, 400, 200, TOLERANCE).as_worded
    meshes = (100, 200, 400, 800)
    spectra = [eigvals(half_matrix(solution, n // 2, "mirrored")) + 0j for n in meshes]
    fine = spectra[2]
    (mode,) = fine[(np.abs(fine.real - worded) < 1e-9) & (fine.imag > 0)]
    physical = eigvals(half_matrix(solution, 200, "physical"))
    assert np.abs(physical - mode).min() > 1
    path = np.array([values[np.abs(values - mode).argmin()] for values in spectra])
    # From mesh to mesh it moves by less than the tolerance of its modulus, and by half of its
    # real part.
    drift = np.abs(np.diff(path))
    assert drift[1] < TOLERANCE * abs(mode)
    assert drift[1] > 0.8 * abs(mode.real)
    assert np.all(np.diff(path.real) > 0.1)
    # Convergence is algebraic, of low order: a step is more than a quarter of the one before.
    assert np.all(drift[1:] > drift[:-1] / 4)


def test_physical_variant_stops_at_the_first_unresolved_mode():
    # Beyond it a straggler of the flow's own parity agrees by chance, with Re > 0.
    solution = radial("cone", 35, 30)
    fine, coarse = (eigvals(half_matrix(solution, n // 2, "physical")) for n in (400, 200))
    agreed = [z for z in fine if np.abs(coarse - z).min() < TOLERANCE * abs(z)]
    assert max(z.real for z in agreed) > 0.6
    found = paper_abscissa(solution, 400, 200, TOLERANCE)
    expected = linear_stability(solution, "symmetric")
    assert expected.abscissa < -0.3
    assert found.physical == pytest.approx(expected.abscissa, abs=1e-5)


def test_refusals():
    solution = radial("wedge", 35, 10)
    for n, coarse_n in ((201, 100), (200, 101), (200, 2)):
        with pytest.raises(InvalidParameterError, match="give an even integer of at least 4"):
            paper_abscissa(solution, n, coarse_n, TOLERANCE)
    with pytest.raises(ConvergenceError, match="converged to 1e-16 between 16 and 32 nodes: use"):
        paper_abscissa(solution, 32, 16, 1e-16)


@pytest.mark.parametrize(("n", "coarse_n"), [(200, 200), (100, 200)])
def test_meshes_in_the_wrong_order(n, coarse_n):
    # A mesh agrees with itself in everything.
    with pytest.raises(InvalidParameterError, match="finer mesh first"):
        paper_abscissa(radial("wedge", 35, 10), n, coarse_n, TOLERANCE)


def test_neutral_points_are_neutral_for_the_papers_algorithm_too():
    # The line governs here: kept modes lie below it by their distance at 40 spacings or less.
    solution = solve_radial(Hopper("cone", np.radians(33.6739), np.radians(10)), 0.0)
    found = paper_abscissa(solution, 400, 200, TOLERANCE)
    assert abs(found.physical) < 1e-5
