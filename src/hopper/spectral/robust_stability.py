"""Robust stability of dense matrices: pseudospectral abscissa and radius, distance to instability.

All searches are global: eigenvalues of a matrix or pencil of twice the order tell where a line or
circle crosses the boundary of a pseudospectrum.

References
----------
.. [By] R. Byers, A bisection method for measuring the distance of a stable matrix to the unstable
   matrices, SIAM J. Sci. Stat. Comput. 9 (1988).
.. [BB] S. Boyd, V. Balakrishnan, A regularity result for the singular values of a transfer matrix
   and a quadratically convergent algorithm for computing its L-infinity norm, Syst. Control
   Lett. 15 (1990).
.. [BLO] J. V. Burke, A. S. Lewis, M. L. Overton, Robust stability and a criss-cross algorithm for
   pseudospectra, IMA J. Numer. Anal. 23 (2003).
.. [MO] E. Mengi, M. L. Overton, Algorithms for the computation of the pseudospectral radius and
   the numerical radius of a matrix, IMA J. Numer. Anal. 25 (2005).
"""

from collections.abc import Callable
from math import inf

import numpy as np
from scipy.linalg import eigvals
from scipy.optimize import brentq

from hopper.arrays import Numbers
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.spectral.pseudospectrum import smallest_singular_values
from hopper.spectral.schur import SchurForm

_EPS = float(np.finfo(float).eps)
_STEPS = 60
_TOLERANCE = 1e-10
# Computed eigenvalues this close to a line or circle, relative to the matrix, may lie on it: a
# double one is off by the square root of rounding.
_ON_CURVE = 1e-7


def _vertical_midpoints(form: SchurForm, x: float, level: float) -> Numbers:
    """Return points of Re z = x between those where ``level`` is a singular value of z I - M.

    These are the x + i y for imaginary eigenvalues i y of a Hamiltonian matrix [By].
    """
    identity = np.eye(len(form.triangle))
    shifted = form.triangle - x * identity
    hamiltonian = np.block([[shifted, level * identity], [-level * identity, -shifted.conj().T]])
    values = np.linalg.eigvals(hamiltonian)
    near = np.abs(values.real) <= _ON_CURVE * np.linalg.norm(hamiltonian)
    y = np.sort(values.imag[near])
    return x + 0.5j * (y[1:] + y[:-1])


def _circle_midpoints(form: SchurForm, z: complex, level: float) -> Numbers:
    """Return points of the circle through ``z`` between those where ``level`` is a singular value.

    These are at the arguments of unimodular eigenvalues of a symplectic pencil [MO]; and ``z``,
    known to be one of them.
    """
    t, identity = form.triangle, np.eye(len(form.triangle))
    radius = abs(z)
    values = eigvals(
        np.block([[t, level * identity], [0 * identity, radius * identity]]),
        np.block([[radius * identity, 0 * identity], [level * identity, t.conj().T]]),
    )
    near = np.abs(np.abs(values) - 1) <= _ON_CURVE * (1 + np.linalg.norm(t) / radius)
    angle = np.sort(np.append(np.angle(values[near]), np.angle(z)))
    middle = angle + np.diff(angle, append=angle[0] + 2 * np.pi) / 2
    return np.asarray(radius * np.exp(1j * middle))


def _least(form: SchurForm, points: Numbers) -> tuple[float, complex]:
    """Return the smallest sigma_min among ``points`` (infinite if there are none), and where."""
    if not points.size:
        return inf, 0j
    sigma = smallest_singular_values(form, points, _TOLERANCE)
    best = int(np.argmin(sigma))
    return float(sigma[best]), complex(points[best])


