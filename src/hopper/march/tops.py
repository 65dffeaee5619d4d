"""Stress at the top of a march, as deviations of log sigma and psi from the radial field.

Tops take x = theta / theta_w and are given at r = r_top, or where a tilted time is 0.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees, pi, tan

import numpy as np
import scipy

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError, NonPositiveStressError, TangencyError
from hopper.march.base import Base, radial_fields
from hopper.march.equations import tilt
from hopper.stability.tilted import tangency_angle

# Differences (radians, or relative) that count as rounding of given data.
_ROUNDING = 1e-6
# Points at which a top is checked.
_SAMPLES = 400

# Returns the deviations of log sigma and psi at x, each of shape (n,).
Deviation = Callable[[Base, Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Top:
    """Stress at the top; ``symmetric`` if sigma is even in theta and psi odd."""

    name: str
    symmetric: bool
    deviation: Deviation

    __repr__ = brief("name", "symmetric")


@checked
def scaled(factor: float) -> Top:
    """Return the radial field with ``factor`` times its stress.

    Raises
    ------
    NonPositiveStressError
        If the factor is not positive.
    """
    if factor <= 0:
        raise NonPositiveStressError(f"factor = {factor!r} must be a positive number")
    shift = float(np.log(factor))
    return Top(f"radial field x {factor:g}", True, lambda _, x: (0 * x + shift, 0 * x))


@checked
def linear_psi() -> Top:
    """Return sigma as the radial field's on the axis everywhere, and psi = psi_w x."""

    def deviation(base: Base, x: Array) -> tuple[Array, Array]:
        sigma, psi = radial_fields(base, base.hopper.half_angle * x)
        even = np.log(base.solution.sigma_axis / sigma)
        return even, base.solution.psi_wall * x - psi

    return Top("linear psi", True, deviation)


@checked
def bin_like() -> Top:
    """Return the stress of a bin with the major principal axis horizontal.

    psi = -theta + (psi_w + theta_w) x**3, the vertical stress uniform: sigma is the radial field's
    on the axis there, and grows as the axis turns: sigma (1 - s cos(2 psi + 2 theta)) = const.
    """

    def deviation(base: Base, x: Array) -> tuple[Array, Array]:
        s, half_angle = base.hopper.s, base.hopper.half_angle
        sigma, radial_psi = radial_fields(base, base.hopper.half_angle * x)
        psi = -half_angle * x + (base.solution.psi_wall + half_angle) * x**3
        vertical = 1 - s * np.cos(2 * (psi + half_angle * x))
        return np.log(base.solution.sigma_axis * (1 - s) / vertical / sigma), psi - radial_psi

    return Top("bin", True, deviation)


@checked
def bump_of_sigma(amplitude: float) -> Top:
    """Return the radial field with ``amplitude`` (1 - x**2)**6 added to log sigma (data S)."""
    return Top(f"S {amplitude:g}", True, lambda _, x: (amplitude * (1 - x**2) ** 6, 0 * x))


@checked
def bump_of_psi(amplitude: float) -> Top:
    """Return the radial field with ``amplitude`` x (1 - x**2)**6 added to psi (data A), radians."""
    return Top(f"A {amplitude:g}", True, lambda _, x: (0 * x, amplitude * x * (1 - x**2) ** 6))


@checked
def one_sided_bump(amplitude: float) -> Top:
    """Return the radial field with a bump of log sigma on 0 <= x <= 1, for wedges.

    ``amplitude`` (1 - (2 x - 1)**2)**6 is added to log sigma there.
    """

    def deviation(_: Base, x: Array) -> tuple[Array, Array]:
        return amplitude * np.where(x > 0, np.maximum(4 * x * (1 - x), 0.0), 0.0) ** 6, 0 * x

    return Top(f"one-sided {amplitude:g}", False, deviation)


