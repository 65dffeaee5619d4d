"""Kept modes of the paper's case from its whole matrix, both parities in one, by dense algebra.

delta = 35 deg, half angle 10 deg, mu = 0. Weights of the norms are computed a second way.
"""

from functools import lru_cache

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.polynomial.legendre import leggauss
from scipy.linalg import eig, qr
from scipy.optimize import linear_sum_assignment

from hopper.spectral import chebyshev
from hopper.spectral.matching import unbroken_run
from hopper.stability.convergence_filter import convergence_filter
from hopper.stability.mesh_spectrum import HALVES, mesh_spectrum
from hopper.stability.paper_matrix import paper_matrix
from hopper.stability.transient import modal_basis
from tests.stability.witnesses import radial

EPS = float(np.finfo(float).eps)
TOLERANCE = 1e-3


@lru_cache(maxsize=8)
def _filtered(geometry, n):
    solution = radial(geometry, 35, 10)
    return convergence_filter(
        mesh_spectrum(solution, n), mesh_spectrum(solution, n // 2), TOLERANCE
    )


def kept_eigenvalues(geometry, formulation, n):
    """Eigenvalues on n nodes by parity, confirmed by n / 2 nodes.

    ``paper``: the first unbroken run by the filter as worded; ``physical``: sound filter;
    ``low``: all of modulus below 300, both parities, confirmed or not.
    """
    found = _filtered(geometry, n)
    values, half = found.fine.eigenvalues, found.fine.half
    if formulation == "physical":
        return {"physical": values[found.kept & (half == 0)]}
    if formulation == "low":
        chosen = np.abs(values) < 300
    else:
        chosen = np.zeros(values.size, dtype=bool)
        chosen[slice(*unbroken_run(found.kept_as_worded))] = True
    return {name: values[chosen & (half == code)] for code, name in enumerate(HALVES)}


def kept_bases(geometry, formulation, n, norm, psi_scale):
    """The package's bases of these modes."""
    solution = radial(geometry, 35, 10)
    kept = kept_eigenvalues(geometry, formulation, n)
    return [modal_basis(solution, n, half, kept[half], norm, psi_scale) for half in kept]


@lru_cache(maxsize=8)
def _all_modes(geometry, n):
    return eig(paper_matrix(radial(geometry, 35, 10), n))


@lru_cache(maxsize=8)
def matrix_norm(geometry, n):
    """Frobenius norm of the paper's matrix: rounding moves its eigenvalues by eps times this."""
    return float(np.linalg.norm(paper_matrix(radial(geometry, 35, 10), n)))


@lru_cache(maxsize=8)
def l2_weights(geometry, n):
    """Weights of the Chebyshev points that integrate T_0 ... T_(n-1) over [-1, 1].

    In a cone of half angle 10 deg with |sin(theta)| / sin(theta_w), by parity on one half.
    """
    degree = np.arange(n)
    if geometry == "wedge":
        moments = np.where(degree % 2, 0.0, 2 / (1.0 - degree * (degree + (degree == 1))))
    else:
        # Half of a circle, x = cos(a): T_j = cos(j a).
        angle, weight = leggauss(2 * n)
        angle, weight = np.pi / 4 * (1 + angle), np.pi / 4 * weight
        x, wall = np.cos(angle), np.radians(10)
        density = 2 * weight * np.sin(wall * x) / np.sin(wall) * np.sin(angle)
        moments = np.where(degree % 2, 0.0, np.cos(degree[:, None] * angle) @ density)
    return np.linalg.solve(chebvander(chebyshev.nodes(n), n - 1).T, moments)


def eigenvectors(geometry, n, kept, norm, psi_scale):
    """Eigenvalues (k,) and weighted unit eigenvectors (2 n - 2, k) of the whole matrix."""
    values, vectors = _all_modes(geometry, n)
    rows, columns = linear_sum_assignment(np.abs(kept[:, None] - values))
    assert np.abs(kept[rows] - values[columns]).max() < 1e-6 * np.abs(kept).max()
    weight = l2_weights(geometry, n) if norm == "L2" else np.ones(n)
    scale = np.sqrt(np.concatenate([weight, weight[1:-1]]))
    scale[n:] /= psi_scale
    weighted = scale[:, None] * vectors[:, columns]
    return values[columns], weighted / np.linalg.norm(weighted, axis=0)


def restricted(values, vectors):
    """M on the span of the eigenvectors, in an orthonormal basis of it."""
    r = qr(vectors, mode="r")[0][: values.size]
    return r * values @ np.linalg.inv(r)