def _criss_cross(
    form: SchurForm,
    epsilon: float,
    start: complex,
    size: Callable[[complex], float],
    limit: float,
    outward: Callable[[complex], complex],
    across: Callable[[complex], Numbers],
) -> tuple[float, complex]:
    """Return the largest ``size``, below ``limit``, in the epsilon-pseudospectrum, and its point.

    Move ``outward`` from ``start`` to a boundary point, then to the innermost of the points
    ``across`` on its line or circle, and again, until all of them are outside. Any boundary point
    serves, so moving outward takes a root search only and no eigenproblem.
    """
    if not form.rounding < epsilon < inf:
        raise InvalidParameterError(
            f"epsilon = {epsilon} is out of range: it must be finite and exceed rounding, "
            f"{form.rounding:.1e}"
        )
    inner, reached = start, -inf
    for _ in range(_STEPS):
        direction, far = outward(inner), limit - size(inner)

        def excess(r: float, z: complex = inner, direction: complex = direction) -> float:
            return _least(form, np.array([z + r * direction]))[0] - epsilon

        z = inner + direction * brentq(excess, 0.0, far, xtol=form.rounding + _EPS * far)
        previous, reached = reached, size(z)
        sigma, inner = _least(form, across(z))
        if sigma >= epsilon * (1 - _TOLERANCE) or reached <= previous:
            return reached, z
    raise ConvergenceError(f"the criss-cross search still moves after {_STEPS} steps")


def pseudospectral_abscissa(form: SchurForm, epsilon: float) -> tuple[float, complex]:
    """Return the largest Re z of the epsilon-pseudospectrum, and a z where it is attained.

    Criss-cross search [BLO]: global, and quadratic in the end. Each of its few steps takes the
    eigenvalues of a matrix of order 2 n, O(n^3).

    Raises
    ------
    InvalidParameterError
        If epsilon is not finite or not above rounding, ``form.rounding``.
    ConvergenceError
        If the search does not end.
    """
    t = form.triangle
    # sigma_min(z I - M) >= Re z - numerical abscissa.
    numerical_abscissa = float(np.linalg.eigvalsh((t + t.conj().T) / 2)[-1])
    return _criss_cross(
        form,
        epsilon,
        start=complex(max(form.eigenvalues, key=np.real)),
        size=lambda z: z.real,
        limit=numerical_abscissa + 2 * epsilon,
        outward=lambda z: 1.0,
        across=lambda z: _vertical_midpoints(form, z.real, epsilon),
    )


def pseudospectral_radius(form: SchurForm, epsilon: float) -> tuple[float, complex]:
    """Return the largest |z| of the epsilon-pseudospectrum, and a z where it is attained.

    Criss-cross search on rays and circles [MO]; a step takes the eigenvalues of a pencil of order
    2 n, O(n^3).

    Raises
    ------
    InvalidParameterError
        If epsilon is not finite or not above rounding, ``form.rounding``.
    ConvergenceError
        If the search does not end.
    """
    return _criss_cross(
        form,
        epsilon,
        start=complex(max(form.eigenvalues, key=abs)),
        size=abs,
        limit=float(np.linalg.norm(form.triangle, 2)) + 2 * epsilon,
        outward=lambda z: z / abs(z) if z else 1.0,
        across=lambda z: _circle_midpoints(form, z, epsilon),
    )


def distance_to_instability(form: SchurForm) -> tuple[float, float]:
    """Return the smallest sigma_min(i y I - M) over real y, and the y where it is attained.

    For a matrix with all eigenvalues in Re z < 0 it is the size of the smallest perturbation, in
    the form's norm, that makes it unstable; for any other, of the smallest that brings an
    eigenvalue to the imaginary axis.

    Level-set iteration [By, BB]: global, and quadratic in the end. The last of its few
    eigenproblems of order 2 n, O(n^3), certifies that no y has a value smaller by more than
    1e-10, relative, as far as rounding lets it.

    Raises
    ------
    ConvergenceError
        If the iteration does not end.
    """
    value, z = _least(form, 1j * form.eigenvalues.imag)
    for _ in range(_STEPS):
        level = value * (1 - _TOLERANCE)
        lower, inner = _least(form, _vertical_midpoints(form, 0.0, level))
        if lower >= level or value <= form.rounding:
            return value, z.imag
        value, z = lower, inner
    raise ConvergenceError(f"the level-set iteration still moves after {_STEPS} steps")
