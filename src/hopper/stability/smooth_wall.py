"""Smooth-wall theory: exact spectra for small psi and mu = 0, (4.3)-(4.10).

For a wedge the modes are sines; for a cone omega = sigma psi satisfies
omega'' + (omega cot(theta))' + mu omega = 0, omega(0) = omega(theta_w) = 0, whose eigenvalues mu_n
the paper approximates for small angles twice. They follow from

- Bessel, cot(theta) ~ 1 / theta, (4.8): J_1(sqrt(mu) theta_w) = 0;
- Kummer, cot(theta) ~ 1 / theta - theta / 3, (4.10): Phi(1 - 3 mu / 2, 2, theta_w**2 / 6) = 0;
- Legendre, exact: P^1_nu(cos(theta_w)) = 0 with mu = nu (nu + 1).
"""

from collections.abc import Callable
from math import asin, cos, pi, sqrt
from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from hopper.arguments import Radians, RealLike, RealRow, checked
from hopper.arrays import Array, Complex
from hopper.errors import InvalidParameterError
from hopper.problem import Geometry
from hopper.roots import root_between
from hopper.values import require_angle

ConeVariant = Literal["bessel", "kummer", "legendre"]
CONE_VARIANTS: tuple[ConeVariant, ...] = ("bessel", "kummer", "legendre")


@checked
def abscissa(geometry: Geometry, delta: RealLike) -> Array:
    """Return the abscissa of the line of eigenvalues for ``delta`` in radians, same shape.

    Examples
    --------
    >>> from hopper.stability.smooth_wall import abscissa
    >>> abscissa("wedge", [0.3, 0.7]).round(4)
    array([1.5805, 0.1893])
    """
    s = np.sin(np.asarray(delta, dtype=float))
    return (2 - 3 * s) / (1 - s) if geometry == "wedge" else (5 - 9 * s) / (2 * (1 - s))


@checked
def neutral_delta(geometry: Geometry) -> float:
    """Return the delta (radians) at which the abscissa vanishes.

    Examples
    --------
    >>> from math import degrees
    >>> from hopper.stability.smooth_wall import neutral_delta
    >>> round(degrees(neutral_delta("cone")), 3)
    33.749
    """
    return asin(2 / 3) if geometry == "wedge" else asin(5 / 9)


def crossing_delta() -> float:
    """Return the delta (radians) at which wedge and cone have the same abscissa, 3/2."""
    return asin(1 / 3)


@checked
def wedge_eigenvalues(delta: Radians, half_angle: Radians, count: int) -> tuple[Complex, Complex]:
    """Return the eigenvalues (4.7) of the ``count`` lowest sine and cosine modes of a wedge.

    Parameters
    ----------
    delta, half_angle : float
        Radians.
    count : int
        Modes of each kind; each gives a pair of eigenvalues.

    Returns
    -------
    physical, mirrored : complex arrays, shape (2 count,)
        Of sine (odd omega) and cosine (even omega) modes.

    Examples
    --------
    >>> from hopper.stability.smooth_wall import wedge_eigenvalues
    >>> low, high = wedge_eigenvalues(delta=0.7, half_angle=0.2, count=2)
    >>> low.round(3)
    array([0.189+33.651j, 0.189+67.478j, 0.189-33.651j, 0.189-67.478j])
    """
    s = _checked(delta, half_angle, count)
    index = np.arange(1, count + 1)

    def pair(wavenumber: NDArray[np.floating]) -> Complex:
        root = np.emath.sqrt(1 - (1 - s**2) * wavenumber**2)
        pairs = np.concatenate([2 - 3 * s + root, 2 - 3 * s - root]) / (1 - s)
        return pairs.astype(np.complex128)

    return pair(index * pi / half_angle), pair((index - 0.5) * pi / half_angle)


@checked
def cone_wavenumbers(half_angle: Radians, count: int, variant: ConeVariant = "legendre") -> Array:
    """Return mu_1 < ... < mu_count of a cone with the given half angle (radians), shape (count,).

    Raises
    ------
    InvalidParameterError
        If the angle is out of range, count is not positive, or the variant is unknown.

    Examples
    --------
    >>> from hopper.stability.smooth_wall import cone_wavenumbers
    >>> cone_wavenumbers(half_angle=0.35, count=2).round(4)
    array([119.8549, 401.7854])
    """
    _checked(pi / 4, half_angle, count)
    if variant not in CONE_VARIANTS:
        raise InvalidParameterError(
            f"variant = {variant!r} is unknown: use one of {', '.join(CONE_VARIANTS)}"
        )
    bessel: Array = scipy.special.jn_zeros(1, count) / half_angle
    if variant == "bessel":
        return bessel**2
    characteristic: Callable[[float], float]
    if variant == "kummer":

        def characteristic(root: float) -> float:
            return float(scipy.special.hyp1f1(1 - 1.5 * root**2, 2, half_angle**2 / 6))

    else:

        def characteristic(root: float) -> float:
            return float(scipy.special.lpmv(1, sqrt(0.25 + root**2) - 0.5, cos(half_angle)))

    # Neighbouring roots are about pi / theta_w apart, and the variants differ by far less.
    margin = 0.3 * pi / half_angle
    roots = [root_between(characteristic, x - margin, x + margin, xtol=1e-12) for x in bessel]
    return np.array(roots) ** 2


@checked
def cone_eigenvalues(delta: Radians, mu: RealRow) -> Complex:
    """Return both roots of (4.9) for each mu_n, shape (2 len(mu),); ``delta`` in radians.

    Raises
    ------
    InvalidParameterError
        If delta is out of range.

    Examples
    --------
    >>> from hopper.stability.smooth_wall import cone_eigenvalues, cone_wavenumbers
    >>> cone_eigenvalues(0.7, cone_wavenumbers(half_angle=0.35, count=1)).round(4)
    array([-1.1214+22.9711j, -1.1214-22.9711j])
    """
    require_angle("delta", delta)
    s = np.sin(delta)
    linear = 5 - 9 * s
    constant = 4 - 20 * s + (1 + s) * np.asarray(mu)
    root = np.emath.sqrt(linear**2 - 4 * (1 - s) * constant)
    pairs = np.concatenate([linear + root, linear - root]) / (2 * (1 - s))
    return pairs.astype(np.complex128)


@checked
def oscillation_threshold(half_angle: RealLike) -> Array:
    """Return f(theta_w): the least sin(delta) at which an eigenvalue of (4.9) is real.

    ``half_angle`` in radians, below :func:`largest_distinct_half_angle`.

    Examples
    --------
    >>> from hopper.stability.smooth_wall import oscillation_threshold
    >>> oscillation_threshold([0.2, 0.4]).round(4)
    array([0.9946, 0.9782])
    """
    angle2 = np.asarray(half_angle, dtype=float) ** 2
    x2 = scipy.special.jn_zeros(1, 1)[0] ** 2
    return (-3 * angle2 + 4 * np.sqrt(x2**2 - 2 * x2 * angle2)) / (angle2 + 4 * x2)


def largest_distinct_half_angle() -> float:
    """Return the theta_w (radians) below which mu_1 > 2, so that f(theta_w) is defined."""
    return float(scipy.special.jn_zeros(1, 1)[0]) / sqrt(2)


def _checked(delta: float, half_angle: float, count: int) -> float:
    require_angle("delta", delta)
    require_angle("half_angle", half_angle)
    if count < 1:
        raise InvalidParameterError(f"count = {count!r} modes: ask for at least 1")
    return float(np.sin(delta))
