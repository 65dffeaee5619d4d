"""sigma_min(z I - T) of a triangle T at many points, by inverse Lanczos iteration [Lui, Tr].

Points go together: the off-diagonal part of a back-substitution does not depend on z, so it is one
matrix product for all of them. Everything here is in the units of the triangle, of entries about 1.

References
----------
.. [Lui] S. H. Lui, Computation of pseudospectra by continuation, SIAM J. Sci. Comput. 18 (1997).
.. [Tr] L. N. Trefethen, Computation of pseudospectra, Acta Numerica 8 (1999).
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array, Complex, Numbers
from hopper.spectral.lanczos import largest_eigenvalues
from hopper.spectral.schur import EPS, Panel, SchurForm

Progress = Callable[[int, int], None]

# Entries (points times n) and points of a batch. Fast at n = 100 to 800.
_BATCH_ENTRIES, _BATCH_POINTS = 2**18, 2048
# The small eigenproblems of later steps are a cost.
_CHECKS = (*range(1, 17), *range(17, 66, 8))


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


def _apply_inverse(form: SchurForm, q: Complex, divisors: Complex, adjoint: Complex) -> Complex:
    """Return ((z I - T)^H (z I - T))^-1 q, column by column."""
    v = q[::-1].copy()
    _back_substitute(form.adjoint_panels, adjoint, v)
    v = v[::-1].copy()
    _back_substitute(form.panels, divisors, v)
    return v


def _by_svd(form: SchurForm, z: complex) -> float:
    shifted = z * np.eye(form.size) - form.triangle
    return float(np.linalg.svd(shifted, compute_uv=False)[-1])


def _sigma_min(form: SchurForm, z: Complex, tolerance: float) -> Array:
    """Return sigma_min at one batch of points, shape (points,)."""
    floor = EPS * form.norm
    start = np.random.default_rng(0).standard_normal((form.size, 2)).view(complex)[:, 0]
    largest = largest_eigenvalues(
        partial(_apply_inverse, form),
        [_divisors(form.panels, z, floor), _divisors(form.adjoint_panels, z.conj(), floor)],
        start,
        tolerance,
        _CHECKS,
        noise=lambda value: np.minimum(floor * np.sqrt(value), 0.01),
    )
    sigma = 1 / np.sqrt(largest)
    # Rare: crowded singular values, as of a normal matrix far from its spectrum.
    for i in np.flatnonzero(np.isnan(largest)):
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
            sigma[start:stop] = _sigma_min(form, flat[start:stop], tolerance)
        if progress is not None:
            progress(stop, flat.size)
    return sigma.reshape(z.shape)
