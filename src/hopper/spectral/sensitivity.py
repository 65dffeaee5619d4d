"""How sensitive the kept part of the spectrum is, and how far the verdict of stability stands."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.spectral.matching import match_kept
from hopper.spectral.pseudospectrum import (
    eigenvalue_condition_numbers,
    kreiss_lower_bound,
    pseudospectrum,
    smallest_singular_values,
)
from hopper.spectral.robust_stability import distance_to_instability
from hopper.spectral.schur import SchurForm, schur_form
from hopper.spectral.transient import ModalBasis, modal_matrix

# Offsets from the abscissa, relative to it or to 1, scanned for the Kreiss bound.
_OFFSETS = np.logspace(-2, 2, 25)
_HEIGHTS = 201


@dataclass(frozen=True)
class KeptSensitivity:
    """Measures of non-normality of M restricted to kept modes, in the norm of their basis.

    Attributes
    ----------
    distance : float
        Size of the smallest perturbation of the restricted operator that puts an eigenvalue on
        the imaginary axis: every smaller one leaves the verdict of stability standing.
    frequency : float
        Im(z) at which it is attained.
    kreiss : float
        Lower bound of sup over t of exp(t alpha) ||exp(-t M)||, from the resolvent right of the
        abscissa.
    """

    distance: float
    frequency: float
    kreiss: float

    __repr__ = brief("distance", "frequency", "kreiss")


def kept_form(bases: list[ModalBasis]) -> SchurForm:
    """Return the Schur form of M restricted to the modes of one or both parities."""
    return schur_form(block_diag(*[modal_matrix(basis) for basis in bases]))


def kept_sensitivity(bases: list[ModalBasis]) -> KeptSensitivity:
    """Return the measures of the modes of one or both parities together.

    Raises
    ------
    ConvergenceError
        If the level-set iteration for the distance does not converge.
    """
    parts = [schur_form(modal_matrix(basis)) for basis in bases]
    distance, frequency = min(distance_to_instability(part) for part in parts)
    alpha = max(basis.abscissa for basis in bases)
    real = alpha + max(1.0, abs(alpha)) * _OFFSETS
    highest = max(float(basis.eigenvalues.imag.max()) for basis in bases)
    imag = np.linspace(0, max(highest, 1.0), _HEIGHTS)
    kreiss = max(kreiss_lower_bound(pseudospectrum(part, real, imag), alpha)[0] for part in parts)
    return KeptSensitivity(distance, abs(frequency), kreiss)


def resolvent_norm(forms: list[SchurForm], frequencies: NDArray[np.floating]) -> Array:
    """Return ||(i y - M)^-1|| at the frequencies y of an operator split into the given parts."""
    lowest = np.min([smallest_singular_values(form, 1j * frequencies) for form in forms], axis=0)
    return 1 / lowest


def kept_condition_numbers(form: SchurForm, kept: Complex) -> Array:
    """Return the condition numbers of the kept eigenvalues of a matrix, shape (k,).

    Raises
    ------
    InvalidParameterError
        If a kept eigenvalue is not one of the matrix.
    """
    values, conditions = eigenvalue_condition_numbers(form)
    found = match_kept(kept, values)
    return conditions[found]
