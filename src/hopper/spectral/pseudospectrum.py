"""Pseudospectra of dense matrices: sigma_min(z I - M) on grids, and what follows from them.

The epsilon-pseudospectrum is the set of z with sigma_min(z I - M) < epsilon [TE]. One Schur form
serves all z.

Rounding limits sigma_min to an absolute error of a few eps ||M||, as in any dense method, and of
5 sqrt(n) eps ||M|| where other singular values are as close as that to the smallest.

References
----------
.. [TE] L. N. Trefethen, M. Embree, Spectra and Pseudospectra, Princeton (2005).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from hopper.arguments import Fraction, RealLike, checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.spectral.sampling import closing_in
from hopper.spectral.scaling import represented, times_power
from hopper.spectral.schur import SchurForm
from hopper.spectral.shifted import Progress, unit_sigma_min
from hopper.values import finite_number

# |z| over the norm of the matrix from where on sigma_min is |z| but for rounding.
FAR = 2.0**60


@checked
def smallest_singular_values(
    form: SchurForm, z: ArrayLike, tolerance: Fraction = 1e-6, progress: Progress | None = None
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
        Bound on the relative error of 1 / sigma_min^2, above rounding; half of it is one of
        sigma_min. It holds where other singular values crowd around the smallest; elsewhere the
        error is far smaller.
    progress : callable(done, total), optional
        Called after each batch with numbers of points.

    Returns
    -------
    array, shape of ``z``
        Nonnegative; of rounding size at an eigenvalue, 0 where 1 / sigma_min^2 exceeds 1e154.

    Raises
    ------
    InvalidParameterError
        If a point is not finite, the tolerance is not in (0, 1), or a result is outside the range
        of numbers.

    Examples
    --------
    >>> from hopper import schur_form, smallest_singular_values
    >>> print(smallest_singular_values(schur_form([[-1, 10], [0, -2]]), [0, 1j]).round(4))
    [0.1952 0.3058]
    """
    points = np.asarray(z, dtype=complex)
    scaled = times_power(points, -form.exponent)
    with np.errstate(over="ignore"):
        far = np.abs(scaled) >= FAR * form.norm
        distance = np.abs(points)
    if not np.isfinite(distance[far]).all():
        raise InvalidParameterError("|z| exceeds 1e308: scale the matrix, and z, by a power of 10")
    near = np.where(far, 2 * form.norm, scaled)
    sigma = unit_sigma_min(form, near, tolerance, progress)
    return np.where(far, distance, represented("sigma_min", sigma, form.exponent))


@dataclass(frozen=True, eq=False)
class Pseudospectrum:
    """``sigma_min``, shape (ny, nx), of z I - M at z = ``real`` (nx,) + i ``imag`` (ny,)."""

    real: Array
    imag: Array
    sigma_min: Array

    __repr__ = brief("real", "imag", "sigma_min")


@checked
def plane_of(eigenvalues: Complex, real: RealLike, imag: RealLike) -> tuple[Array, Array]:
    """Return the axes of a grid, with points added that close in on the eigenvalues within.

    There the level curves of sigma_min are small, and missed by an even grid.

    Raises
    ------
    InvalidParameterError
        As :func:`pseudospectrum`.
    """
    x, y = _axis("real", real), _axis("imag", imag)
    inside = (x[0] < eigenvalues.real) & (eigenvalues.real < x[-1])
    inside &= (y[0] < eigenvalues.imag) & (eigenvalues.imag < y[-1])
    near = eigenvalues[inside]
    return closing_in(x, near.real), closing_in(y, near.imag)


