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
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig, rsf2csf, schur

from hopper.chebyshev import Array
from hopper.errors import InvalidParameterError

Complex = NDArray[np.complex128]
Numbers = NDArray[Any]  # float64 or complex128
Progress = Callable[[int, int], None]

_EPS = float(np.finfo(float).eps)
# Order of a diagonal block; entries (points times n) and points of a batch. Fast at n = 100 to 800.
_BLOCK = 24
_BATCH_ENTRIES, _BATCH_POINTS = 2**19, 2048
_LANCZOS_STEPS = 65


@dataclass(frozen=True, eq=False)
class _Panel:
    """Rows [start, stop) of a triangle: ``basis @ block @ basis^H``, then ``right`` of it."""

    start: int
    stop: int
    block: Complex
    basis: Complex
    right: Numbers


@dataclass(frozen=True, eq=False)
class SchurForm:
    """A matrix prepared for any number of points z; made by :func:`schur_form`.

    Attributes
    ----------
    triangle : array, shape (n, n)
        Schur form in the weighted norm: real and quasi-triangular for a real matrix.
    panels, adjoint_panels : tuple
        ``triangle``, and its adjoint flipped to be upper triangular, cut into rows.
    """

    triangle: Numbers
    panels: tuple[_Panel, ...]
    adjoint_panels: tuple[_Panel, ...]

    @property
    def is_real(self) -> bool:
        """Whether the matrix is real; sigma_min is then equal at z and conj(z)."""
        return not np.iscomplexobj(self.triangle)

    @property
    def eigenvalues(self) -> Complex:
        """Eigenvalues, shape (n,), as on the diagonal."""
        return np.concatenate([np.diag(panel.block) for panel in self.panels])

    @property
    def rounding(self) -> float:
        """The Frobenius norm times eps: a smaller sigma_min is rounding."""
        return _EPS * float(np.linalg.norm(self.triangle))


def schur_form(matrix: ArrayLike, weight: ArrayLike | None = None) -> SchurForm:
    """Return the prepared form of a square matrix M, in O(n^3) operations.

    Parameters
    ----------
    matrix : array, shape (n, n)
        Real or complex. A real one costs half as much, here and for each point.
    weight : array, shape (n,), optional
        Positive w of the norm ||u||^2 = sum_i w_i |u_i|^2; default: 1. Everything computed from
        the form then means W^(1/2) M W^(-1/2).

    Raises
    ------
    InvalidParameterError
        If the matrix is not square, a value is not finite, or a weight is not positive.
    """
    a = np.array(matrix, dtype=complex if np.iscomplexobj(matrix) else float)
    if a.ndim != 2 or a.shape[0] != a.shape[1] or not a.size:
        raise InvalidParameterError(f"matrix has shape {a.shape}: it must be square")
    if not np.isfinite(a).all():
        raise InvalidParameterError("matrix must be finite: remove NaN and inf")
    if weight is not None:
        w = np.asarray(weight, dtype=float)
        if w.shape != (len(a),):
            raise InvalidParameterError(f"weight has shape {w.shape}: it must be ({len(a)},)")
        if not (np.isfinite(w).all() and w.min() > 0):
            raise InvalidParameterError("weight must be positive and finite everywhere")
        a *= np.sqrt(w)[:, None] / np.sqrt(w)
    triangle = np.ascontiguousarray(schur(a, "complex" if np.iscomplexobj(a) else "real")[0])
    flipped = np.ascontiguousarray(triangle.conj().T[::-1, ::-1])
    return SchurForm(triangle, _panels(triangle), _panels(flipped))


def _panels(triangle: Numbers) -> tuple[_Panel, ...]:
    panels = []
    start, n = 0, len(triangle)
    while start < n:
        stop = min(start + _BLOCK, n)
        stop += stop < n and triangle[stop, stop - 1] != 0  # keep a 2 x 2 block whole
        block, basis = rsf2csf(triangle[start:stop, start:stop], np.eye(stop - start))
        block, basis = (np.ascontiguousarray(part, dtype=complex) for part in (block, basis))
        panels.append(_Panel(start, stop, block, basis, triangle[start:stop, stop:]))
        start = stop
    return tuple(panels)


def _product(matrix: Numbers, vectors: Complex) -> Complex:
    if np.iscomplexobj(matrix):
        return matrix @ vectors
    # A real matrix acts on real and imaginary parts as on twice as many real vectors.
    return (matrix @ vectors.view(float)).view(complex)


def _divisors(panels: tuple[_Panel, ...], z: Complex, floor: float) -> Complex:
    """Return 1 / (z - t_ii), shape (n, points), bounded where z is an eigenvalue to rounding."""
    gap = z - np.concatenate([np.diag(panel.block) for panel in panels])[:, None]
    gap[np.abs(gap) < floor] = floor
    return 1 / gap


def _solve(panels: tuple[_Panel, ...], divisors: Complex, x: Complex) -> None:
    """Overwrite ``x``, shape (n, points), by the solution of (z I - T) y = x, column by column."""
    for panel in reversed(panels):
        rows = x[panel.start : panel.stop]
        rows += _product(panel.right, x[panel.stop :])
        y = panel.basis.conj().T @ rows
        for i in reversed(range(len(y))):
            y[i] += panel.block[i, i + 1 :] @ y[i + 1 :]
            y[i] *= divisors[panel.start + i]
        np.matmul(panel.basis, y, out=rows)


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


def _lanczos(form: SchurForm, z: Complex, tolerance: float) -> Array:
    """Return sigma_min at one batch of points, shape (points,)."""
    n = len(form.triangle)
    sigma, active = np.zeros(z.size), np.arange(z.size)
    divisors = _divisors(form.panels, z, form.rounding)
    adjoint = _divisors(form.adjoint_panels, z.conj(), form.rounding)
    start = np.random.default_rng(0).standard_normal((n, 2)).view(complex)
    q = np.repeat(start / np.linalg.norm(start), z.size, axis=1)
    previous = np.zeros_like(q)
    # Without reorthogonalisation: its price, copies of converged values, spares the largest.
    alpha, beta = np.zeros((2, _LANCZOS_STEPS, z.size))
    for k in range(_LANCZOS_STEPS):
        v = q[::-1].copy()
        _solve(form.adjoint_panels, adjoint, v)
        v = v[::-1].copy()
        _solve(form.panels, divisors, v)
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
        shifted = z[i] * np.eye(n) - form.triangle
        sigma[i] = np.linalg.svd(shifted, compute_uv=False)[-1]
    return sigma


def smallest_singular_values(
    form: SchurForm,
    z: ArrayLike,
    tolerance: float = 1e-6,
    progress: Progress | None = None,
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
