"""Mesh spectra and the convergence filter: the paper's case, and rules on hand-made spectra."""

from functools import lru_cache

import numpy as np
import pytest
from numpy.polynomial.chebyshev import chebvander
from scipy.linalg import eig, eigvals

from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.spectral import chebyshev
from hopper.spectral.matching import relative_changes, unbroken_run
from hopper.stability.convergence_filter import REASONS, convergence_filter
from hopper.stability.mesh_spectrum import HALVES, MeshSpectrum, mesh_spectrum
from hopper.stability.paper_matrix import half_matrix, paper_matrix
from tests.stability.witnesses import partner_distances, radial

TOLERANCE = 1e-3
PHYSICAL, MIRRORED = range(2)


@lru_cache(maxsize=8)
def spectrum(geometry, n):
    """Spectrum of the paper's Figure 4.2 on n nodes."""
    return mesh_spectrum(radial(geometry, 35, 10), n)


@lru_cache(maxsize=2)
def filtered(geometry):
    return convergence_filter(spectrum(geometry, 400), spectrum(geometry, 200), TOLERANCE)


@lru_cache(maxsize=4)
def full_spectrum(geometry, n):
    """Eigenvalues of the whole matrix by LAPACK, by increasing modulus."""
    values = eigvals(paper_matrix(radial(geometry, 35, 10), n))
    return values[np.argsort(np.abs(values), kind="stable")]


def nearest_index(found, value):
    return int(np.argmin(np.abs(found.fine.eigenvalues - value)))


def reason(found, index):
    return REASONS[found.reason[index]]


# The paper's case.


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_halves_make_up_the_full_spectrum(geometry):
    found = filtered(geometry)
    full = full_spectrum(geometry, 400)
    assert found.fine.eigenvalues.size == full.size == 798
    assert np.all(np.diff(np.abs(found.fine.eigenvalues)) >= 0)
    assert np.bincount(found.fine.half).tolist() == [399, 399]
    for kept in (found.kept, found.kept_as_worded):
        assert partner_distances(found.fine.eigenvalues[kept], full).max() < 1e-11


@pytest.mark.parametrize(
    ("geometry", "worded", "run"), [("wedge", 264, (0, 250)), ("cone", 277, (3, 252))]
)
def test_filter_as_worded(geometry, worded, run):
    fine, coarse = (full_spectrum(geometry, n) for n in (400, 200))
    by_lapack = relative_changes(fine, coarse, "nearest") < TOLERANCE
    for kept in (filtered(geometry).kept_as_worded, by_lapack):
        assert kept.sum() == worded
        assert unbroken_run(kept) == run


def test_ordinal_matching_of_the_wedge():
    # Conjugate pairs have one modulus: ranks mean something only if both spectra order them alike.
    changes = []
    for order in (1, -1):
        fine, coarse = (
            values[np.lexsort((order * values.imag, np.round(np.abs(values), 6)))]
            for values in (spectrum("wedge", n).eigenvalues for n in (400, 200))
        )
        changes.append(relative_changes(fine, coarse, "ordinal"))
    as_computed = relative_changes(
        spectrum("wedge", 400).eigenvalues, spectrum("wedge", 200).eigenvalues, "ordinal"
    )
    for change in (*changes, as_computed):
        assert np.count_nonzero(change < TOLERANCE) == 252
        assert unbroken_run(change < TOLERANCE) == (0, 250)
        assert np.isinf(change[398:]).all()


@pytest.mark.parametrize(("geometry", "kept"), [("wedge", [125, 124]), ("cone", [125, 0])])
def test_sound_filter(geometry, kept):
    found = filtered(geometry)
    assert np.bincount(found.fine.half[found.kept], minlength=2).tolist() == kept
    assert np.all(found.change[found.kept] < TOLERANCE)
    assert np.array_equal(found.kept, found.reason == REASONS.index("kept"))
    assert np.count_nonzero(found.reason == REASONS.index("no_partner")) == 400
    for half, _ in enumerate(HALVES):
        if kept[half]:
            mine = found.kept[found.fine.half == half]
            start = int(np.argmax(mine))
            assert unbroken_run(mine) == (start, start + kept[half])


def test_grid_mode_of_the_wedge_is_unresolved():
    found = filtered("wedge")
    index = nearest_index(found, -1.6839324)
    assert abs(found.fine.eigenvalues[index] + 1.6839324) < 1e-6
    assert found.fine.half[index] == MIRRORED
    assert found.kept_as_worded[index]
    assert found.fine.tail[index] == 1
    assert reason(found, index) == "eigenvector_unresolved"


