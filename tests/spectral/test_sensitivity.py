"""Sensitivity of kept modes by definition: perturbations, brute force, dense algebra."""

from functools import lru_cache

import numpy as np
import pytest
from scipy.linalg import block_diag, eig, expm

from hopper import schur_form
from hopper.errors import InvalidParameterError
from hopper.spectral.sensitivity import (
    kept_condition_numbers,
    kept_form,
    kept_sensitivity,
    resolvent_norm,
)
from hopper.spectral.transient import condition_number, modal_matrix, propagator_norm
from hopper.stability.paper_matrix import half_matrix
from hopper.stability.transient import half_weights
from tests.stability.kept_modes import (
    EPS,
    eigenvectors,
    kept_bases,
    kept_eigenvalues,
    matrix_norm,
    restricted,
)
from tests.stability.witnesses import radial

GEOMETRIES = ("wedge", "cone")
N = 64


@lru_cache(maxsize=4)
def bases(geometry):
    """Some twenty modes on a small mesh, of both parities for the wedge."""
    if geometry == "wedge":
        return kept_bases(geometry, "low", N, "discrete", 2.0)
    return kept_bases(geometry, "physical", N, "L2", 1.0)


@lru_cache(maxsize=4)
def operator(geometry):
    return block_diag(*[modal_matrix(basis) for basis in bases(geometry)])


@lru_cache(maxsize=4)
def sensitivity(geometry):
    return kept_sensitivity(bases(geometry))


def sigma_min(matrix, z):
    """Smallest singular values of z - M, by dense SVD."""
    shifted = np.atleast_1d(z)[:, None, None] * np.eye(len(matrix)) - matrix
    return np.linalg.svd(shifted, compute_uv=False)[:, -1]


def random_perturbation(random, n):
    """A complex matrix of 2-norm 1: full, or of rank one."""
    matrix = random.normal(size=(n, n, 2)).view(complex)[..., 0]
    if random.random() < 0.5:
        matrix = np.outer(matrix[0], matrix[1])
    return matrix / np.linalg.norm(matrix, 2)


# Condition numbers of eigenvalues.


