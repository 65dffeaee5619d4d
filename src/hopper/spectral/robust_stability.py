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
from math import inf, isfinite, nan

import numpy as np
import scipy

from hopper.arguments import AnyFloat, checked
from hopper.arrays import Array, Numbers
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.roots import root_between
from hopper.spectral.pseudospectrum import FAR
from hopper.spectral.scaling import represented, times_power
from hopper.spectral.schur import EPS, SchurForm
from hopper.spectral.shifted import unit_sigma_min

_STEPS = 60
_TOLERANCE = 1e-10
# Computed singular values are off by a few times eps ||M||.
_NOISE = 8 * EPS


def _midpoints(values: Array) -> Array:
    values = np.sort(values)
    return (values[1:] + values[:-1]) / 2


def _vertical_midpoints(form: SchurForm, x: float, level: float) -> Numbers:
    """Return points of Re z = x between those where ``level`` is a singular value of z I - T.

    These are the x + i y for imaginary eigenvalues i y of a Hamiltonian matrix [By]. All its
    eigenvalues are taken: rounding moves those of a crowded cluster from the imaginary axis by far
    more than itself, and each point is judged by its sigma_min.
    """
    identity = np.eye(form.size)
    shifted = form.triangle - x * identity
    hamiltonian = np.block([[shifted, level * identity], [-level * identity, -shifted.conj().T]])
    y = np.linalg.eigvals(hamiltonian).imag
    # For a real matrix one half of the line is as the other.
    return x + 1j * _midpoints(np.append(np.abs(y), [0.0, 0.0]) if form.is_real else y)


def _circle_midpoints(form: SchurForm, z: complex, level: float) -> Numbers:
    """Return points of the circle through ``z`` between those where ``level`` is a singular value.

    These are at the arguments of unimodular eigenvalues of a symplectic pencil [MO], of which all
    are taken as above; and ``z``, known to be one of them.
    """
    t, identity = form.triangle, np.eye(form.size)
    radius = abs(z)
    above, below = scipy.linalg.eigvals(
        np.block([[t, level * identity], [0 * identity, radius * identity]]),
        np.block([[radius * identity, 0 * identity], [level * identity, t.conj().T]]),
        homogeneous_eigvals=True,
    )
    angle = np.append(np.angle(above * np.conj(below)), np.angle(z))
    return np.asarray(radius * np.exp(1j * _midpoints(np.append(angle, angle.min() + 2 * np.pi))))


def _least(form: SchurForm, points: Numbers) -> tuple[float, complex]:
    """Return the smallest sigma_min among ``points``, and where."""
    sigma = unit_sigma_min(form, points, _TOLERANCE)
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
    inner, reached, noise = start, -inf, _NOISE * form.norm
    for _ in range(_STEPS):
        direction, far = outward(inner), limit + noise - size(inner)

        def excess(r: float, z: complex = inner, direction: complex = direction) -> float:
            return _least(form, np.array([z + r * direction]))[0] - epsilon

        # An eigenvalue is inside, whatever rounding says.
        rounding = EPS * (form.norm + far)
        step = root_between(excess, 0.0, far, xtol=rounding) if excess(0.0) < 0 else 0.0
        z = inner + direction * step
        previous, reached = reached, size(z)
        sigma, inner = _least(form, across(z))
        if sigma >= epsilon * (1 - _TOLERANCE) or reached <= previous:
            return reached, z
    raise ConvergenceError(f"the criss-cross search still moves after {_STEPS} steps")


def _search(
    form: SchurForm, epsilon: float, search: Callable[[float], tuple[float, complex]]
) -> tuple[float, complex]:
    """Return the result of a search in the units of the triangle, in those of the matrix."""
    level = float(times_power(epsilon, -form.exponent)) if isfinite(epsilon) else nan
    if not level > EPS * form.norm:
        raise InvalidParameterError(
            f"epsilon = {epsilon} is out of range: it must be finite and exceed rounding, "
            f"{form.rounding:.1e}"
        )
    if level >= FAR * form.norm:  # a disc about 0, but for rounding
        return epsilon, complex(epsilon)
    size, z = search(level)
    return (
        float(represented("the size of the pseudospectrum", size, form.exponent)),
        complex(represented("z", z, form.exponent)),
    )


@checked
def pseudospectral_abscissa(form: SchurForm, epsilon: AnyFloat) -> tuple[float, complex]:
    """Return the largest Re z of the epsilon-pseudospectrum, and a z where it is attained.

    Criss-cross search [BLO]: global, and quadratic in the end. Each of its few steps takes the
    eigenvalues of a matrix of order 2 n, O(n^3).

    Raises
    ------
    InvalidParameterError
        If epsilon is not finite or not above rounding, ``form.rounding``.
    ConvergenceError
        If the search does not end.

    Examples
    --------
    >>> from hopper import pseudospectral_abscissa, schur_form
    >>> abscissa, place = pseudospectral_abscissa(schur_form([[-1, 10], [0, -2]]), 0.01)
    >>> round(abscissa, 4)
    -0.9079
    """
    t = form.triangle
    # sigma_min(z I - M) >= Re z - numerical abscissa.
    numerical_abscissa = float(np.linalg.eigvalsh((t + t.conj().T) / 2)[-1])

    def search(level: float) -> tuple[float, complex]:
        return _criss_cross(
            form,
            level,
            start=complex(max(form.diagonal, key=np.real)),
            size=lambda z: z.real,
            limit=numerical_abscissa + 2 * level,
            outward=lambda z: 1.0,
            across=lambda z: _vertical_midpoints(form, z.real, level),
        )

    return _search(form, epsilon, search)


@checked
def pseudospectral_radius(form: SchurForm, epsilon: AnyFloat) -> tuple[float, complex]:
    """Return the largest |z| of the epsilon-pseudospectrum, and a z where it is attained.

    Criss-cross search on rays and circles [MO]; a step takes the eigenvalues of a pencil of order
    2 n, O(n^3).

    Raises
    ------
    InvalidParameterError
        If epsilon is not finite or not above rounding, ``form.rounding``.
    ConvergenceError
        If the search does not end.

    Examples
    --------
    >>> from hopper import pseudospectral_radius, schur_form
    >>> radius, place = pseudospectral_radius(schur_form([[-1, 10], [0, -2]]), 0.01)
    >>> round(radius, 4)
    2.0921
    """

    def search(level: float) -> tuple[float, complex]:
        return _criss_cross(
            form,
            level,
            start=complex(max(form.diagonal, key=abs)),
            size=abs,
            limit=float(np.linalg.norm(form.triangle, 2)) + 2 * level,
            outward=lambda z: z / abs(z) if z else 1.0,
            across=lambda z: _circle_midpoints(form, z, level),
        )

    return _search(form, epsilon, search)


@checked
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

    Examples
    --------
    >>> from hopper import distance_to_instability, schur_form
    >>> distance, frequency = distance_to_instability(schur_form([[-1, 10], [0, -2]]))
    >>> round(distance, 4)
    0.1952
    """
    value, z = _least(form, 1j * form.diagonal.imag)
    for _ in range(_STEPS):
        level = value * (1 - _TOLERANCE)
        lower, inner = _least(form, _vertical_midpoints(form, 0.0, level))
        if lower >= level or value <= EPS * form.norm:
            return (
                float(represented("the distance to instability", value, form.exponent)),
                float(represented("y", z.imag, form.exponent)),
            )
        value, z = lower, inner
    raise ConvergenceError(f"the level-set iteration still moves after {_STEPS} steps")
