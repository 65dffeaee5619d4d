"""The spectral abscissa by the paper's own algorithm."""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Complex
from hopper.errors import ConvergenceError
from hopper.radial.solution import RadialSolution
from hopper.spectral.matching import by_modulus, relative_changes
from hopper.stability.convergence_filter import require_finer
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.paper_matrix import Half, half_matrix, require_even


@dataclass(frozen=True)
class PaperAbscissa:
    """Largest real part that two meshes agree on.

    Attributes
    ----------
    as_worded : float
        Both parities, nearest neighbour within the tolerance, among the 2 n / pi eigenvalues of
        least modulus, which is what pi points per wavelength resolve: the paper's "about the first
        250" at n = 400.
    physical : float
        The flow's parity, one-to-one partner within the tolerance for this and every eigenvalue of
        smaller modulus.
    """

    as_worded: float
    physical: float


@checked
def paper_abscissa(
    solution: RadialSolution, n: int, coarse_n: int, tolerance: float
) -> PaperAbscissa:
    """Return the spectral abscissa by the paper's algorithm, from meshes of n and coarse_n nodes.

    Raises
    ------
    InvalidParameterError
        If a mesh is odd or too small, or the meshes are in the wrong order.
    ConvergenceError
        If nothing is kept.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.paper_abscissa import paper_abscissa
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> round(paper_abscissa(solution, 64, 48, tolerance=1e-3).physical, 3)
    -4.483
    """
    require_finer(n, coarse_n)
    fine = {half: _eigenvalues(solution, n, half) for half in HALVES}
    coarse = {half: _eigenvalues(solution, coarse_n, half) for half in HALVES}
    both = by_modulus(np.concatenate(list(fine.values())))[: int(2 * n / np.pi)]
    nearest = relative_changes(both, np.concatenate(list(coarse.values())), "nearest")
    change = relative_changes(fine["physical"], coarse["physical"], "one-to-one")
    run = np.logical_and.accumulate(change < tolerance)
    if not (run.any() and (nearest < tolerance).any()):
        raise ConvergenceError(
            f"no eigenvalue converged to {tolerance:g} between {coarse_n} and {n} nodes: use finer "
            "meshes or lower the wall friction"
        )
    return PaperAbscissa(
        as_worded=float(both[nearest < tolerance].real.max()),
        physical=float(fine["physical"][run].real.max()),
    )


def _eigenvalues(solution: RadialSolution, n: int, half: Half) -> Complex:
    require_even(n)
    return by_modulus(np.linalg.eigvals(half_matrix(solution, n // 2, half)).astype(complex))
