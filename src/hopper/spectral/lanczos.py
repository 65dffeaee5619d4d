"""sigma_min(z I - T) of a triangle T at many points, by inverse Lanczos iteration [Lui, Tr].

Points go together: the off-diagonal part of a back-substitution does not depend on z, so it is one
matrix product for all of them. Everything here is in the units of the triangle, of entries about 1.

References
----------
.. [Lui] S. H. Lui, Computation of pseudospectra by continuation, SIAM J. Sci. Comput. 18 (1997).
.. [Tr] L. N. Trefethen, Computation of pseudospectra, Acta Numerica 8 (1999).
.. [Pa] B. N. Parlett, The symmetric eigenvalue problem, SIAM (1998).
"""

from collections.abc import Callable

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array, Complex, Numbers
from hopper.spectral.schur import EPS, Panel, SchurForm

Progress = Callable[[int, int], None]

# Entries (points times n) and points of a batch. Fast at n = 100 to 800.
_BATCH_ENTRIES, _BATCH_POINTS = 2**19, 2048
_LANCZOS_STEPS = 65
# A Ritz pair (value, y) of residual r has some eigenvalue within r, and the largest, of vector u,
# within r / |u^H y| [Pa]. The start vector's component along u is below this share of n^(-1/2) in
# one case of a hundred, and iteration makes it larger.
_SHARE = 0.1


def _product(matrix: Numbers, vectors: Complex) -> Complex:
    if np.iscomplexobj(matrix):
        return matrix @ vectors
    # A real matrix acts on real and imaginary parts as on twice as many real vectors.
    return (matrix @ vectors.view(float)).view(complex)


def _divisors(panels: tuple[Panel, ...], z: Complex, floor: float) -> Complex:
    """Return 1 / (z - t_ii), shape (n, points), bounded where z is an eigenvalue to rounding."""
    gap = z - np.concatenate([np.diag(panel.block) for panel in panels])[:, None]
    gap[np.abs(gap) < floor] = floor
    return 1 / gap


def _back_substitute(panels: tuple[Panel, ...], divisors: Complex, x: Complex) -> None:
    """Overwrite ``x``, shape (n, points), by the solution of (z I - T) y = x, column by column."""
    for panel in reversed(panels):
        rows = x[panel.start : panel.stop]
        rows += _product(panel.right, x[panel.stop :])
        y = panel.basis.conj().T @ rows
        for i in reversed(range(len(y))):
            y[i] += panel.block[i, i + 1 :] @ y[i + 1 :]
            y[i] *= divisors[panel.start + i]
        np.matmul(panel.basis, y, out=rows)


def _apply_inverse(form: SchurForm, divisors: Complex, adjoint: Complex, q: Complex) -> Complex:
    """Return ((z I - T)^H (z I - T))^-1 q, column by column."""
    v = q[::-1].copy()
    _back_substitute(form.adjoint_panels, adjoint, v)
    v = v[::-1].copy()
    _back_substitute(form.panels, divisors, v)
    return v


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


def _by_svd(form: SchurForm, z: complex) -> float:
    shifted = z * np.eye(form.size) - form.triangle
    return float(np.linalg.svd(shifted, compute_uv=False)[-1])


def _lanczos(form: SchurForm, z: Complex, tolerance: float) -> Array:
    """Return sigma_min at one batch of points, shape (points,)."""
    n, floor, share = form.size, EPS * form.norm, _SHARE / np.sqrt(form.size)
    sigma, active = np.zeros(z.size), np.arange(z.size)
    divisors = _divisors(form.panels, z, floor)
    adjoint = _divisors(form.adjoint_panels, z.conj(), floor)
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
        # The change of sigma can pause, the residual cannot. Rounding leaves some of it in place.
        noise = np.minimum(floor * np.sqrt(value), 0.01)
        done = beta[k] * last <= (share * tolerance + noise) * value
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


@checked
def unit_sigma_min(
    form: SchurForm, z: Complex, tolerance: float, progress: Progress | None = None
) -> Array:
    """Return sigma_min(z I - T) at points z of the triangle's units, shape of ``z``."""
    flat = z.ravel()
    sigma = np.empty(flat.size)
    batch = max(1, min(_BATCH_POINTS, _BATCH_ENTRIES // form.size))
    for start in range(0, flat.size, batch):
        stop = min(start + batch, flat.size)
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            sigma[start:stop] = _lanczos(form, flat[start:stop], tolerance)
        if progress is not None:
            progress(stop, flat.size)
    return sigma.reshape(z.shape)
