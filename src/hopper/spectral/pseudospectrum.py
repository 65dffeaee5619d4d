"""Pseudospectra of dense matrices: sigma_min(z I - M) on grids, and what follows from them.

The epsilon-pseudospectrum is the set of z with sigma_min(z I - M) < epsilon [TE]. One Schur form
serves all z. sigma_min comes from inverse Lanczos iteration on it [Lui, Tr], at many points
together: the off-diagonal part of a back-substitution does not depend on z, so it is one matrix
product for all of them.

Rounding limits sigma_min to an absolute error of a few eps ||M||, as in any dense method.

References
----------
.. [TE] L. N. Trefethen, M. Embree, Spectra and Pseudospectra, Princeton (2005).
.. [Lui] S. H. Lui, Computation of pseudospectra by continuation, SIAM J. Sci. Comput. 18 (1997).
.. [Tr] L. N. Trefethen, Computation of pseudospectra, Acta Numerica 8 (1999).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eig

from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.spectral.schur import SchurForm, back_substitute, divisors_of

Progress = Callable[[int, int], None]

# Entries (points times n) and points of a batch. Fast at n = 100 to 800.
_BATCH_ENTRIES, _BATCH_POINTS = 2**19, 2048
_LANCZOS_STEPS = 65


def _dot(x: Complex, y: Complex) -> Array:
    """Return the real parts of the columns' inner products, shape (points,)."""
    return np.einsum("ij,ij->j", x.view(float), y.view(float)).reshape(-1, 2).sum(axis=1)


def _largest_ritz(alpha: Array, beta: Array) -> tuple[Array, Array]:
    """Return the largest eigenvalue and the |last component| of its vector, shape (points,) each.

    The tridiagonal matrices have diagonals ``alpha``, shape (k, points), and ``beta`` beside them.
    """
    k, points = alpha.shape
    i = np.arange(k)
    lower = np.zeros((points, k, k))
    lower[:, i, i] = alpha.T
    lower[:, i[1:], i[:-1]] = beta[: k - 1].T
    ritz, vectors = np.linalg.eigh(lower)
    return ritz[:, -1], np.abs(vectors[:, -1, -1])


def _apply_inverse(form: SchurForm, divisors: Complex, adjoint: Complex, q: Complex) -> Complex:
    """Return ((z I - T)^H (z I - T))^-1 q, column by column."""
    v = q[::-1].copy()
    back_substitute(form.adjoint_panels, adjoint, v)
    v = v[::-1].copy()
    back_substitute(form.panels, divisors, v)
    return v


def _by_svd(form: SchurForm, z: complex) -> float:
    shifted = z * np.eye(len(form.triangle)) - form.triangle
    return float(np.linalg.svd(shifted, compute_uv=False)[-1])


def _lanczos(form: SchurForm, z: Complex, tolerance: float) -> Array:
    """Return sigma_min at one batch of points, shape (points,)."""
    n = len(form.triangle)
    sigma, active = np.zeros(z.size), np.arange(z.size)
    divisors = divisors_of(form.panels, z, form.rounding)
    adjoint = divisors_of(form.adjoint_panels, z.conj(), form.rounding)
    start = np.random.default_rng(0).standard_normal((n, 2)).view(complex)
    q = np.repeat(start / np.linalg.norm(start), z.size, axis=1)
    previous = np.zeros_like(q)
    # Without reorthogonalisation: its price, copies of converged values, spares the largest.
    alpha, beta = np.zeros((2, _LANCZOS_STEPS, z.size))
    for k in range(_LANCZOS_STEPS):
        v = _apply_inverse(form, divisors, adjoint, q)
        v -= beta[k - 1] * previous
        alpha[k] = _dot(q, v)
        v -= alpha[k] * q
        beta[k] = np.sqrt(_dot(v, v))
        overflown = ~np.isfinite(beta[k])  # 1 / sigma^2 > 1e154: sigma_min stays 0
        alpha[k, overflown] = beta[k, overflown] = 0.0
        previous, q = q, v / beta[k]
        if k >= 16 and k % 8:  # the small eigenproblems have become a cost
            continue
        value, last = _largest_ritz(alpha[: k + 1], beta[: k + 1])
        # The residual of the Ritz pair bounds the error; the change of sigma can pause. Rounding
        # leaves some of the residual in place.
        noise = np.minimum(form.rounding * np.sqrt(value), 0.01)
        done = beta[k] * last <= (tolerance + noise) * value
        found = done & ~overflown
        sigma[active[found]] = 1 / np.sqrt(value[found])
        if done.all():
            return sigma
        if done.any():
            active = active[~done]
            alpha, beta, q, previous, divisors, adjoint = (
                np.compress(~done, array, axis=1)
                for array in (alpha, beta, q, previous, divisors, adjoint)
            )
    # Rare: crowded singular values, as of a normal matrix far from its spectrum.
    for i in active:
        sigma[i] = _by_svd(form, z[i])
    return sigma