@checked
def pseudospectrum(
    form: SchurForm, real: RealLike, imag: RealLike, progress: Progress | None = None
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

    Examples
    --------
    >>> from hopper import pseudospectrum, schur_form
    >>> grid = pseudospectrum(schur_form([[-1, 10], [0, -2]]), [-0.5, 0], [0, 1])
    >>> print(grid.sigma_min.round(4))
    [[0.0741 0.1952]
     [0.1972 0.3058]]
    """
    x, y = _axis("real", real), _axis("imag", imag)
    heights, source = _rows(y, form.rounding) if form.is_real else (y, np.arange(y.size))
    sigma = smallest_singular_values(form, x + 1j * heights[:, None], progress=progress)
    return Pseudospectrum(x, y, sigma[source])


def _rows(y: Array, rounding: float) -> tuple[Array, NDArray[np.intp]]:
    """Return the different |y|, and the place of each y among them.

    The two sides of a symmetric axis are often equal to rounding only. sigma_min at points d apart
    differs by at most d, so that rows as close as rounding of sigma_min are one.
    """
    heights: list[float] = []
    place = np.empty(y.size, dtype=np.intp)
    for i in np.argsort(np.abs(y), kind="stable"):
        if not heights or abs(y[i]) - heights[-1] > rounding:
            heights.append(abs(y[i]))
        place[i] = len(heights) - 1
    return np.array(heights), place


def _axis(name: str, values: RealLike) -> Array:
    axis = np.asarray(values, dtype=float)
    if axis.ndim != 1 or axis.size < 2:
        raise InvalidParameterError(f"{name} has shape {axis.shape}: give at least two values")
    if (axis[1:] <= axis[:-1]).any():
        raise InvalidParameterError(f"{name} must increase: sort it, without repeated values")
    return axis


@checked
def kreiss_lower_bound(grid: Pseudospectrum, shift: float = 0.0) -> tuple[float, complex]:
    """Return the largest (Re z - shift) / sigma_min(z) over the grid's Re z > shift, and its z.

    A lower bound of sup ||exp(t (M - shift I))|| over t >= 0 [TE, section 14].

    Raises
    ------
    InvalidParameterError
        If no grid point has Re z > shift, or shift is not finite.

    Examples
    --------
    >>> from hopper import pseudospectrum, schur_form
    >>> from hopper.spectral.pseudospectrum import kreiss_lower_bound
    >>> form = schur_form([[-1.0, 9.0], [0.0, -2.0]])
    >>> grid = pseudospectrum(form, [0.1, 0.5, 1.0], [-0.1, 0.0, 0.1])
    >>> round(kreiss_lower_bound(grid)[0], 4)
    1.6126
    """
    right = grid.real > shift
    if not right.any():
        raise InvalidParameterError(
            f"real ends at {grid.real[-1]:.6g}: extend the grid beyond shift = {shift:.6g}"
        )
    with np.errstate(divide="ignore", over="ignore"):
        height = grid.real[right] - shift
        ratio = height / grid.sigma_min[:, right]
    finite_number("real - shift", float(height.max()))
    row, column = np.unravel_index(np.argmax(ratio), ratio.shape)
    return float(ratio[row, column]), complex(grid.real[right][column], grid.imag[row])


@checked
def eigenvalue_condition_numbers(form: SchurForm) -> tuple[Complex, Array]:
    """Return the eigenvalues and their condition numbers ||x|| ||y|| / |y* x|, shape (n,) each.

    x and y are right and left eigenvectors, norms those of the form [TE]. That of a
    defective eigenvalue is infinite, or merely huge through rounding.

    Raises
    ------
    InvalidParameterError
        If an eigenvalue is outside the range of numbers.

    Examples
    --------
    >>> from hopper import schur_form
    >>> from hopper.spectral.pseudospectrum import eigenvalue_condition_numbers
    >>> values, conditions = eigenvalue_condition_numbers(schur_form([[1.0, 9.0], [0.0, 2.0]]))
    >>> conditions.round(4)
    array([9.0554, 9.0554])
    """
    result: Any = scipy.linalg.eig(form.triangle, left=True, right=True)  # the stubs miscount
    values, left, right = result
    with np.errstate(divide="ignore"):
        condition = 1 / np.abs(np.einsum("ij,ij->j", left.conj(), right))
    return represented("eigenvalues", values.astype(complex), form.exponent), condition
