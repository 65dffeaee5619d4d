"""Growth on the kept modes against matrix exponentials and eigenvectors of the whole matrix."""

from itertools import pairwise, product

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import expm

from hopper.errors import InvalidParameterError
from hopper.spectral import chebyshev
from hopper.spectral.matching import match_kept
from hopper.spectral.transient import (
    ModalBasis,
    abscissa,
    condition_number,
    growth_curve,
    modal_matrix,
    oscillation,
    propagator_norm,
)
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.paper_matrix import paper_matrix
from hopper.stability.transient import NORMS, half_weights, modal_basis
from tests.stability.kept_modes import (
    EPS,
    eigenvectors,
    kept_bases,
    kept_eigenvalues,
    l2_weights,
    matrix_norm,
    restricted,
)
from tests.stability.witnesses import partner_distances, radial

GEOMETRIES = ("wedge", "cone")
CASES = list(product(GEOMETRIES, NORMS, (1.0, 2.0)))
TIMES = np.array([0.0, 1e-3, 0.02, 0.3, 1.0, 5.0])


def all_kept(geometry, formulation, n):
    return np.concatenate(list(kept_eigenvalues(geometry, formulation, n).values()))


def rounding(kappa, size, times):
    """Relative rounding of a propagator: eps for the basis, and for the matrix along the way."""
    return 10 * EPS * (kappa + size * times)


# The propagator.


@pytest.mark.parametrize(("geometry", "norm", "psi_scale"), CASES)
def test_norm_is_that_of_the_matrix_exponential(geometry, norm, psi_scale):
    bases = kept_bases(geometry, "low", 64, norm, psi_scale)
    matrices = [modal_matrix(basis) for basis in bases]
    expected = [max(np.linalg.norm(expm(t * m), 2) for m in matrices) for t in TIMES]
    size = max(np.linalg.norm(m) for m in matrices)
    error = np.abs(propagator_norm(bases, TIMES) / expected - 1)
    assert np.all(error <= rounding(condition_number(bases), size, TIMES))


@pytest.mark.parametrize(("geometry", "norm", "psi_scale"), CASES)
def test_norm_by_its_definition_on_the_whole_matrix(geometry, norm, psi_scale):
    # V exp(t Lambda) V^+ knows no parity: the norm of both halves is the larger of theirs.
    n = 48
    bases = kept_bases(geometry, "low", n, norm, psi_scale)
    assert len(bases) == 2
    kept = all_kept(geometry, "low", n)
    values, vectors = eigenvectors(geometry, n, kept, norm, psi_scale)
    inverse = np.linalg.pinv(vectors)
    expected = [np.linalg.norm(vectors * np.exp(t * values) @ inverse, 2) for t in TIMES]
    found, kappa = propagator_norm(bases, TIMES), condition_number(bases)
    allowed = rounding(kappa, matrix_norm(geometry, n), TIMES)
    assert np.all(np.abs(found / expected - 1) <= allowed)
    halves = [propagator_norm([basis], TIMES) for basis in bases]
    assert np.all(np.abs(found / np.maximum(*halves) - 1) <= allowed)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_norm_on_the_mesh_of_the_paper(geometry):
    bases = kept_bases(geometry, "paper", 400, "discrete", 2.0)
    kept = all_kept(geometry, "paper", 400)
    operator = restricted(*eigenvectors(geometry, 400, kept, "discrete", 2.0))
    times = np.array([0.1, 2.0])
    expected = [np.linalg.norm(expm(t * operator), 2) for t in times]
    error = np.abs(propagator_norm(bases, times) / expected - 1)
    kappa = condition_number(bases)
    assert np.all(error <= rounding(kappa, matrix_norm(geometry, 400), times))


@pytest.mark.parametrize("formulation", ["paper", "physical"])
@pytest.mark.parametrize(("geometry", "norm", "psi_scale"), CASES)
def test_bounds_of_the_norm(geometry, formulation, norm, psi_scale):
    bases = kept_bases(geometry, formulation, 200, norm, psi_scale)
    times = np.linspace(0, 5, 101)
    found = propagator_norm(bases, times)
    kappa, alpha = condition_number(bases), abscissa(bases)
    shift = abs(alpha - all_kept(geometry, formulation, 200).real.max())
    assert shift <= EPS * kappa * matrix_norm(geometry, 200)
    lower = np.exp(alpha * times)
    slack = rounding(kappa, 1, times)
    assert np.all(found >= lower * (1 - slack))
    assert np.all(found <= kappa * lower * (1 + slack))
    assert abs(found[0] - 1) <= slack[0]
    # There is growth beyond the lower bound, and the upper one is not trivial.
    assert 1.2 < (found / lower).max() < kappa