def test_artefact_of_the_cone_is_rejected_by_both_filters():
    found = filtered("cone")
    index = nearest_index(found, 3.98)
    assert abs(found.fine.eigenvalues[index] - 3.98) < 0.01
    assert not found.kept_as_worded[index]
    assert reason(found, index) == "changed"
    # It is no mode of the equations: another mesh moves it.
    other = spectrum("cone", 300).eigenvalues
    assert np.abs(other - found.fine.eigenvalues[index]).min() > 0.01


def test_stragglers_off_the_line_pass_only_the_filter_as_worded():
    found = filtered("cone")
    eigenvalues = found.fine.eigenvalues
    for index in nearest_index(found, -0.065 + 4501j), nearest_index(found, -0.065 - 4501j):
        assert abs(abs(eigenvalues[index]) - 4501) < 1
        assert abs(eigenvalues[index].real + 0.065) < 1e-3
        assert found.kept_as_worded[index]
        assert not found.kept[index]
        assert reason(found, index) == "eigenvector_unresolved"
    assert np.abs(eigenvalues[found.kept]).max() < 2200 < np.abs(eigenvalues[-1])


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_kept_physical_eigenvalues_stand_on_a_third_mesh(geometry):
    found, third = filtered(geometry), spectrum(geometry, 300)
    kept = found.fine.eigenvalues[found.kept & (found.fine.half == PHYSICAL)]
    others = third.eigenvalues[third.half == PHYSICAL]
    assert partner_distances(kept, others).max() < 1e-11


