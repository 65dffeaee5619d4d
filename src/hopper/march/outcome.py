"""What becomes of a stress on its way down a hopper: it breaks down, or settles.

Two ways to break down are watched: crossings on the nets, tangencies on the loop. sigma > 0 is no
third: its logarithm is marched; gravity drives a light stress up again, or into a tangency.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp
from typing import Literal

import numpy as np

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.march.base import Base, radial_fields, tilt_height
from hopper.march.crossing import Crossing, net_verdict
from hopper.march.fields import deviations, interpolated, momentum_residual, state_at
from hopper.march.loop import History, corner_defect, make_loop, march_loop
from hopper.march.net import make_net
from hopper.march.rays import first_crossing_of_rays
from hopper.march.settling import linear_growth, settled_radius
from hopper.march.tops import Top, require_admissible, riemann_deviation

Kind = Literal["crossing", "tangency", "kink"]

# Points of a leg on successive meshes; the last ones are for marches that do not resolve earlier.
_SIZES = (48, 64, 96, 128, 192)
# Largest disagreement of two meshes in log sigma and psi up to which a march is trusted.
_TRUSTED = 0.01
# Part of the way to a breakdown on which the fields are to have the wanted error: no mesh resolves
# its end.
_RESOLVABLE = 0.8
# Part of the way to a tangency to which the march must be trusted for it to be real: unresolved
# waves close to a crossing make tangencies of their own.
_NEARLY = 0.98
_SAMPLES, _ANGLES, _RESIDUALS = 400, 40, 5
# Error wanted of the breakdown's tau.
_BREAKDOWN = 1e-5
# Largest difference of r / r_top between two meshes with which a settled radius is given.
_RADIUS = 0.02
# exp(-700) is about the least r / r_top that is a number.
_DEEPEST = 700.0
# Relative difference of rates on both sides of a corner that counts as rounding.
_COMPATIBLE = 1e-6
# Difference of two meshes that is enough where a kink runs: it falls slowly.
_KINKED = 1e-3
# Meshes for rays with their steps from wall to wall, and the factor on the difference of their
# results: near a crossing the error falls about like the spacing only.
_RAY_MESHES, _RAY_SAFETY = ((96, 201), (216, 401)), 3.0


@dataclass(frozen=True)
class Settled:
    """r / r_top from which on the stress is within ``level`` of the radial field's, for good.

    That is to say: to the end of the trusted march, at least three loop times below. None where it
    is not reached, not trusted, or small deviations grow; ``error`` is what two meshes differ by.
    """

    level: float
    radius: float | None
    error: float | None

    __repr__ = brief("level", "radius", "error")


@dataclass(frozen=True)
class Breakdown:
    """Where a march breaks down.

    Attributes
    ----------
    tau : float
        tau, or tilted tau if the base is tilted.
    error : float
        Of ``tau``.
    position : float
        theta / theta_w; not negative in a symmetric stress.
    radius : float
        r / r_top.
    """

    tau: float
    error: float
    position: float
    radius: float

    __repr__ = brief("tau", "error", "position", "radius")


@dataclass(frozen=True, eq=False)
class March:
    """What becomes of a stress.

    Attributes
    ----------
    base : Base
    top : Top
    kind : "crossing", "tangency", "kink" or None
        How it ends: characteristics cross; one becomes tangent to the lines of constant tau; a kink
        of the top, focused on the axis of a cone, makes crossings that no mesh places; not at all.
    breakdown : Breakdown or None
        Of the crossing or the tangency.
    tangency_tau : float or None
        tau of the first tangency, if there is one before a crossing.
    trusted_tau : float
        tau up to which two meshes agree to 1 %; fields are given up to there.
    error_estimate : float
        What two meshes differ by in log sigma and psi up to ``trusted_tau``.
    residual : float
        Largest residual of the momentum balance at a few times, in units of rho g; not in the
        last fifth before a breakdown, which no mesh resolves.
    settled : tuple of Settled
    history : History
    """

    base: Base
    top: Top
    kind: Kind | None
    breakdown: Breakdown | None
    tangency_tau: float | None
    trusted_tau: float
    error_estimate: float
    residual: float
    settled: tuple[Settled, ...]
    history: History

    __repr__ = brief("top.name", "kind", "trusted_tau", "error_estimate")

    @checked
    def fields(self, tau: float, theta: RealRow) -> tuple[Array, Array]:
        """Return sigma (over rho g r) and psi (radians) at a time and angles, shape (n,) each.

        Raises
        ------
        InvalidParameterError
            If tau is not within the trusted part of the march, or an angle not in the hopper.
        """
        if not 0 <= tau <= self.trusted_tau:
            raise InvalidParameterError(
                f"tau = {tau!r} is not within the march, which can be trusted up to "
                f"tau = {self.trusted_tau:.6g}: no smooth stress is known there"
            )
        theta = np.asarray(theta)
        sigma, psi = radial_fields(self.base, theta)
        w = state_at(self.history, tau)
        even, odd = deviations(self.history.loop, w, theta / self.base.hopper.half_angle)
        return sigma * np.exp(even), psi + odd


@checked
def march(
    base: Base,
    top: Top,
    tau_end: float,
    tolerance: float = 1e-4,
    levels: Sequence[float] = (0.05, 0.01),
) -> March:
    """March a stress from the top down to tau = -log(r / r_top) = ``tau_end``, or to its breakdown.

    Parameters
    ----------
    base : Base
        From :func:`hopper.march.base.base_of`; if tilted, tau is tilted.
    top : Top
        Stress at tau = 0.
    tau_end : float
        Depth, positive.
    tolerance : float
        Wanted difference of two meshes in log sigma and psi (1e-3 at best, where a kink of the top
        runs); before a breakdown, on the first four fifths of the way.
    levels : sequence of float
        Distances from the radial field, over its sigma, for the settled radii.

    Raises
    ------
    InvalidParameterError
        If the depth is not positive or too large, or the top breaks the wall law or symmetry.
    TangencyError
        If the top is beyond the tangency.
    ConvergenceError
        If the top is too rough for the finest mesh.
    """
    if not 0 < tau_end <= _DEEPEST:
        raise InvalidParameterError(
            f"tau_end = {tau_end!r} must be positive and at most {_DEEPEST:g}, where "
            "r = r_top exp(-tau_end) vanishes"
        )
    require_admissible(base, top)
    start = _history(base, top, _SIZES[1], 0.0)
    kinked = corner_defect(start.loop, start.w[0]) > _COMPATIBLE
    kind, stop, breakdown = _on_nets(base, top, tau_end, kinked)
    wanted = max(tolerance, _KINKED) if kinked else tolerance
    coarse, fine, tau, error = _on_two_meshes(base, top, stop, wanted, stop < tau_end)
    trusted = float(tau[error <= _TRUSTED][-1])
    tangency = _tangency(coarse, fine, trusted)
    if tangency is not None:
        kind, breakdown = "tangency", tangency
    for_good = linear_growth(make_loop(base, _SIZES[0], fine.loop.legs)) < 0
    resolved = trusted if kind is None else _RESOLVABLE * trusted
    times = np.linspace(0, resolved, _RESIDUALS + 1)[1:]
    return March(
        base=base,
        top=top,
        kind=kind,
        breakdown=breakdown,
        tangency_tau=None if tangency is None else tangency.tau,
        trusted_tau=trusted,
        error_estimate=float(error[tau <= trusted].max()),
        residual=max(momentum_residual(fine, float(each)) for each in times),
        settled=tuple(
            _settled(coarse, fine, trusted, level) if for_good else Settled(level, None, None)
            for level in levels
        ),
        history=fine,
    )


@checked
def crossing_of_rays(base: Base, top: Top, tau_end: float) -> Crossing | None:
    """Return the first crossing by Jacobians along rays, a second way to that of :func:`march`.

    ``tau_end`` should not be far behind the crossing: the fields have no meaning there. A crossing
    of C+ just behind the axis of a cone is placed too early, by more than the error says.

    Raises
    ------
    InvalidParameterError, TangencyError
        As :func:`march`.
    """
    require_admissible(base, top)
    found = [
        first_crossing_of_rays(_history(base, top, points, tau_end), steps)
        for points, steps in _RAY_MESHES
    ]
    coarse, fine = found
    if coarse is None or fine is None:
        return None
    error = _RAY_SAFETY * float(abs(fine[0] - coarse[0]))
    return Crossing(float(fine[0]), float(fine[1]), 1 if fine[2] > 0 else -1, error)


def _history(base: Base, top: Top, points: int, tau_end: float) -> History:
    loop = make_loop(base, points, 1 if top.symmetric else 2)
    w = riemann_deviation(base, top, loop.mesh.x)
    return march_loop(loop, np.stack([w[0], w[1, ::-1]])[: loop.legs], tau_end)


def _on_nets(
    base: Base, top: Top, tau_end: float, kinked: bool
) -> tuple[Kind | None, float, Breakdown | None]:
    """Return how nets see the march end, the time up to which they follow it, and the crossing."""
    verdict = net_verdict(
        make_net(base, top.symmetric),
        lambda x: riemann_deviation(base, top, x),
        tau_end,
        _BREAKDOWN,
        kinked=kinked,
    )
    if verdict.first_tau is None:
        return None, tau_end, None
    if verdict.crossing is None:
        return "kink", verdict.first_tau, None
    at = verdict.crossing
    return "crossing", at.tau, _breakdown(base, at.tau, at.error, at.theta)


def _breakdown(base: Base, tau: float, error: float, theta: float) -> Breakdown:
    height = float(tilt_height(base, np.array([theta]))[0])
    return Breakdown(tau, error, theta / base.hopper.half_angle, exp(-tau - height))


def _on_two_meshes(
    base: Base, top: Top, stop: float, tolerance: float, breaks: bool
) -> tuple[History, History, Array, Array]:
    """Return the march on two meshes, times, and their largest difference up to each of them."""
    x = np.linspace(0 if top.symmetric else -1, 1, _ANGLES + 1)
    coarse, fine = (_history(base, top, points, stop) for points in _SIZES[:2])
    tau, error = _differences(coarse, fine, x)
    for points in _SIZES[2:]:
        wanted = float(error[int(_RESOLVABLE * _SAMPLES) if breaks else -1])
        if wanted <= tolerance:
            break
        finer = _history(base, top, points, stop)
        finer_tau, finer_error = _differences(fine, finer, x)
        coarse, fine, tau, error = fine, finer, finer_tau, finer_error
    if not error[0] <= _TRUSTED:
        raise ConvergenceError(
            f"the top is not resolved by {fine.loop.y.size} points: with fewer it differs by "
            f"{error[0]:.1e} in log sigma or psi; give a smoother top"
        )
    return coarse, fine, tau, error


def _differences(coarse: History, fine: History, x: Array) -> tuple[Array, Array]:
    """Return times and the largest difference of log sigma and psi up to each of them."""
    tau = np.linspace(0, min(float(coarse.tau[-1]), float(fine.tau[-1])), _SAMPLES + 1)
    one, other = (
        np.stack(deviations(each.loop, interpolated(each, tau), x)) for each in (coarse, fine)
    )
    return tau, np.maximum.accumulate(np.abs(one - other).max(axis=(0, 2)))


def _tangency(coarse: History, fine: History, trusted: float) -> Breakdown | None:
    """Return the tangency that ends the march on both meshes, if one does while they agree."""
    if coarse.tangency is None or fine.tangency is None:
        return None
    tau, theta = fine.tangency
    if trusted < _NEARLY * tau:
        return None
    theta = abs(theta) if fine.loop.legs == 1 else theta
    return _breakdown(fine.loop.base, tau, abs(tau - coarse.tangency[0]), theta)


def _settled(coarse: History, fine: History, tau_end: float, level: float) -> Settled:
    radii = [settled_radius(each, tau_end, level) for each in (coarse, fine)]
    if radii[0] is None or radii[1] is None or abs(radii[1] - radii[0]) > _RADIUS:
        return Settled(level, None, None)
    return Settled(level, radii[1], abs(radii[1] - radii[0]))
