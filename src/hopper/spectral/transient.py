"""Transient growth on the kept part of a spectrum: the norm of exp(t M), t >= 0, and its bounds.

With the kept eigenvectors V = Q R, exp(t M) acts on their span as R exp(t Lambda) R^-1, and

    exp(t alpha) <= ||exp(t M)|| <= kappa(V) exp(t alpha),

where alpha is the largest real part and kappa(V) = ||V|| ||V^-1|| for columns of unit norm. Several
bases are those of parts of M that are orthogonal to each other.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf, pi

import numpy as np
import scipy

from hopper.arguments import RealLike, checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.spectral.matching import match_kept
from hopper.spectral.propagator import relative_norms
from hopper.spectral.sampling import refined
from hopper.spectral.scaling import exponent_of, represented, times_power
from hopper.spectral.schur import EPS, square, weight_roots

# Largest phase of a mode: rounding of it, in radians, stays below 1e-4.
_LARGEST_PHASE = 1e-4 / EPS
# How far lines between samples of a curve may be off, relative, and the most first samples.
_OFF_CHORD, _MOST_TIMES = 0.01, 2_000_000


@dataclass(frozen=True)
class ModalBasis:
    """Kept modes of one parity, orthonormalised.

    Attributes
    ----------
    eigenvalues : complex array, shape (k,)
        Closed under conjugation: real ones first, then each pair, Im > 0 before Im < 0.
    factor : array, shape (k, k)
        R of the real eigenvector basis: the eigenvector of each real eigenvalue, sqrt(2) times
        real and imaginary part of one of each pair, all eigenvectors of unit norm.
    """

    eigenvalues: Complex
    factor: Array

    __repr__ = brief("size", "abscissa")

    @property
    def size(self) -> int:
        """Number of modes k."""
        return self.eigenvalues.size

    @property
    def abscissa(self) -> float:
        """Largest real part."""
        return float(self.eigenvalues.real.max())


@checked
def basis_of(matrix: Array, weight: Array, kept: Complex) -> ModalBasis:
    """Return the basis of kept modes of a real matrix, in the norm ||u||^2 = sum_i w_i |u_i|^2.

    Parameters
    ----------
    matrix : array, shape (n, n)
        Real.
    weight : array, shape (n,)
        Positive.
    kept : complex array, shape (k,)
        Eigenvalues to keep, closed under conjugation.

    Raises
    ------
    InvalidParameterError
        If the matrix is not square or a weight not positive; if nothing is kept, a kept value is
        not an eigenvalue of the matrix, or the conjugate of one is not kept; or if the kept
        eigenvectors are linearly dependent to rounding.
    ConvergenceError
        If LAPACK finds no eigenvalues.

    Examples
    --------
    >>> from numpy import array, ones
    >>> from hopper.spectral.transient import basis_of
    >>> basis = basis_of(array([[1.0, 9.0], [0.0, 2.0]]), ones(2), array([1.0 + 0j, 2.0]))
    >>> basis.size, basis.abscissa
    (2, 2.0)
    """
    exponent = exponent_of(square("matrix", matrix))
    root = weight_roots(weight, len(matrix))
    try:
        scaled, vectors = scipy.linalg.eig(times_power(matrix, -exponent), check_finite=False)
    except np.linalg.LinAlgError as error:
        raise ConvergenceError(f"no eigenvalues of the matrix found: {error}") from None
    values = represented("eigenvalues", scaled, exponent)
    found = match_kept(kept, values)
    real = found[values[found].imag == 0]
    upper = found[values[found].imag > 0]
    if not kept.size:
        raise InvalidParameterError("kept is empty: keep at least one eigenvalue")
    if set(found) != set(match_kept(kept.conj(), values)):
        raise InvalidParameterError("kept eigenvalues are not closed under conjugation")
    weighted = root[:, None] * vectors
    weighted = weighted / np.linalg.norm(weighted, axis=0)
    columns = np.sqrt(2) * weighted[:, upper]
    pairs = np.stack([columns.real, columns.imag], axis=2).reshape(root.size, -1)
    (factor,) = scipy.linalg.qr(
        np.hstack([weighted[:, real].real, pairs]), mode="r", check_finite=False
    )
    factor = factor[: kept.size, : kept.size]
    singular = np.linalg.svd(factor, compute_uv=False)
    if not singular[-1] > EPS * singular[0]:
        raise InvalidParameterError(
            "kept eigenvectors are linearly dependent to rounding: keep one of each cluster"
        )
    ordered = np.stack([values[upper], values[upper].conj()], axis=1).reshape(-1)
    return ModalBasis(np.concatenate([values[real], ordered]), factor)


@checked
def modal_matrix(basis: ModalBasis) -> Array:
    """Return M restricted to the modes, in the orthonormal basis of their span, shape (k, k).

    Raises
    ------
    InvalidParameterError
        If an entry is outside the range of numbers.
    """
    exponent = exponent_of(basis.eigenvalues)
    values = times_power(basis.eigenvalues, -exponent)
    real = int(np.sum(values.imag == 0))
    diagonal = np.diag(values.real)
    index = np.arange(real, values.size, 2)
    diagonal[index, index + 1] = values[real::2].imag
    diagonal[index + 1, index] = -values[real::2].imag
    product = basis.factor @ diagonal
    entries = scipy.linalg.solve_triangular(
        basis.factor, product.T, trans="T", check_finite=False
    ).T
    return represented("the matrix of the modes", entries, exponent)


@checked
def condition_number(bases: Sequence[ModalBasis]) -> float:
    """Return kappa(V) of the modes of one or both parities together.

    Raises
    ------
    InvalidParameterError
        If no basis is given.

    Examples
    --------
    >>> from numpy import array, ones
    >>> from hopper.spectral.transient import basis_of, condition_number
    >>> basis = basis_of(array([[1.0, 9.0], [0.0, 2.0]]), ones(2), array([1.0 + 0j, 2.0]))
    >>> round(condition_number([basis]), 3)
    18.055
    """
    require_modes(bases)
    values = [np.linalg.svd(basis.factor, compute_uv=False) for basis in bases]
    return float(max(v[0] for v in values) / min(v[-1] for v in values))


@checked
def abscissa(bases: Sequence[ModalBasis]) -> float:
    """Return the largest real part among the modes of one or both parities, as above."""
    require_modes(bases)
    return max(basis.abscissa for basis in bases)


@checked
def propagator_norm(bases: Sequence[ModalBasis], elapsed: RealLike) -> Array:
    """Return ||exp(t M)|| on the span of the modes at t = ``elapsed`` >= 0, same shape.

    Raises
    ------
    InvalidParameterError
        If a time is negative or not finite, or no basis is given; or if a time is so long that the
        norm exceeds 1e308 or a phase is lost in rounding.

    Examples
    --------
    >>> from numpy import array, ones
    >>> from hopper.spectral.transient import basis_of, propagator_norm
    >>> basis = basis_of(array([[1.0, 9.0], [0.0, 2.0]]), ones(2), array([1.0 + 0j, 2.0]))
    >>> propagator_norm([basis], [0.0, 1.0]).round(4)
    array([ 1.    , 42.7653])
    """
    return _norm(bases, np.asarray(elapsed), 0.0)


@checked
def require_modes(bases: Sequence[ModalBasis]) -> None:
    """Check that there are modes.

    Raises
    ------
    InvalidParameterError
        If there are none.
    """
    if not bases:
        raise InvalidParameterError("bases has no modes: give the basis of at least one parity")


def _norm(bases: Sequence[ModalBasis], times: Array, rate: float) -> Array:
    """Return exp(-rate t) ||exp(t M)||."""
    require_modes(bases)
    if not np.all(times >= 0):
        raise InvalidParameterError("elapsed times must be finite and not negative: elapsed = -t")
    longest = float(times.max(initial=0.0))
    highest = _highest(bases)
    if highest * longest > _LARGEST_PHASE:
        raise InvalidParameterError(
            f"elapsed = {longest:.6g} is too long: the phases of the modes, up to "
            f"{highest * longest:.1e}, are lost in rounding; give shorter times"
        )
    flat = times.ravel()
    norm = np.zeros(flat.size)
    bounds = [condition_number([basis]) for basis in bases]
    for index in np.argsort(bounds)[::-1]:
        kappa, basis = bounds[index], bases[index]
        with np.errstate(over="ignore"):
            growth = np.exp((basis.abscissa - rate) * flat)
            # Where its bound is below the norm of another part, a part does not matter.
            (open_,) = np.nonzero(kappa * growth >= norm)
            relative = relative_norms(basis.factor, basis.eigenvalues, flat[open_])
            norm[open_] = np.maximum(norm[open_], growth[open_] * relative)
    if not np.isfinite(norm).all():
        raise InvalidParameterError(
            f"elapsed = {longest:.6g} is too long: the norm exceeds 1e308; give shorter times"
        )
    return norm.reshape(times.shape)


@checked
def growth_curve(
    bases: Sequence[ModalBasis], start: float, stop: float, least: int = 2
) -> tuple[Array, Array]:
    """Return times from start to stop, and exp(-t alpha) ||exp(t M)|| at them.

    The first times are half a period of the fastest mode apart, as that is what makes peaks and
    dips, and ``least`` at least; where lines between them are off by more than 1 % in the middle
    there are more, so that the drawn curve is the curve.

    Returns
    -------
    times, relative : array, shape (n,)

    Raises
    ------
    InvalidParameterError
        If a time is negative, not finite or too long for the phases, stop is not above start, least
        is below 2, or there is no basis.
    """
    _require_times({"start": start, "stop": stop})
    if stop <= start or least < 2:
        raise InvalidParameterError(
            f"start = {start}, stop = {stop}, least = {least}: stop must be above start, and least "
            "at least 2"
        )
    highest, alpha = _highest(bases), abscissa(bases)
    _norm(bases, np.array([stop]), alpha)
    halves = ceil(min(highest * (stop - start) / pi, _MOST_TIMES))
    first = np.linspace(start, stop, (least - 1) * max(1, ceil(halves / (least - 1))) + 1)
    return refined(lambda times: _norm(bases, times, alpha), first, _OFF_CHORD)


def _require_times(times: dict[str, float]) -> None:
    for name, value in times.items():
        if not 0 <= value < inf:
            raise InvalidParameterError(f"{name} = {value} must be finite and not negative")


def _highest(bases: Sequence[ModalBasis]) -> float:
    require_modes(bases)
    return max(float(np.abs(basis.eigenvalues.imag).max()) for basis in bases)


@checked
def oscillation(
    bases: Sequence[ModalBasis], start: float, length: float, points: int
) -> tuple[float, float]:
    """Return how much exp(-t alpha) ||exp(t M)|| varies over [start, start + length] of t.

    Parameters
    ----------
    bases : sequence of ModalBasis
        Of one or both parities.
    start, length : float
        Not negative; ``length`` should cover a few periods.
    points : int
        Least number of times, at least 3; there are as many as :func:`growth_curve` needs.

    Returns
    -------
    amplitude, error : float
        Largest minus least over the mean in time, and its change from half of the times.

    Raises
    ------
    InvalidParameterError
        If a time is negative, not finite or too long for the phases; if there are fewer than three
        points; or if no basis is given.
    """
    _require_times({"start": start, "length": length, "start + length": start + length})
    if points < 3:
        raise InvalidParameterError(f"points = {points} times: give at least 3")
    times, relative = growth_curve(bases, start, start + length, points)

    def amplitude(step: int) -> float:
        t, y = times[::step], relative[::step]
        return float(np.ptp(y) * np.ptp(t) / np.trapezoid(y, t))

    fine = amplitude(1)
    return fine, abs(fine - amplitude(2))
