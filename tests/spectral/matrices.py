"""Matrices with known pseudospectra, and sigma_min by the SVD."""

import numpy as np
from scipy.linalg import toeplitz

RANDOM = np.random.default_rng(4)


def dense(matrix, z):
    """sigma_min(z I - matrix) by SVD, at all points at once."""
    shifted = np.asarray(z)[..., None, None] * np.eye(len(matrix)) - matrix
    return np.linalg.svd(shifted, compute_uv=False)[..., -1]


def complex_normal(*shape):
    return RANDOM.normal(size=shape) + 1j * RANDOM.normal(size=shape)


def grcar(n):
    return toeplitz([1, -1] + [0] * (n - 2), [1, 1, 1, 1] + [0] * (n - 4)).astype(float)


def jordan(n):
    return np.diag(np.ones(n - 1), 1)


def defective(centre, coupling):
    """2 x 2 block whose epsilon-pseudospectrum is a disc of radius sqrt(eps^2 + coupling eps)."""
    return np.array([[centre, coupling], [0, centre]])


def defective_sigma(radius, coupling):
    return np.sqrt(coupling**2 / 4 + radius**2) - coupling / 2