@pytest.mark.parametrize(("geometry", "norm", "psi_scale"), CASES)
def test_modal_matrix_and_condition_number(geometry, norm, psi_scale):
    n = 64
    bases = kept_bases(geometry, "low", n, norm, psi_scale)
    kept = all_kept(geometry, "low", n)
    _, vectors = eigenvectors(geometry, n, kept, norm, psi_scale)
    kappa = np.linalg.cond(vectors)
    assert abs(condition_number(bases) / kappa - 1) < EPS * kappa * matrix_norm(geometry, n)
    for basis in bases:
        found = np.linalg.eigvals(modal_matrix(basis))
        scale = EPS * kappa * np.linalg.norm(modal_matrix(basis))
        assert np.all(partner_distances(found, basis.eigenvalues) < 10 * scale)
        # Orthonormal up to the choice of basis: singular values are those of the real vectors,
        # sqrt(2) Re v and sqrt(2) Im v, which a unitary map takes to v and conj(v).
        _, mine = eigenvectors(geometry, n, basis.eigenvalues, norm, psi_scale)
        np.testing.assert_allclose(
            np.linalg.svd(basis.factor, compute_uv=False),
            np.linalg.svd(mine, compute_uv=False),
            rtol=EPS * kappa * matrix_norm(geometry, n),
        )


def test_condition_number_of_both_parities_together():
    # Largest singular value of one, smallest of the other.
    values = np.array([1, 2], dtype=complex)
    parts = [ModalBasis(values, np.diag(r)) for r in ([4.0, 2.0], [1.0, 0.5])]
    assert [condition_number([part]) for part in parts] == [2, 2]
    assert condition_number(parts) == 8


# The mesh.


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_growth_in_the_l2_norm_does_not_depend_on_the_mesh(geometry):
    kept = kept_eigenvalues(geometry, "physical", 120)["physical"][:27]
    times = np.linspace(0, 5, 26)

    def growth(n, norm):
        basis = modal_basis(radial(geometry, 35, 10), n, "physical", kept, norm)
        return propagator_norm([basis], times) * np.exp(-basis.abscissa * times)

    reference = growth(200, "L2")
    for n in (120, 160):
        assert np.abs(growth(n, "L2") - reference).max() < 1e-8
    # End points count fully among N nodal values: an error of 1 / N.
    by_nodes = [growth(n, "discrete") for n in (100, 200, 400)]
    changes = [np.abs(by_nodes[i + 1] - by_nodes[i]).max() for i in range(2)]
    assert changes[1] > 1e-3
    assert changes[0] / changes[1] == pytest.approx(2, abs=0.15)
    assert np.abs(by_nodes[-1] - reference).max() > 0.05


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_growth_on_all_of_the_matrix_does_not_converge(geometry):
    # Its modes at the top of the spectrum are of the mesh's making.
    time = 0.02
    solution = radial(geometry, 35, 10)
    kept = kept_eigenvalues(geometry, "physical", 64)["physical"][:5]
    full, modal = [], []
    for n in (32, 64, 128):
        weight = l2_weights(geometry, n)
        root = np.sqrt(np.concatenate([weight, weight[1:-1]]))
        matrix = root[:, None] * paper_matrix(solution, n) / root
        full.append(np.linalg.norm(expm(time * matrix), 2))
        modal.append(propagator_norm([modal_basis(solution, n, "physical", kept)], time))
    assert np.abs(np.diff(modal)).max() < 1e-8
    assert full[0] > max(modal)
    # Steps from mesh to mesh grow.
    first, second = np.diff(full)
    assert second > 1.3 * first > 0.05


# Norms and the weight of psi.


@pytest.mark.parametrize("m", [16, 17, 40])
@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_half_weights_are_norms_of_both_halves(geometry, m):
    hopper = radial(geometry, 35, 10).hopper
    x = chebyshev.half_nodes(m)

    def density(x):
        return np.sin(hopper.half_angle * x) / np.sin(hopper.half_angle) if hopper.curvature else 1

    def sigma(x):
        return np.cos(2 * x) + x**4

    def psi(x):
        return np.sin(3 * x) * (1 - x**2)

    squares = np.concatenate([sigma(x), psi(x)[:-1]]) ** 2
    integral = quad(lambda x: 2 * density(x) * (sigma(x) ** 2 + psi(x) ** 2), 0, 1, epsabs=1e-14)[0]
    assert np.all(half_weights(hopper, m, "L2") > 0)
    assert half_weights(hopper, m, "L2") @ squares == pytest.approx(integral, rel=1e-13)
    full = chebyshev.nodes(2 * m)
    nodal = np.sum(sigma(full) ** 2) + np.sum(psi(full)[1:-1] ** 2)
    assert half_weights(hopper, m, "discrete") @ squares == pytest.approx(nodal, rel=1e-13)


