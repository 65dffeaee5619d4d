"""The paper's algorithm as the paper does it: whole matrices, both parities, two meshes."""

import numpy as np
from scipy.linalg import eigvals

from hopper import RadialSolution
from hopper.arrays import Complex
from hopper.spectral.matching import relative_changes
from hopper.stability.paper_matrix import paper_matrix

MESHES = (400, 200)
TOLERANCE = 1e-3


def by_lapack(solution: RadialSolution) -> list[Complex]:
    """Eigenvalues of the matrices."""
    return [np.asarray(eigvals(paper_matrix(solution, n)), complex) for n in MESHES]


def by_the_paper(solution: RadialSolution) -> float:
    """Spectral abscissa of what both meshes agree on."""
    fine, coarse = by_lapack(solution)
    return float(fine[relative_changes(fine, coarse, "nearest") < TOLERANCE].real.max())
