"""The Chebyshev matrix of d/dx with a boundary condition: what M of (4.2) is not like.

The operator has no eigenvalues, those of its matrices are artefacts of rounding and mesh [TT].

References
----------
.. [TT] L. N. Trefethen, M. R. Trummer, An instability phenomenon in spectral methods, SIAM J.
   Numer. Anal. 24 (1987).
"""

from math import log10

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.spectral import chebyshev
from hopper.spectral.matching import relative_changes
from hopper.spectral.pseudospectrum import eigenvalue_condition_numbers
from hopper.spectral.schur import schur_form


@checked
def first_derivative_matrix(n: int) -> Array:
    """Return d/dx on ``n`` nodes for functions that vanish at x = 1, shape (n - 1, n - 1)."""
    return chebyshev.differentiation_matrix(n)[:-1, :-1]


@checked
def largest_condition(n: int) -> float:
    """Return the largest condition number of an eigenvalue of the matrix on ``n`` nodes."""
    return float(eigenvalue_condition_numbers(schur_form(first_derivative_matrix(n)))[1].max())


@checked
def digits_lost(n: int) -> float:
    """Return the decimal digits that rounding costs the worst conditioned eigenvalue.

    The logarithm of its condition number on ``n`` nodes. It is a lower bound above about
    14, where double precision does not resolve the condition number itself.
    """
    return log10(largest_condition(n))


@checked
def agreeing_eigenvalues(n: int, coarse_n: int, tolerance: float) -> int:
    """Return how many eigenvalues on ``n`` nodes have a one-to-one partner on ``coarse_n``.

    Within the relative distance ``tolerance``.
    """
    fine, coarse = (
        np.linalg.eigvals(first_derivative_matrix(size)).astype(complex) for size in (n, coarse_n)
    )
    return int(np.sum(relative_changes(fine, coarse, "one-to-one") < tolerance))