@pytest.mark.parametrize("norm", NORMS)
@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_weight_of_psi_changes_norms_only(geometry, norm):
    times = np.linspace(0.05, 1, 12)
    defined, printed = (kept_bases(geometry, "physical", 64, norm, p)[0] for p in (1.0, 2.0))
    shift = np.abs(defined.eigenvalues - printed.eigenvalues).max()
    assert shift <= EPS * matrix_norm(geometry, 64) * condition_number([defined])
    growths = [propagator_norm([basis], times) for basis in (defined, printed)]
    assert np.abs(growths[0] / growths[1] - 1).max() > 0.05
    kappas = [condition_number([basis]) for basis in (defined, printed)]
    assert abs(kappas[0] / kappas[1] - 1) > 0.05


def test_times_of_any_shape():
    bases = kept_bases("wedge", "physical", 32, "L2", 1.0)
    times = np.array([[0.0, 0.5, 1.0], [1.5, 2.0, 2.5]])
    found = propagator_norm(bases, times)
    assert found.shape == times.shape
    alone, kappa = propagator_norm(bases, 1.5), condition_number(bases)
    assert abs(found[1, 0] / alone - 1) <= rounding(kappa, matrix_norm("wedge", 32), 1.5)
    assert propagator_norm(bases, 1.5).shape == ()
    assert propagator_norm(bases, []).shape == (0,)


# Refusals.


def kept_32():
    """Low modes of the wedge on 32 nodes: one real, then pairs."""
    return kept_eigenvalues("wedge", "physical", 32)["physical"]


def basis_of(kept, n=32, **options):
    return modal_basis(radial("wedge", 35, 10), n, "physical", kept, **options)


@pytest.mark.parametrize("half", HALVES)
def test_nothing_kept(half):
    with pytest.raises(InvalidParameterError, match=f"no {half} eigenvalue is kept: widen the fil"):
        modal_basis(radial("wedge", 35, 10), 32, half, np.empty(0, complex))


def test_kept_eigenvalues_not_closed_under_conjugation():
    real, upper, lower, other, _ = kept_32()[:5]
    assert real.imag == 0 < upper.imag == -lower.imag
    # The last one is upper of one pair and lower of another.
    for kept in ([upper], [lower], [real, upper], [upper, other.real - 1j * abs(other.imag)]):
        with pytest.raises(InvalidParameterError, match="not closed under conjugation"):
            basis_of(kept)
    assert basis_of([real, upper, lower]).eigenvalues.size == 3


@pytest.mark.parametrize(
    ("hopper", "n"), [(("wedge", 36, 10), 32), (("cone", 35, 10), 32), (("wedge", 35, 10, 0.1), 32)]
)
def test_eigenvalues_of_another_hopper(hopper, n):
    with pytest.raises(InvalidParameterError, match=r"\d+ kept eigenvalues are not on this mesh"):
        modal_basis(radial(*hopper), n, "physical", kept_32())


def test_eigenvalues_of_another_mesh_or_parity():
    # Modes of the finer mesh that the coarser does not resolve.
    for kept in (kept_eigenvalues("wedge", "physical", 200)["physical"], 2 * list(kept_32())):
        with pytest.raises(InvalidParameterError, match="filter the spectrum of the same hopper"):
            basis_of(kept)
    with pytest.raises(InvalidParameterError, match="are not on this mesh"):
        modal_basis(radial("wedge", 35, 10), 32, "mirrored", kept_32())
    with pytest.raises(InvalidParameterError, match="1 kept eigenvalues are not on this mesh"):
        match_kept(np.array([1, 2], dtype=np.complex128), np.array([1], dtype=np.complex128))


def test_matching_is_one_to_one_and_in_order():
    values = np.array([3.0, 1.0, 1.0, 2.0], dtype=complex)
    found = match_kept(np.array([2, 1 + 1e-9, 1], dtype=complex), values)
    assert found[0] == 3
    assert sorted(found[1:]) == [1, 2]


def test_unknown_norms():
    hopper = radial("wedge", 35, 10).hopper
    for call in (
        lambda norm: half_weights(hopper, 32, norm),
        lambda norm: basis_of(kept_32(), norm=norm),
    ):
        with pytest.raises(
            InvalidParameterError, match="norm = 'l2' is unknown: use discrete or L2"
        ):
            call("l2")


