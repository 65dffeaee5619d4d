"""Discrete spectrum of M on a mesh.

The matrix of the full interval is split by parity into its two halves before its eigenvalues are
computed: the same spectrum at a quarter of the work, each eigenvalue with its parity.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from hopper.arguments import checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.stability.paper_matrix import Half, half_matrix, require_even

HALVES: tuple[Half, Half] = ("physical", "mirrored")
_LEAST_NODES = 16


@dataclass(frozen=True)
class MeshSpectrum:
    """All eigenvalues of M on a mesh, by increasing modulus.

    Attributes
    ----------
    n : int
        Nodes on the full interval.
    eigenvalues : complex array, shape (2 n - 2,)
    half : integer array, shape (2 n - 2,)
        Index into ``HALVES``: 0 physical (sigma1 even, psi1 odd), 1 mirrored.
    tail : array, shape (2 n - 2,)
        Largest of the last tenth of the eigenvector's Chebyshev coefficients over the largest of
        all: small where the mesh resolves the eigenvector.
    """

    n: int
    eigenvalues: Complex
    half: NDArray[np.int8]
    tail: Array

    __repr__ = brief("n", "eigenvalues", "tail")


@checked
def mesh_spectrum(solution: RadialSolution, n: int) -> MeshSpectrum:
    """Return the spectrum of M on ``n`` nodes of the full interval.

    Raises
    ------
    InvalidParameterError
        If n is odd or less than 16.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.mesh_spectrum import mesh_spectrum
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> mesh_spectrum(solution, 48).eigenvalues.size
    94
    """
    require_even(n)
    if n < _LEAST_NODES:
        raise InvalidParameterError(f"n = {n} nodes are too few to filter: use {_LEAST_NODES}")
    values, tails = [], []
    for half in HALVES:
        value, vectors = scipy.linalg.eig(half_matrix(solution, n // 2, half), check_finite=False)
        values.append(value)
        tails.append(_tails(vectors, half))
    halves = np.repeat(np.arange(2, dtype=np.int8), n - 1)
    eigenvalues = np.concatenate(values)
    order = np.argsort(np.abs(eigenvalues), kind="stable")
    return MeshSpectrum(n, eigenvalues[order], halves[order], np.concatenate(tails)[order])


def _tails(vectors: Complex, half: Half) -> Array:
    """Return the tail of each eigenvector, the larger of its two components', shape (2 m - 1,)."""
    m = (len(vectors) + 1) // 2
    sigma = vectors[:m]
    psi = np.vstack([vectors[m:], np.zeros((1, vectors.shape[1]))])
    even, odd = (sigma, psi) if half == "physical" else (psi, sigma)
    last = m - max(1, m // 10)
    tails = []
    for part, parity in ((even, "even"), (odd, "odd")):
        size = np.abs(chebyshev.half_coefficients(part, parity))  # type: ignore[arg-type]
        tails.append(size[last:].max(axis=0) / size.max(axis=0))
    return np.maximum(*tails)
