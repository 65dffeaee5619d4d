"""The linearised stress equations solved for u_theta, and the tilted time in which they are waves.

With sigma = r (sigma0 + eps sigma1(t, theta)), psi = psi0 + eps psi1(t, theta) and t = log r the
momentum equations (2.8), (2.9) linearise to E1 u_t + E2 u_theta + E0 u = 0, u = (sigma1, psi1). E2
is regular wherever the radial solution is, so that

    u_theta + N u_t + K u = 0,    N = E2^-1 E1,    K = E2^-1 E0.

E1 is singular where psi = pi/4 - delta/2, the *tangency*: there a characteristic is tangent to the
arc r = const, and t does not serve as time. That is a defect of the coordinate. The tilted time

    t' = t + h(theta),    h(theta) = integral from 0 of sin 2psi / (sin delta + cos 2psi),

adds h' I to N and leaves it without diagonal: a plain wave system

    u_t' + J (u_theta + K u) = 0,    J = -w [[0, 2 s sigma / cos^2 delta], [1 / (2 s sigma), 0]],

s = sin delta, w = s + cos 2psi, with speeds +-w / cos delta for every radial solution. Modes
exp(-lambda t') U' have U' = exp(lambda h) U: the eigenvalues are those of t.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from hopper.arguments import RealLike, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.fields import stacked_fields
from hopper.radial.grid import Grid, half_grid
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.yield_conditions import MOHR_COULOMB


@dataclass(frozen=True)
class TiltedCoefficients:
    """Entries of J and of F = J K at n angles, each of shape (..., n); J11 = J22 = 0.

    The factor w of J cancels in F. ``w`` vanishes where the radial solution itself is singular;
    ``sigma`` and ``psi`` are the radial solution's.
    """

    sigma: Array
    psi: Array
    w: Array
    j12: Array
    j21: Array
    f11: Array
    f12: Array
    f21: Array
    f22: Array

    __repr__ = brief("sigma", "psi deg", "w")


@checked
def require_mohr_coulomb(hopper: Hopper) -> None:
    """Check that the stress equations stand by themselves.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb: its velocity does not decouple.
    """
    if hopper.material != MOHR_COULOMB:
        raise InvalidParameterError(
            f"material = {hopper.material.name} couples stress and velocity, this is formulated "
            "for Mohr-Coulomb materials only: use mohr-coulomb, or hopper.von_mises.verdict; "
            "transients and pseudospectra are refused, as the collocation matrix of that problem "
            "grows in ways that the equations do not"
        )


@checked
def tilted_coefficients(solution: RadialSolution, theta: RealLike) -> TiltedCoefficients:
    """Return the coefficients at angles ``theta`` (radians, |theta| <= theta_w), shape (n,).

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb, an angle lies outside the hopper, or on the axis of a
        cone.
    """
    require_mohr_coulomb(solution.hopper)
    angles = np.atleast_1d(np.asarray(theta, dtype=float))
    fields = solution.fields(angles)
    on_axis = angles == 0
    if solution.hopper.curvature and on_axis.any():
        raise InvalidParameterError("theta = 0 is the axis of a cone: use other angles")
    cot = np.divide(1.0, np.tan(angles), out=np.zeros_like(angles), where=~on_axis)
    return _coefficients(solution, cot, fields)


@checked
def on_grids(solution: RadialSolution, grids: Sequence[Grid]) -> list[TiltedCoefficients]:
    """Return the coefficients at the points of several half grids, evaluated together."""
    return [
        TiltedCoefficients(**{name: value[0] for name, value in vars(at).items()})
        for at in stacked_on_grids([solution], grids)
    ]


@checked
def stacked_on_grids(
    solutions: Sequence[RadialSolution], grids: Sequence[Grid]
) -> list[TiltedCoefficients]:
    """Return the coefficients of solutions of one hopper at points of half grids.

    Their entries have the shape (solutions, points). Evaluated together, as at these sizes numpy's
    overhead is most of the cost.

    Raises
    ------
    InvalidParameterError
        As :func:`require_mohr_coulomb` and :func:`hopper.radial.fields.stacked_fields`.
    """
    fields = stacked_fields([solution.member for solution in solutions], grids)
    require_mohr_coulomb(solutions[0].hopper)
    cot = np.concatenate([grid.cot for grid in grids])
    at = vars(_coefficients(solutions[0], cot, fields))
    stops = np.cumsum([grid.size for grid in grids])
    parts = [slice(stop - grid.size, stop) for stop, grid in zip(stops, grids, strict=True)]
    return [TiltedCoefficients(**{name: at[name][:, part] for name in at}) for part in parts]


def _coefficients(
    solution: RadialSolution, cot: Array, fields: tuple[Array, Array, Array, Array]
) -> TiltedCoefficients:
    s, k = solution.hopper.s, solution.hopper.curvature
    sigma, psi, dsigma, dpsi = fields
    sin_psi, cos_psi = np.sin(psi), np.cos(psi)
    s2, versine = 2 * sin_psi * cos_psi, 2 * sin_psi**2
    c2 = 1 - versine
    w, cos2_delta = s + c2, 1 - s * s
    # 1 - cos(2 psi) = 2 sin(psi)^2 keeps its digits near the axis.
    return TiltedCoefficients(
        sigma=sigma,
        psi=psi,
        w=w,
        j12=-2 * s / cos2_delta * sigma * w,
        j21=-w / (2 * s * sigma),
        f11=-(2 * s * dpsi * w + 2 * s * c2 + 3 * s * s - 1 + k * s * (1 + s) * (1 + c2 + s2 * cot))
        / cos2_delta,
        f12=-2 * s / cos2_delta * (dsigma * w + sigma * (k * (w * cot - s2) - (3 + 2 * dpsi) * s2)),
        f21=(s2 - k * s * (s2 + versine * cot)) / (2 * s * sigma),
        f22=3 + k + 2 * dpsi,
    )


@checked
def wave_matrices(solution: RadialSolution, theta: RealLike) -> tuple[Array, Array]:
    """Return N and K of u_theta + N u_t + K u = 0, each of shape (n, 2, 2).

    ``theta`` (n,) in radians, 0 < |theta| <= theta_w. A and F = B + (d - 2) C of (4.1) are N^-1 and
    N^-1 K where N is regular.

    Raises
    ------
    InvalidParameterError
        As :func:`tilted_coefficients`.
    """
    at = tilted_coefficients(solution, theta)
    lean = np.sin(2 * at.psi) / at.w
    zero = np.zeros_like(lean)
    inverse = np.array([[zero, 1 / at.j21], [1 / at.j12, zero]])
    n = inverse - np.array([[lean, zero], [zero, lean]])
    f = np.array([[at.f11, at.f12], [at.f21, at.f22]])
    return np.moveaxis(n, 2, 0), np.einsum("ijn,jkn->nik", inverse, f)


@checked
def tilt(solution: RadialSolution, size: int = 64) -> tuple[Array, Array]:
    """Return theta and h(theta), radians and 1, at ``size`` points of a half grid, shape (size,).

    h is even, rises from the axis to the wall and is bounded: data on t' = const lie on
    r = r0 exp(-h(theta)), and decay in t' is decay down the hopper.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.tilted import tilt
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> theta, height = tilt(solution)
    >>> round(float(height[-1]), 4)
    0.1279
    """
    require_mohr_coulomb(solution.hopper)
    grid = half_grid(size, solution.hopper.half_angle)
    (at,) = on_grids(solution, [grid])
    slope = solution.hopper.half_angle * np.sin(2 * at.psi) / at.w
    return grid.theta, chebyshev.integrate_odd(slope)


@checked
@lru_cache(maxsize=8)
def first_tangency(solution: RadialSolution) -> float | None:
    """Return the angle (radians) at which psi first reaches pi/4 - delta/2, None if it does not.

    There A of (4.1) is singular: t = log r is not a time for this solution.

    Raises
    ------
    InvalidParameterError
        If the material is not Mohr-Coulomb.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.stability.tilted import first_tangency
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.37)
    >>> round(first_tangency(solution), 4)
    0.1482
    """
    require_mohr_coulomb(solution.hopper)
    return solution.first_angle_with(tangency_angle(solution.hopper.delta))


@checked
def tangency_angle(delta: float) -> float:
    """Return the psi (radians) at which a characteristic is tangent to the arcs r = const.

    Examples
    --------
    >>> from hopper.stability.tilted import tangency_angle
    >>> round(tangency_angle(delta=0.7), 4)
    0.4354
    """
    return np.pi / 4 - delta / 2