@checked
def profile(theta: RealRow, sigma: RealRow, psi: RealRow) -> Top:
    """Return a top of given fields; between the points it is a cubic spline.

    Parameters
    ----------
    theta : array, shape (n,)
        Radians, increasing, n >= 4: from 0 to theta_w (a symmetric top), or from -theta_w.
    sigma : array, shape (n,)
        Average stress over rho g r.
    psi : array, shape (n,)
        Sokolovskii angle, radians.

    Raises
    ------
    InvalidParameterError
        If the arrays differ in length, are not finite, or theta does not increase or does not
        begin at 0 or a wall.
    NonPositiveStressError
        If sigma is not positive.
    """
    theta, sigma, psi, half = _whole_profile(np.asarray(theta), np.asarray(sigma), np.asarray(psi))
    splines = (
        scipy.interpolate.CubicSpline(theta, np.log(sigma)),
        scipy.interpolate.CubicSpline(theta, psi),
    )
    symmetric = half or bool(
        np.allclose(theta, -theta[::-1], rtol=0, atol=_ROUNDING)
        and np.allclose(sigma, sigma[::-1], rtol=_ROUNDING, atol=0)
        and np.allclose(psi, -psi[::-1], rtol=0, atol=_ROUNDING)
    )

    def deviation(base: Base, x: Array) -> tuple[Array, Array]:
        half_angle = base.hopper.half_angle
        if max(abs(theta[0] + half_angle), abs(theta[-1] - half_angle)) > _ROUNDING:
            raise InvalidParameterError(
                f"the profile reaches from {degrees(theta[0]):.6g} to {degrees(theta[-1]):.6g} "
                f"deg: it must reach the walls, half_angle = {degrees(half_angle):.6g} deg"
            )
        at = half_angle * x
        radial_sigma, radial_psi = radial_fields(base, at)
        return splines[0](at) - np.log(radial_sigma), splines[1](at) - radial_psi

    return Top("profile", symmetric, deviation)


def _whole_profile(theta: Array, sigma: Array, psi: Array) -> tuple[Array, Array, Array, bool]:
    """Return checked arrays of a profile from wall to wall, and whether half of it was given."""
    if not (theta.shape == sigma.shape == psi.shape and theta.size >= 4):
        raise InvalidParameterError("theta, sigma and psi must be arrays of one length >= 4")
    if not np.all(np.diff(theta) > 0):
        raise InvalidParameterError("theta of a profile must be increasing: sort its points")
    if sigma.min() <= 0:
        raise NonPositiveStressError(
            f"sigma = {sigma.min():.6g} of the profile is not positive: give compressive stresses"
        )
    half = theta[0] >= 0
    if half:
        if abs(theta[0]) > _ROUNDING or abs(psi[0]) > _ROUNDING:
            raise InvalidParameterError(
                f"a profile on half the hopper begins at theta = 0 with psi = 0, not at "
                f"{degrees(theta[0]):.6g} deg with {degrees(psi[0]):.6g} deg"
            )
        theta = np.concatenate([-theta[:0:-1], theta])
        sigma, psi = np.concatenate([sigma[:0:-1], sigma]), np.concatenate([-psi[:0:-1], psi])
    return theta, sigma, psi, half


@checked
def riemann_deviation(base: Base, top: Top, x: Array) -> Array:
    """Return the deviations of R+ and R- at x that a top prescribes, shape (2, n)."""
    even, odd = top.deviation(base, x)
    odd = 2 * tan(base.hopper.delta) * odd
    return np.stack([even + odd, even - odd])


@checked
def require_admissible(base: Base, top: Top) -> None:
    """Check a top against symmetry (cones), the wall law and the direction of time.

    Raises
    ------
    InvalidParameterError
        If the top of a cone is not symmetric, or psi at a wall is not that of its friction.
    TangencyError
        If psi is beyond the tangency: such data ask for a shock.
    """
    if base.hopper.curvature and not top.symmetric:
        raise InvalidParameterError(
            "the top of a cone must be symmetric: sigma even, psi odd in theta"
        )
    x = np.linspace(0.0 if top.symmetric else -1.0, 1, _SAMPLES + 1)
    even, odd = top.deviation(base, x)
    if not np.isfinite(even + odd).all():
        raise InvalidParameterError("the top must be finite everywhere: lower its amplitude")
    walls = odd[[0, -1]] if not top.symmetric else odd[[-1]]
    if np.abs(walls).max() > _ROUNDING:
        wrong = degrees(base.solution.psi_wall + float(odd[-1]))
        raise InvalidParameterError(
            f"psi = {wrong:.6g} deg at the wall breaks the wall law: it must be "
            f"{degrees(base.solution.psi_wall):.6g} deg there (and its negative at -theta_w)"
        )
    _, radial_psi = radial_fields(base, base.hopper.half_angle * x)
    middle = np.arctan(tilt(base.hopper, radial_psi)) if base.tilted else 0 * x
    psi, limit = radial_psi + odd, tangency_angle(base.hopper.delta)
    # Beyond pi/2 - eta a characteristic is tangent to the lines theta = const.
    excess = np.maximum(np.abs(psi - middle) - limit, np.abs(psi) - (pi / 2 - limit))
    if excess.max() >= 0:
        worst = int(np.argmax(excess))
        raise TangencyError(
            f"psi = {degrees(psi[worst]):.6g} deg of the top at theta = "
            f"{degrees(base.hopper.half_angle * x[worst]):.6g} deg is beyond the tangency of "
            f"characteristics with the line where it is given: no smooth march starts there",
            base.hopper.half_angle * float(x[worst]),
        )
