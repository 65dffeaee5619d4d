"""Largest eigenvalues by batches, against those of dense matrices one by one."""

import numpy as np
import pytest

from hopper.spectral.lanczos import largest_eigenvalues

N = 60
CHECKS = (4, 8, 12, 16, 24, 32)
RNG = np.random.default_rng(3)


def start(dtype):
    return np.random.default_rng(0).standard_normal(N).astype(dtype)


def operators(dtype, spectra):
    """Matrices V diag(values) V^H of the given eigenvalues, with one orthonormal V."""
    entries = RNG.standard_normal((N, N))
    basis, _ = np.linalg.qr(entries + (1j * entries.T if dtype is complex else 0))
    diagonals = np.array(spectra, dtype=float).T

    def apply(vectors, diagonal):
        return basis @ (diagonal * (basis.conj().T @ vectors))

    return apply, diagonals


def separate(ratio):
    """Return eigenvalues from 1 on, each ``ratio`` times the one before."""
    return ratio ** np.arange(N)


@pytest.mark.parametrize("dtype", [float, complex])
def test_largest_where_few_are_near_it(dtype):
    spectra = [size * separate(ratio) for ratio in (0.1, 0.5, 0.8) for size in (1e-3, 1.0, 1e9)]
    apply, data = operators(dtype, spectra)
    tolerance = 1e-8
    found = largest_eigenvalues(apply, [data], start(dtype), tolerance, CHECKS)
    np.testing.assert_allclose(found, np.max(spectra, axis=1), rtol=tolerance)


@pytest.mark.parametrize("dtype", [float, complex])
def test_what_the_steps_do_not_resolve_is_missing(dtype):
    # Every eigenvalue of the second is within 1e-4 of the largest: five steps do not tell them.
    apply, data = operators(dtype, [separate(0.2), np.linspace(1, 1.0001, N)])
    found = largest_eigenvalues(apply, [data], start(dtype), 1e-8, (4, 8))
    assert found[0] == pytest.approx(1, rel=1e-8)
    assert np.isnan(found[1])
    loose = largest_eigenvalues(apply, [data], start(dtype), 1e-2, (4, 8))
    assert np.all(np.abs(loose / [1, 1.0001] - 1) < 1e-2)


def test_one_column_does_not_depend_on_its_company():
    spectra = [separate(ratio) for ratio in (0.1, 0.7, 0.9)]
    apply, data = operators(float, spectra)
    together = largest_eigenvalues(apply, [data], start(float), 1e-10, CHECKS)
    for column, value in zip(data.T, together, strict=True):
        (alone,) = largest_eigenvalues(apply, [column[:, None]], start(float), 1e-10, CHECKS)
        assert abs(alone / value - 1) < 1e-13


def test_multiples_of_the_identity_and_overflow():
    # Nothing is left after one step, whenever it is looked at.
    apply, data = operators(float, [np.full(N, value) for value in (0.0, 1.0, 3.0, 1e300)])
    with np.errstate(all="ignore"):
        found = largest_eigenvalues(apply, [data], start(float), 1e-8, CHECKS)
    np.testing.assert_allclose(found[:3], [0, 1, 3], rtol=1e-13)
    assert found[3] == np.inf or found[3] == pytest.approx(1e300, rel=1e-13)