def test_eigenvectors_of_kept_physical_modes_are_smooth():
    for geometry in ("wedge", "cone"):
        found = filtered(geometry)
        kept = found.kept & (found.fine.half == PHYSICAL)
        assert found.fine.tail[kept].max() < 1e-9
        mirrored = found.fine.half == MIRRORED
        low = mirrored & (np.abs(found.fine.eigenvalues) < 500)
        # sigma1 odd and psi1 even: not smooth at the apex of a cone.
        smooth = np.count_nonzero(found.fine.tail[low] < 1e-9)
        assert smooth == (np.count_nonzero(low) - 1 if geometry == "wedge" else 0)


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_tails_are_the_larger_of_both_components(geometry):
    n, m = 64, 32
    found = spectrum(geometry, n)
    coefficients = np.linalg.inv(chebvander(chebyshev.nodes(n), n - 1))
    for half, sign in enumerate((1, -1)):
        _, vectors = eig(half_matrix(radial(geometry, 35, 10), m, HALVES[half]))
        tails = []
        for vector in vectors.T:
            sigma, psi = vector[:m], np.append(vector[m:], 0)
            sizes = [
                np.abs(coefficients @ np.concatenate([parity * part[::-1], part]))
                for part, parity in ((sigma, sign), (psi, -sign))
            ]
            # The last tenth of the half that parity leaves.
            tails.append(max(size[-2 * (m // 10) :].max() / size.max() for size in sizes))
        mine = np.sort(found.tail[found.half == half])
        np.testing.assert_allclose(mine, np.sort(tails), rtol=1e-6, atol=1e-12)


# Hand-made spectra.


def by_modulus(*values):
    array = np.array(values, dtype=complex)
    return array[np.argsort(np.abs(array), kind="stable")]


def test_nearest_matching_shares_partners():
    fine, coarse = by_modulus(1, 1.01, 2, 100), by_modulus(1, 2.2)
    change = relative_changes(fine, coarse, "nearest")
    np.testing.assert_allclose(change, [0, 0.01 / 1.01, 0.1, 0.978], rtol=1e-12)


def test_ordinal_matching_pairs_equal_ranks():
    fine, coarse = by_modulus(1, 1.01, 2, 100), by_modulus(1, 2.2)
    change = relative_changes(fine, coarse, "ordinal")
    np.testing.assert_allclose(change, [0, 1.19 / 1.01, np.inf, np.inf], rtol=1e-12)


def test_one_to_one_matching_gives_each_partner_once():
    fine, coarse = by_modulus(1, 1.01, 2, 100), by_modulus(1, 2.2)
    change = relative_changes(fine, coarse, "one-to-one")
    np.testing.assert_allclose(change, [0, np.inf, 0.1, np.inf], rtol=1e-12)


def test_one_to_one_matching_undoes_a_shift_of_rank():
    # A spurious eigenvalue of small modulus shifts every rank after it.
    true = np.array([2, 3 + 4j, 3 - 4j, 10])
    fine, coarse = by_modulus(0.1, *true), by_modulus(*true)
    assert relative_changes(fine, coarse, "one-to-one").tolist() == [np.inf, 0, 0, 0, 0]
    assert np.all(relative_changes(fine, coarse, "ordinal")[:4] > 0.4)


def test_one_to_one_matching_ignores_distant_leftovers():
    # 40 has no partner: total distance is least if 1.5 gives its own one to 1 and takes 40.
    fine, coarse = by_modulus(1, 1.5), by_modulus(1.5, 40)
    np.testing.assert_allclose(relative_changes(fine, coarse, "one-to-one"), [39, 0])


def mesh(n, *values, half=PHYSICAL, tail=0.0):
    """A mesh spectrum; ``half`` and ``tail`` for all eigenvalues or each."""
    ones = np.ones(len(values))
    return MeshSpectrum(n, by_modulus(*values), (half * ones).astype(np.int8), tail * ones)


def reasons(found):
    return [REASONS[code] for code in found.reason]


def test_reasons():
    coarse = mesh(16, 1, 2, 3.5, 4, 5)
    fine = mesh(32, 1, 2, 3, 4, 5, 6, tail=np.array([0, 0.5, 0, 0, 0.5, 0]))
    found = convergence_filter(fine, coarse, 0.01)
    # An unresolved eigenvector rejects its mode; only a changed or missing one ends the run.
    assert reasons(found) == [
        "kept",
        "eigenvector_unresolved",
        "changed",
        "beyond_first_unresolved",
        "eigenvector_unresolved",
        "no_partner",
    ]
    assert found.kept.tolist() == [True] + 5 * [False]
    assert found.kept_as_worded.tolist() == [True, True, False, True, True, False]


def test_halves_are_judged_apart():
    # 3 is in both meshes but in different halves; the other half's run does not end this one's.
    halves = np.array([PHYSICAL, MIRRORED, PHYSICAL, MIRRORED])
    fine, coarse = mesh(32, 1, 2, 3, 4, half=halves), mesh(16, 1, 2.5, 3.01, 4, half=halves)
    coarse.half[2] = MIRRORED
    found = convergence_filter(fine, coarse, 0.02)
    assert reasons(found) == ["kept", "changed", "no_partner", "beyond_first_unresolved"]
    assert found.kept_as_worded.tolist() == [True, False, True, True]
    coarse.half[2] = PHYSICAL
    assert reasons(convergence_filter(fine, coarse, 0.02))[2] == "kept"


@pytest.mark.parametrize(
    ("kept", "run"),
    [
        ([1, 1, 1], (0, 3)),
        ([0, 1, 1, 0, 1], (1, 3)),
        ([1, 0, 1, 1, 1], (0, 1)),
        ([0, 0, 1], (2, 3)),
    ],
)
def test_unbroken_run(kept, run):
    assert unbroken_run(np.array(kept, dtype=bool)) == run


# Refusals.


def test_odd_meshes():
    with pytest.raises(InvalidParameterError, match="n = 201 nodes: give an even integer"):
        mesh_spectrum(radial("wedge", 35, 10), 201)


def test_meshes_of_too_few_nodes():
    with pytest.raises(InvalidParameterError, match="n = 14 nodes are too few to filter: use 16"):
        mesh_spectrum(radial("wedge", 35, 10), 14)
    assert mesh_spectrum(radial("wedge", 35, 10), 16).eigenvalues.size == 30


@pytest.mark.parametrize("fine", [16, 32])
def test_meshes_in_the_wrong_order(fine):
    with pytest.raises(InvalidParameterError, match=r"in the wrong order: .* finer mesh first"):
        convergence_filter(mesh(fine, 1, 2), mesh(32, 1, 2), TOLERANCE)


@pytest.mark.parametrize("tolerance", [0.0, 1.0, -0.1, np.nan])
def test_bad_tolerances(tolerance):
    with pytest.raises(
        InvalidParameterError, match=r"tolerance = .* must (lie between 0 and 1|be finite)"
    ):
        convergence_filter(mesh(32, 1, 2), mesh(16, 1, 2), tolerance)


def test_nothing_kept():
    with pytest.raises(ConvergenceError, match=r"to 0\.01 between 16 and 32 nodes: use finer"):
        convergence_filter(mesh(32, 1, 2), mesh(16, 1.1, 2.2), 0.01)
    with pytest.raises(InvalidParameterError, match="no eigenvalue is kept: there is no run"):
        unbroken_run(np.zeros(3, dtype=bool))