@lru_cache(maxsize=4)
def weighted_matrix(geometry):
    solution = radial(geometry, 35, 10)
    root = np.sqrt(half_weights(solution.hopper, N // 2, "L2"))
    return root[:, None] * half_matrix(solution, N // 2) / root


def conditions(geometry):
    solution = radial(geometry, 35, 10)
    form = schur_form(half_matrix(solution, N // 2), half_weights(solution.hopper, N // 2, "L2"))
    kept = kept_eigenvalues(geometry, "physical", N)["physical"]
    return kept, kept_condition_numbers(form, kept)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_condition_numbers_by_definition(geometry):
    # Rows of V^-1 are the left eigenvectors with y* x = 1.
    values, vectors = eig(weighted_matrix(geometry))
    expected = np.linalg.norm(vectors, axis=0) * np.linalg.norm(np.linalg.inv(vectors), axis=1)
    kept, found = conditions(geometry)
    assert np.all(found >= 1)
    index = np.abs(kept[:, None] - values).argmin(axis=1)
    np.testing.assert_allclose(found, expected[index], rtol=EPS * np.linalg.cond(vectors) * 100)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_condition_numbers_bound_the_shift_and_are_attained(geometry):
    matrix, size = weighted_matrix(geometry), 1e-7
    kept, found = conditions(geometry)
    random = np.random.default_rng(5)
    # Second order in the perturbation, by the distance to the neighbours; and rounding.
    gap = np.abs(kept[:, None] - kept + 1e9 * np.eye(kept.size)).min()
    slack = len(matrix) * found * size * found.max() / gap
    slack += 4 * EPS * np.linalg.norm(matrix) * found / size
    assert slack.max() < 0.02 * found.min()

    def shifts(perturbation):
        values = np.linalg.eigvals(matrix + size * perturbation)
        return np.abs(kept[:, None] - values).min(axis=1) / size

    for _ in range(10):
        shift = shifts(random_perturbation(random, len(matrix)))
        assert np.all(shift <= found + slack)
    for i, value in enumerate(kept[kept.imag >= 0]):
        # Left and right null vectors: the worst perturbation is their outer product.
        u, _, vh = np.linalg.svd(value * np.eye(len(matrix)) - matrix)
        j = int(np.argmin(np.abs(kept - value)))
        attained = shifts(np.outer(u[:, -1], vh[-1]))[j]
        assert abs(attained - found[j]) <= slack[j], i


def test_condition_numbers_of_strangers():
    form = schur_form(np.diag([1.0, 2.0, 3.0]))
    assert kept_condition_numbers(form, np.array([3.0, 1.0 + 0j])).tolist() == [1, 1]
    with pytest.raises(InvalidParameterError, match="1 kept eigenvalues are not on this mesh"):
        kept_condition_numbers(form, np.array([3.0, 1.5 + 0j]))


# Distance to instability.


def least_on_the_axis(matrix, relative):
    """Smallest sigma_min(i y - M): bisect whatever may hold less, sigma_min being 1-Lipschitz."""
    top = 2 * np.linalg.norm(matrix, 2)  # sigma_min > ||M|| beyond
    half = top / 256
    y = np.arange(half, top, 2 * half)
    best = np.inf
    while True:
        value = sigma_min(matrix, 1j * y)
        best = min(best, value.min())
        if half < relative * best:
            return best
        y = y[value - half < best * (1 - relative)]
        half /= 2
        y = np.concatenate([y - half, y + half])


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_distance_by_brute_force(geometry):
    found = sensitivity(geometry)
    best = least_on_the_axis(operator(geometry), 1e-5)
    assert abs(found.distance / best - 1) < 2e-5
    assert sigma_min(operator(geometry), 1j * found.frequency) == pytest.approx(
        found.distance, rel=1e-8
    )
    assert found.frequency >= 0


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_perturbation_of_that_size_reaches_the_axis_and_no_smaller_one_does(geometry):
    matrix, found = operator(geometry), sensitivity(geometry)
    n, z = len(matrix), 1j * found.frequency
    u, s, vh = np.linalg.svd(z * np.eye(n) - matrix)
    worst = np.outer(u[:, -1], vh[-1])
    on_axis = np.linalg.eigvals(matrix + s[-1] * worst)
    assert np.abs(on_axis - z).min() < 100 * EPS * np.linalg.norm(matrix) * condition_number(
        bases(geometry)
    )

    def right(perturbation):
        return np.count_nonzero(np.linalg.eigvals(matrix + perturbation).real > 0)

    before = right(0 * worst)
    assert before == (0 if geometry == "cone" else n - 2)
    # On the way to the axis the eigenvalue stays on its side; beyond, it has changed it.
    assert [right(f * found.distance * worst) for f in (0.5, 0.99, 0.999)] == 3 * [before]
    assert right(1.01 * found.distance * worst) != before
    random = np.random.default_rng(2)
    for _ in range(60):
        assert right(0.999 * found.distance * random_perturbation(random, n)) == before


# Kreiss bound and resolvent.


def kreiss(matrix, alpha, offsets, heights):
    """Largest (Re z - alpha) / sigma_min(z - M) on a grid right of alpha."""
    z = alpha + np.array(offsets)[:, None] + 1j * np.array(heights)
    return ((z.real - alpha).ravel() / sigma_min(matrix, z.ravel())).max()


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_kreiss_bound_is_one(geometry):
    found = sensitivity(geometry).kreiss
    matrix = operator(geometry)
    alpha = np.linalg.eigvals(matrix).real.max()
    growth = max(
        np.exp(-alpha * t) * np.linalg.norm(expm(t * matrix), 2) for t in np.linspace(0, 1, 41)
    )
    assert 1 < found <= growth
    assert growth <= condition_number(bases(geometry))
    # It nearly attains the supremum: another grid finds little more or less.
    best = kreiss(matrix, alpha, np.logspace(-3, 3, 31), np.linspace(0, 350, 141))
    assert found == pytest.approx(best, rel=0.03)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_resolvent_norm_by_svd(geometry):
    y = np.linspace(-20, 400, 50)
    expected = 1 / sigma_min(operator(geometry), 1j * y)
    parts = [kept_form([basis]) for basis in bases(geometry)]
    for forms in (parts, [kept_form(bases(geometry))]):
        np.testing.assert_allclose(resolvent_norm(forms, y), expected, rtol=1e-6)
    assert resolvent_norm(parts, np.array([sensitivity(geometry).frequency])) == pytest.approx(
        1 / sensitivity(geometry).distance, rel=1e-6
    )


# The paper's case.


# Mode, norm, weight of psi; kappa(V), distance, Kreiss bound.
PAPER = ("paper", "discrete", 2.0)
PHYSICAL = ("physical", "L2", 1.0)


@pytest.mark.parametrize(
    ("geometry", "case", "kappa", "distance", "kreiss_bound"),
    [
        pytest.param("wedge", PAPER, 16.497, 0.23615, 2.8014, marks=pytest.mark.soak),
        pytest.param("wedge", PHYSICAL, 1.9434, 0.53452, 1.2278, marks=pytest.mark.soak),
        pytest.param("cone", PAPER, 224.92, 0.0073014, 27.733, marks=pytest.mark.soak),
        ("cone", PHYSICAL, 1.37412, 0.193045, 1.0502),
    ],
)
def test_numbers_of_figure_4_3(geometry, case, kappa, distance, kreiss_bound):
    formulation, norm, psi_scale = case
    kept = kept_eigenvalues(geometry, formulation, 400)
    found_bases = kept_bases(geometry, formulation, 400, norm, psi_scale)
    found = kept_sensitivity(found_bases)
    measured = condition_number(found_bases), found.distance, found.kreiss
    # Half a unit of the last digit.
    np.testing.assert_allclose(measured, [kappa, distance, kreiss_bound], rtol=5e-5)

    # Again, from eigenvectors of the whole matrix. Rounding of it, through kappa.
    rounding = 10 * EPS * matrix_norm(geometry, 400)
    every = np.concatenate(list(kept.values()))
    _, vectors = eigenvectors(geometry, 400, every, norm, psi_scale)
    assert abs(measured[0] / np.linalg.cond(vectors) - 1) < rounding * kappa
    halves = [
        restricted(*eigenvectors(geometry, 400, values, norm, psi_scale))
        for values in kept.values()
    ]
    assert min(sigma_min(half, 1j * found.frequency)[0] for half in halves) == pytest.approx(
        found.distance, abs=rounding * kappa
    )
    # A singular value of i y - M is d where the Hamiltonian matrix has the eigenvalue i y: none
    # below the distance, one above.
    for factor, crosses in ((1 - 1e-3, False), (1 + 1e-3, True)):
        level = factor * found.distance
        assert any(has_imaginary_eigenvalue(half, level) for half in halves) == crosses
    alpha = max(values.real.max() for values in kept.values())
    times = np.linspace(0, 5, 126)
    assert found.kreiss <= (propagator_norm(found_bases, times) * np.exp(-alpha * times)).max()
    best = max(kreiss(half, alpha, (0.02, 1, 20, 600), low_and_high(half)) for half in halves)
    assert found.kreiss == pytest.approx(best, rel=0.03)


def has_imaginary_eigenvalue(matrix, level):
    identity = level * np.eye(len(matrix))
    values = np.linalg.eigvals(np.block([[matrix, identity], [-identity, -matrix.conj().T]]))
    return bool(np.abs(values.real).min() < 1e-4 * level)


def low_and_high(matrix):
    """Im of the three lowest modes and of a high one."""
    heights = np.linalg.eigvals(matrix).imag
    return np.sort(heights[heights >= 0])[[0, 1, 2, -4]]