@pytest.mark.parametrize("elapsed", [-1e-9, [0, -1], np.nan, np.inf, [1, np.nan]])
def test_bad_times(elapsed):
    with pytest.raises(InvalidParameterError, match=r"^elapsed .*must be finite"):
        propagator_norm([basis_of(kept_32())], elapsed)


def test_no_bases():
    with pytest.raises(InvalidParameterError, match="no modes: give the basis of at least one"):
        propagator_norm([], 1.0)


# Oscillation.


@pytest.mark.parametrize("stretch", [1.0, 3.0])
def test_oscillation_of_one_pair(stretch):
    # exp(-t M) is a rotation in coordinates stretched by a factor: its norm swings between 1 and
    # that factor, twice a period.
    basis = ModalBasis(np.array([-0.3 + 2j, -0.3 - 2j]), np.diag([1.0, stretch]))
    amplitude, error = oscillation([basis], 1.0, np.pi / 2, 401)
    times = 1.0 + np.linspace(0, np.pi / 2, 4001)
    norms = [np.linalg.norm(expm(t * (modal_matrix(basis) + 0.3 * np.eye(2))), 2) for t in times]
    assert np.ptp(norms) == pytest.approx(stretch - 1, abs=1e-3)
    assert amplitude == pytest.approx(np.ptp(norms) / np.mean(norms), abs=1e-2 * stretch)
    assert error < 1e-2 * stretch


def test_oscillation_does_not_depend_on_the_rate_of_growth():
    slow, fast = (
        ModalBasis(np.array([rate + 5j, rate - 5j]), np.array([[1.0, 0.4], [0.0, 2.0]]))
        for rate in (-1.0, 2.0)
    )
    assert oscillation([slow], 0.5, 2.0, 101)[0] == pytest.approx(
        oscillation([fast], 0.5, 2.0, 101)[0], rel=1e-10
    )


# The wedge of Figure 4.2 on a coarser mesh: waves cross it in a time that the spacing of the
# eigenvalues gives, and the norm has a dip at every crossing.
@pytest.fixture(scope="module")
def wedge_bases():
    return {norm: kept_bases("wedge", "physical", 160, norm, 1.0) for norm in NORMS}


@pytest.mark.parametrize("norm", ["discrete", "L2"])
def test_the_sampled_norm_is_the_norm(wedge_bases, norm):
    """Extrema in windows of half a period, against a step that resolves every mode by far."""
    bases = wedge_bases[norm]
    times, relative = growth_curve(bases, 0.0, 0.6)
    dense = np.linspace(0, 0.6, 6001)
    exact = propagator_norm(bases, dense) * np.exp(-abscissa(bases) * dense)
    drawn = np.interp(dense, times, relative)
    assert np.quantile(np.abs(drawn / exact - 1), 0.95) < 0.02
    period = 2 * np.pi / np.median(np.diff(np.sort(bases[0].eigenvalues.imag)))
    edges = np.arange(0.25 * period, 0.6, period / 2)
    assert edges.size > 5
    for low, high in pairwise(edges):
        found = relative[(low <= times) & (times <= high)]
        expected = exact[(low <= dense) & (dense <= high)]
        # Samples are values of the curve: they can miss an extremum, not exceed it.
        assert found.max() > 0.99 * expected.max()
        assert found.min() < 1.01 * expected.min()


@pytest.mark.parametrize("norm", NORMS)
def test_half_the_step_changes_no_extremum(wedge_bases, norm):
    coarse, fine = (growth_curve(wedge_bases[norm], 0.05, 0.6, least)[1] for least in (300, 599))
    assert coarse.max() == pytest.approx(fine.max(), rel=0.01)
    assert coarse.min() == pytest.approx(fine.min(), rel=0.01)


def test_the_error_of_an_oscillation_includes_the_sampling(wedge_bases):
    few, error = oscillation(wedge_bases["discrete"], 0.2, 0.4, 5)
    many, _ = oscillation(wedge_bases["discrete"], 0.2, 0.4, 4001)
    assert few == pytest.approx(many, abs=max(3 * error, 0.01 * many))


@pytest.mark.parametrize(
    ("start", "stop", "least"), [(1.0, 1.0, 2), (-1.0, 1.0, 2), (0.0, np.inf, 2), (0.0, 1.0, 1)]
)
def test_sampling_asks_for_a_range(wedge_bases, start, stop, least):
    with pytest.raises(InvalidParameterError):
        growth_curve(wedge_bases["L2"], start, stop, least)


def test_a_growth_curve_asks_for_modes():
    with pytest.raises(InvalidParameterError, match="bases has no modes"):
        growth_curve([], 0.0, 1.0)
