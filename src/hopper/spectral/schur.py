"""Schur forms of dense matrices of any scale, cut into panels for many shifted solutions at once.

A back-substitution's off-diagonal part does not depend on the shift z: it is one matrix product for
all of them.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from hopper.arguments import RealLike, checked
from hopper.arrays import Array, Complex, Numbers
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.spectral.scaling import exponent_of, represented, times_power

EPS = float(np.finfo(float).eps)
# Order of a diagonal block. Fast at n = 100 to 800.
_BLOCK = 24
# Largest ratio of two weights, as a power of two: products with its root are far from the limits.
_WEIGHT_RANGE = 1000


@dataclass(frozen=True, eq=False)
class Panel:
    """Rows [start, stop) of a triangle: ``basis @ block @ basis^H``, then ``right`` of it."""

    start: int
    stop: int
    block: Complex
    basis: Complex
    right: Numbers

    __repr__ = brief("start", "stop")


@dataclass(frozen=True, eq=False)
class SchurForm:
    """A matrix M prepared for any number of points z; made by :func:`schur_form`.

    Attributes
    ----------
    triangle : array, shape (n, n)
        Schur form of 2^-exponent M in the weighted norm, of entries about 1: real and
        quasi-triangular for a real matrix.
    panels, adjoint_panels : tuple
        ``triangle``, and its adjoint flipped to be upper triangular, cut into rows.
    exponent : int
    """

    triangle: Numbers
    panels: tuple[Panel, ...]
    adjoint_panels: tuple[Panel, ...]
    exponent: int

    __repr__ = brief("size", "is_real", "rounding")

    @property
    def size(self) -> int:
        """Order n of the matrix."""
        return len(self.triangle)

    @property
    def is_real(self) -> bool:
        """Whether the matrix is real; sigma_min is then equal at z and conj(z)."""
        return not np.iscomplexobj(self.triangle)

    @property
    def diagonal(self) -> Complex:
        """Eigenvalues of ``triangle``, shape (n,), as on the diagonal."""
        return np.concatenate([np.diag(panel.block) for panel in self.panels])

    @property
    def eigenvalues(self) -> Complex:
        """Eigenvalues of M, shape (n,), as on the diagonal."""
        return represented("eigenvalues", self.diagonal, self.exponent)

    @property
    def norm(self) -> float:
        """Frobenius norm of ``triangle``."""
        return float(np.linalg.norm(self.triangle))

    @property
    def rounding(self) -> float:
        """The Frobenius norm of M times eps: a smaller sigma_min is rounding."""
        return float(times_power(EPS * self.norm, self.exponent))


@checked
def schur_form(matrix: ArrayLike, weight: RealLike | None = None) -> SchurForm:
    """Return the prepared form of a square matrix M, in O(n^3) operations.

    Parameters
    ----------
    matrix : array, shape (n, n)
        Real or complex, of any scale. A real one costs half as much, here and for each point.
    weight : array, shape (n,), optional
        Positive w of the norm ||u||^2 = sum_i w_i |u_i|^2; default: 1. Everything computed from
        the form then means W^(1/2) M W^(-1/2).

    Raises
    ------
    InvalidParameterError
        If the matrix is not square, a value is not finite, or a weight is not positive.
    ConvergenceError
        If LAPACK finds no Schur form.

    Examples
    --------
    >>> from hopper import schur_form
    >>> schur_form([[-1, 10], [0, -2]]).size
    2
    """
    a = square("matrix", matrix)
    exponent = exponent_of(a)
    a = times_power(a, -exponent)
    if weight is not None:
        root = weight_roots(weight, len(a))
        a = a * (root[:, None] / root)
        exponent += exponent_of(a)
        a = times_power(a, -exponent_of(a))
    try:
        triangle = np.ascontiguousarray(
            scipy.linalg.schur(a, "complex" if np.iscomplexobj(a) else "real")[0]
        )
    except np.linalg.LinAlgError as error:
        raise ConvergenceError(f"no Schur form of the matrix found: {error}") from None
    flipped = np.ascontiguousarray(triangle.conj().T[::-1, ::-1])
    return SchurForm(triangle, _panels(triangle), _panels(flipped), exponent)


@checked
def square(name: str, matrix: ArrayLike) -> Numbers:
    """Return a square matrix, not empty.

    Raises
    ------
    InvalidParameterError
        If it is not one; named ``name``.
    """
    a = np.asarray(matrix)
    if a.ndim != 2 or a.shape[0] != a.shape[1] or not a.size:
        raise InvalidParameterError(f"{name} has shape {a.shape}: it must be square")
    return a


@checked
def weight_roots(weight: RealLike, n: int) -> Array:
    """Return the square roots of ``n`` positive weights, up to a common power of two.

    Raises
    ------
    InvalidParameterError
        If their number is another, or one is not positive, or they span more than 2^1000.
    """
    w = np.asarray(weight, dtype=float)
    if w.shape != (n,):
        raise InvalidParameterError(f"weight has shape {w.shape}: it must be ({n},)")
    if not w.min(initial=1.0) > 0:
        raise InvalidParameterError("weight must be positive and finite everywhere")
    exponents = np.frexp(w)[1]
    if np.ptp(exponents) > _WEIGHT_RANGE:
        raise InvalidParameterError(
            f"weight spans {w.min():.3g} to {w.max():.3g}: its ratios must stay below "
            f"2^{_WEIGHT_RANGE}"
        )
    # An even power, of which the square root is exact.
    return np.sqrt(times_power(w, -2 * (int(exponents.max()) // 2)))


def _panels(triangle: Numbers) -> tuple[Panel, ...]:
    panels = []
    start, n = 0, len(triangle)
    while start < n:
        stop = min(start + _BLOCK, n)
        stop += stop < n and triangle[stop, stop - 1] != 0  # keep a 2 x 2 block whole
        block, basis = scipy.linalg.rsf2csf(triangle[start:stop, start:stop], np.eye(stop - start))
        block, basis = (np.ascontiguousarray(part, dtype=complex) for part in (block, basis))
        panels.append(Panel(start, stop, block, basis, triangle[start:stop, stop:]))
        start = stop
    return tuple(panels)