def smallest_singular_values(
    form: SchurForm, z: ArrayLike, tolerance: float = 1e-6, progress: Progress | None = None
) -> Array:
    """Return sigma_min(z I - M) at each point.

    Points far from the spectrum take the most iterations. The start vectors are fixed, so results
    repeat. Working memory stays below 300 MB up to n = 1000, whatever the number of points.

    Parameters
    ----------
    form : SchurForm
        From :func:`schur_form`.
    z : array of complex, any shape
        For a real matrix z and conj(z) have the same value: give one of them.
    tolerance : float
        Bound on the residual of the Lanczos estimate of 1 / sigma_min^2, relative to it, above
        rounding. A singular value lies within half of it, relative; as the error is of second
        order, usually far closer. At 1e-4 and above it may not be the smallest one of a cluster.
    progress : callable(done, total), optional
        Called after each batch with numbers of points.

    Returns
    -------
    array, shape of ``z``
        Nonnegative; of rounding size at an eigenvalue, 0 where 1 / sigma_min^2 exceeds 1e154.

    Raises
    ------
    InvalidParameterError
        If a point is not finite or the tolerance is not in (0, 1).
    """
    points = np.asarray(z, dtype=complex)
    if not np.isfinite(points).all():
        raise InvalidParameterError("z must be finite: remove NaN and inf")
    if not 0 < tolerance < 1:
        raise InvalidParameterError(f"tolerance = {tolerance} is out of range: use 0 < value < 1")
    flat = points.ravel()
    sigma = np.empty(flat.size)
    batch = max(1, min(_BATCH_POINTS, _BATCH_ENTRIES // len(form.triangle)))
    for start in range(0, flat.size, batch):
        stop = min(start + batch, flat.size)
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            sigma[start:stop] = _lanczos(form, flat[start:stop], tolerance)
        if progress is not None:
            progress(stop, flat.size)
    return sigma.reshape(points.shape)


@dataclass(frozen=True, eq=False)
class Pseudospectrum:
    """``sigma_min``, shape (ny, nx), of z I - M at z = ``real`` (nx,) + i ``imag`` (ny,)."""

    real: Array
    imag: Array
    sigma_min: Array

    __repr__ = brief("real", "imag", "sigma_min")


def pseudospectrum(
    form: SchurForm, real: ArrayLike, imag: ArrayLike, progress: Progress | None = None
) -> Pseudospectrum:
    """Return sigma_min on the grid of points real + i imag.

    For a real matrix, conjugate rows are computed once.

    Parameters
    ----------
    form : SchurForm
        From :func:`schur_form`.
    real, imag : array, shape (nx,) and (ny,)
        Increasing, at least two values each.
    progress : callable(done, total), optional
        As in :func:`smallest_singular_values`.

    Raises
    ------
    InvalidParameterError
        If an axis has fewer than two values, is not finite or not increasing.
    """
    x, y = _axis("real", real), _axis("imag", imag)
    heights, source = y, np.arange(y.size)
    if form.is_real:
        # The two sides of a symmetric axis are often equal to rounding only.
        rounded = np.round(np.abs(y) / np.abs(y).max(), 14)
        levels, first = np.unique(rounded, return_index=True)
        heights, source = y[first], np.searchsorted(levels, rounded)
    sigma = smallest_singular_values(form, x + 1j * heights[:, None], progress=progress)
    return Pseudospectrum(x, y, sigma[source])


def _axis(name: str, values: ArrayLike) -> Array:
    axis = np.asarray(values, dtype=float)
    if axis.ndim != 1 or axis.size < 2:
        raise InvalidParameterError(f"{name} has shape {axis.shape}: give at least two values")
    if not np.isfinite(axis).all():
        raise InvalidParameterError(f"{name} must be finite: remove NaN and inf")
    if (np.diff(axis) <= 0).any():
        raise InvalidParameterError(f"{name} must increase: sort it, without repeated values")
    return axis


def kreiss_lower_bound(grid: Pseudospectrum, shift: float = 0.0) -> tuple[float, complex]:
    """Return the largest (Re z - shift) / sigma_min(z) over the grid's Re z > shift, and its z.

    A lower bound of sup ||exp(t (M - shift I))|| over t >= 0 [TE, section 14].

    Raises
    ------
    InvalidParameterError
        If no grid point has Re z > shift.
    """
    right = grid.real > shift
    if not right.any():
        raise InvalidParameterError(
            f"real ends at {grid.real[-1]:.6g}: extend the grid beyond shift = {shift:.6g}"
        )
    with np.errstate(divide="ignore"):
        ratio = (grid.real[right] - shift) / grid.sigma_min[:, right]
    row, column = np.unravel_index(np.argmax(ratio), ratio.shape)
    return float(ratio[row, column]), complex(grid.real[right][column], grid.imag[row])


def eigenvalue_condition_numbers(form: SchurForm) -> tuple[Complex, Array]:
    """Return the eigenvalues and their condition numbers ||x|| ||y|| / |y* x|, shape (n,) each.

    x and y are right and left eigenvectors, norms those of the form [TE]. That of a
    defective eigenvalue is infinite, or merely huge through rounding.
    """
    result: Any = eig(form.triangle, left=True, right=True)  # the stubs miscount
    values, left, right = result
    with np.errstate(divide="ignore"):
        return values.astype(complex), 1 / np.abs(np.einsum("ij,ij->j", left.conj(), right))
