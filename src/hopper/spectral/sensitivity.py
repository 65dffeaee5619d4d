"""How sensitive the kept part of the spectrum is, and how far the verdict of stability stands."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
import scipy

from hopper.arguments import RealLike, checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.spectral.matching import match_kept
from hopper.spectral.pseudospectrum import eigenvalue_condition_numbers, smallest_singular_values
from hopper.spectral.robust_stability import distance_to_instability
from hopper.spectral.sampling import refined
from hopper.spectral.schur import SchurForm, schur_form
from hopper.spectral.transient import ModalBasis, modal_matrix, require_modes

# Offsets from the abscissa scanned for the Kreiss bound, relative to the spread of eigenvalues.
_OFFSETS = np.logspace(-6, 0, 37)
# Computed singular values are off by a few times eps ||M||.
_NOISE = 8.0
# How far lines between samples of a curve may be off, relative.
_OFF_CHORD = 0.01


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


@checked
def kept_form(bases: Sequence[ModalBasis]) -> SchurForm:
    """Return the Schur form of M restricted to the modes of one or both parities.

    Raises
    ------
    InvalidParameterError
        If no basis is given.
    """
    require_modes(bases)
    return schur_form(scipy.linalg.block_diag(*[modal_matrix(basis) for basis in bases]))


@checked
def kept_sensitivity(bases: Sequence[ModalBasis]) -> KeptSensitivity:
    """Return the measures of the modes of one or both parities together.

    Raises
    ------
    InvalidParameterError
        If no basis is given.
    ConvergenceError
        If the level-set iteration for the distance does not converge.
    """
    require_modes(bases)
    parts = [schur_form(modal_matrix(basis)) for basis in bases]
    distance, frequency = min(distance_to_instability(part) for part in parts)
    alpha = max(basis.abscissa for basis in bases)
    spread = max(float(np.abs(basis.eigenvalues - alpha).max()) for basis in bases)
    real = alpha + (spread or abs(alpha)) * _OFFSETS
    kreiss = max(_kreiss(part, real, alpha) for part in parts)
    return KeptSensitivity(distance, abs(frequency), kreiss)


def _kreiss(form: SchurForm, real: Array, alpha: float) -> float:
    """Return the largest (x - alpha) / sigma_min(x + i y), at least 1, its limit for large x.

    The y are the imaginary parts of the eigenvalues and midpoints between them.
    """
    heights = np.unique(np.append(np.abs(form.eigenvalues.imag), 0.0))
    heights = np.concatenate([heights, (heights[1:] + heights[:-1]) / 2])
    sigma = smallest_singular_values(form, real + 1j * heights[:, None])
    with np.errstate(invalid="ignore"):  # 0 / 0 of the zero matrix
        ratio = (real - alpha) / (sigma + _NOISE * form.rounding)
    return max(1.0, float(np.nan_to_num(ratio).max()))


@checked
def resolvent_norm(forms: Sequence[SchurForm], frequencies: RealLike) -> Array:
    """Return ||(i y - M)^-1|| at the frequencies y of an operator split into the given parts.

    It is infinite where sigma_min is 0.

    Raises
    ------
    InvalidParameterError
        If no part is given, or a frequency is not finite.

    Examples
    --------
    >>> from hopper import schur_form
    >>> from hopper.spectral.sensitivity import resolvent_norm
    >>> resolvent_norm([schur_form([[1.0, 9.0], [0.0, 2.0]])], [0.0, 1.0]).round(4)
    array([4.6356, 2.9646])
    """
    if not forms:
        raise InvalidParameterError("forms is empty: give the form of at least one part")
    points = 1j * np.asarray(frequencies)
    lowest = np.min([smallest_singular_values(form, points) for form in forms], axis=0)
    with np.errstate(divide="ignore"):
        return np.asarray(1 / lowest)


@checked
def resolvent_curves(
    operators: Sequence[Sequence[SchurForm]], stop: float, least: int = 2
) -> tuple[Array, Array]:
    """Return frequencies y from 0 to stop, and ||(i y - M)^-1|| of several operators at them.

    Among the frequencies are those of the eigenvalues, where the peaks are, and as many between
    them as it takes for lines between the samples to be within 1 % of the curves.

    Parameters
    ----------
    operators : sequence of sequences of SchurForm
        The parts of each.
    stop : float
        Positive.
    least : int
        Number of equally spaced frequencies that there are in any case, at least 2.

    Returns
    -------
    frequencies, norms : array, shape (n,) and (number of operators, n)

    Raises
    ------
    InvalidParameterError
        If stop is not positive, least is below 2, there is no operator, or one has no parts.
    """
    if not (0 < stop < inf and least >= 2 and operators):
        raise InvalidParameterError(
            f"stop = {stop}, least = {least}, {len(operators)} operators: stop must be finite and "
            "positive, least at least 2, and there must be an operator"
        )
    heights = [np.abs(form.eigenvalues.imag) for parts in operators for form in parts]
    even = np.linspace(0, stop, least)
    peaks = np.concatenate([even[:0], *heights])
    # Eigenvalues of two operators that are equal but for rounding are one frequency.
    places = np.unique(np.append(even, np.round(peaks[peaks < stop] / stop, 9) * stop))
    return refined(
        lambda y: np.stack([resolvent_norm(parts, y) for parts in operators]), places, _OFF_CHORD
    )


@checked
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
