"""Schur forms of dense matrices, cut into panels for many shifted solutions at once.

A back-substitution's off-diagonal part does not depend on the shift z: it is one matrix product for
all of them.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import rsf2csf, schur

from hopper.arrays import Complex, Numbers
from hopper.brief import brief
from hopper.errors import InvalidParameterError

# Order of a diagonal block. Fast at n = 100 to 800.
EPS = float(np.finfo(float).eps)
_BLOCK = 24


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
    def eigenvalues(self) -> Complex:
        """Eigenvalues, shape (n,), as on the diagonal."""
        return np.concatenate([np.diag(panel.block) for panel in self.panels])

    @property
    def rounding(self) -> float:
        """The Frobenius norm times eps: a smaller sigma_min is rounding."""
        return EPS * float(np.linalg.norm(self.triangle))


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


def divisors_of(panels: tuple[_Panel, ...], z: Complex, floor: float) -> Complex:
    """Return 1 / (z - t_ii), shape (n, points), bounded where z is an eigenvalue to rounding."""
    gap = z - np.concatenate([np.diag(panel.block) for panel in panels])[:, None]
    gap[np.abs(gap) < floor] = floor
    return 1 / gap


def back_substitute(panels: tuple[_Panel, ...], divisors: Complex, x: Complex) -> None:
    """Overwrite ``x``, shape (n, points), by the solution of (z I - T) y = x, column by column."""
    for panel in reversed(panels):
        rows = x[panel.start : panel.stop]
        rows += _product(panel.right, x[panel.stop :])
        y = panel.basis.conj().T @ rows
        for i in reversed(range(len(y))):
            y[i] += panel.block[i, i + 1 :] @ y[i + 1 :]
            y[i] *= divisors[panel.start + i]
        np.matmul(panel.basis, y, out=rows)
