"""A second discretisation, staggered Chebyshev points in tilted time, against shooting."""

import numpy as np
import pytest

from tests.stability.tilted_chebyshev import staggered_modes
from tests.stability.tilted_data import ELSEWHERE, ELSEWHERE_NAMES, as_complex, name, radial, read
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC
from tests.stability.witnesses import partner_distances

# Rounding of an eigenvalue among those of a matrix of such size, relative.
ROUNDING = 1e-13


def inside(modes, case):
    real, imag = modes.real, modes.imag
    return modes[(real > case["lowest_re"]) & (real < 40) & (imag < case["highest_im"])]


def matched(left, right):
    """The right one's partner of each left one, relative to max(1, |.|), one to one."""
    assert left.size == right.size
    return partner_distances(left, right)


@pytest.mark.parametrize("case", read("tilted_reference"), ids=name)
def test_shot_modes_and_no_others(case):
    """In the whole rectangle that shooting has searched, to both error estimates."""
    solution = radial(case)
    sizes = (48, 72) if case["branch"] == "physical" else (72, 108)
    for parity in {SYMMETRIC, ASYMMETRIC} & case.keys():
        shot, errors = as_complex(case[parity]), np.array(case[f"{parity}_errors"])
        coarse, fine = (inside(staggered_modes(solution, m, parity), case) for m in sizes)
        # Convergence is geometric: the finer mesh is better than its change from the coarser one.
        change = matched(fine, coarse)
        assert change.max() < 2e-6
        nearest = np.abs(shot[:, None] - fine).argmin(axis=1)
        size = np.maximum(1, np.abs(shot))
        tolerance = errors + size * (change[nearest] + ROUNDING * sizes[1])
        assert np.all(matched(shot, fine) * size <= tolerance)


@pytest.mark.parametrize(("case", "parity", "modes"), ELSEWHERE, ids=ELSEWHERE_NAMES)
def test_spectra_computed_elsewhere(case, parity, modes):
    found = staggered_modes(radial(case), 48, parity)
    found = found[np.abs(found[:, None] - modes).argmin(axis=0)]
    np.testing.assert_allclose(found, modes, rtol=case["tolerance_relative"])


def test_few_points_suffice_beyond_the_tangency():
    """psi up to 37.3 degrees, the tangency at 27.5: 16 points give all low modes to 1e-8."""
    case, parity, modes = ELSEWHERE[0]
    found = staggered_modes(radial(case), 16, parity)[: modes.size]
    assert matched(found, modes).max() < 1e-8
