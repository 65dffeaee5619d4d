"""What becomes of a stress on its way down a hopper: it breaks down, or settles.

Two ways to break down are watched: crossings on the nets, tangencies on the loop. sigma > 0 is no
third: its logarithm is marched; gravity drives a light stress up again, or into a tangency.
"""

from collections.abc import Callable, Sequence
from math import exp

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.march.base import Base, tilt_height
from hopper.march.crossing import Crossing, NetVerdict, net_verdict
from hopper.march.fields import deviations, interpolated, momentum_residual
from hopper.march.history import History, Report, march_loop
from hopper.march.loop import corner_defect, make_loop
from hopper.march.net import make_net
from hopper.march.optics import calm_slope
from hopper.march.rays import first_crossing_of_rays
from hopper.march.result import ANGLES, Breakdown, Kind, March, Settled
from hopper.march.settling import linear_growth, settled_radius
from hopper.march.tops import Top, require_admissible, riemann_deviation

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
_SAMPLES, _RESIDUALS = 400, 5
# Cells of the coarsest net of characteristics, and the largest number of nets.
_CELLS, _NETS = 64, 4
# Error wanted of the breakdown's tau, and in parts of the one wanted of log sigma and psi.
_BREAKDOWN, _OF_BREAKDOWN = 1e-5, 0.1
# Largest error of r / r_top with which a settled radius is given.
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


@checked
def march(
    base: Base,
    top: Top,
    tau_end: float,
    tolerance: float = 1e-4,
    levels: Sequence[float] = (0.05, 0.01),
    cells: int = _CELLS,
    report: Callable[[str, float], object] | None = None,
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
        runs); before a breakdown, on the first four fifths of the way. A tenth of it is the wanted
        error of the breakdown's tau.
    levels : sequence of float
        Distances from the radial field, over its sigma, for the settled radii.
    cells : int
        Of the coarsest net of characteristics; with fewer the place of a crossing is less exact.
    report : function, optional
        Told what is being marched, and its tau, now and then.

    Raises
    ------
    InvalidParameterError
        If the depth is not positive or too large, or the top breaks the wall law or symmetry.
    TangencyError
        If the top is beyond the tangency.
    ConvergenceError
        If the top is too rough for the finest mesh.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.march.base import base_of
    >>> from hopper.march.outcome import march
    >>> from hopper.march.tops import bump_of_sigma
    >>> wedge = Hopper("wedge", delta=0.8, half_angle=0.25)
    >>> march(base_of(solve_radial(wedge, 0.2)), bump_of_sigma(0.4), tau_end=1.0).kind
    'crossing'
    """
    if not 0 < tau_end <= _DEEPEST:
        raise InvalidParameterError(
            f"tau_end = {tau_end!r} must be positive and at most {_DEEPEST:g}, where "
            "r = r_top exp(-tau_end) vanishes"
        )
    require_admissible(base, top)
    tell = report or _silent
    start = _history(base, top, _SIZES[1], 0.0, tell)
    kinked = corner_defect(start.loop, start.w[0]) > _COMPATIBLE
    verdict = _verdict(base, top, tau_end, kinked, _OF_BREAKDOWN * tolerance, tell, cells)
    kind, stop, breakdown = _on_nets(base, verdict, tau_end)
    wanted = max(tolerance, _KINKED) if kinked else tolerance
    coarse, fine, tau, error = _on_two_meshes(base, top, stop, wanted, tau_end, levels, tell)
    trusted = _trusted(tau, error)
    tangency = _tangency(coarse, fine, trusted)
    if tangency is not None:
        kind, breakdown = "tangency", tangency
    return March(
        base=base,
        top=top,
        kind=kind,
        breakdown=breakdown,
        tangency_tau=None if tangency is None else tangency.tau,
        trusted_tau=trusted,
        error_estimate=float(error[tau <= trusted].max()),
        residual=_residual(fine, trusted if kind is None else _RESOLVABLE * trusted),
        differences=np.stack([tau, error])[:, tau <= trusted],
        kinked=kinked,
        settled=tuple(map(_settled, levels, _radii(coarse, fine, trusted, levels))),
        history=fine,
    )


@checked
def first_crossing(
    base: Base, top: Top, tau_end: float, tolerance: float = _BREAKDOWN, cells: int = _CELLS
) -> NetVerdict:
    """Return what nets of characteristics say of the first crossing, without a march on the loop.

    Parameters
    ----------
    base, top, tau_end
        As those of :func:`march`.
    tolerance : float
        Wanted error of tau.
    cells : int
        Of the coarsest net.

    Raises
    ------
    InvalidParameterError, TangencyError
        As :func:`march`.
    """
    require_admissible(base, top)
    start = _history(base, top, _SIZES[1], 0.0)
    kinked = corner_defect(start.loop, start.w[0]) > _COMPATIBLE
    return _verdict(base, top, tau_end, kinked, tolerance, _silent, cells)


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


def _silent(_: str, __: float) -> None:
    """Report nothing."""


def _history(base: Base, top: Top, points: int, tau_end: float, tell: Report = _silent) -> History:
    loop = make_loop(base, points, 1 if top.symmetric else 2)
    w = riemann_deviation(base, top, loop.mesh.x)
    return march_loop(loop, np.stack([w[0], w[1, ::-1]])[: loop.legs], tau_end, tell)


def _on_nets(
    base: Base, verdict: NetVerdict, tau_end: float
) -> tuple[Kind | None, float, Breakdown | None]:
    """Return how nets see the march end, the time up to which they follow it, and the crossing."""
    if verdict.first_tau is None:
        return None, tau_end, None
    if verdict.crossing is None:
        return "kink", verdict.first_tau, None
    at = verdict.crossing
    return "crossing", at.tau, _breakdown(base, at.tau, at.error, at.theta)


def _verdict(
    base: Base, top: Top, tau_end: float, kinked: bool, tolerance: float, tell: Report, cells: int
) -> NetVerdict:
    return net_verdict(
        make_net(base, top.symmetric),
        lambda x: riemann_deviation(base, top, x),
        tau_end,
        tolerance,
        kinked=kinked,
        calm=calm_slope(base),
        tell=tell,
        sizes=[cells << doublings for doublings in range(_NETS)],
    )


def _breakdown(base: Base, tau: float, error: float, theta: float) -> Breakdown:
    height = float(tilt_height(base, np.array([theta]))[0])
    return Breakdown(tau, error, theta / base.hopper.half_angle, exp(-tau - height))


def _on_two_meshes(
    base: Base,
    top: Top,
    stop: float,
    tolerance: float,
    tau_end: float,
    levels: Sequence[float],
    tell: Report,
) -> tuple[History, History, Array, Array]:
    """Return the march on two meshes, times, and their largest difference up to each of them."""
    x = np.linspace(0 if top.symmetric else -1, 1, ANGLES + 1)
    coarse, fine = (_history(base, top, points, stop, tell) for points in _SIZES[:2])
    tau, error = _differences(coarse, fine, x)
    for points in _SIZES[2:]:
        wanted = float(error[int(_RESOLVABLE * _SAMPLES) if stop < tau_end else -1])
        if wanted <= tolerance:
            radii = _radii(coarse, fine, _trusted(tau, error), levels)
            if all(each is None or each[1] <= _RADIUS for each in radii):
                break
        finer = _history(base, top, points, stop, tell)
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


def _residual(history: History, tau_end: float) -> float:
    times = np.linspace(0, tau_end, _RESIDUALS + 1)[1:]
    return max(momentum_residual(history, float(each)) for each in times)


def _radii(
    coarse: History, fine: History, tau_end: float, levels: Sequence[float]
) -> list[tuple[float, float] | None]:
    """Return settled radii with their errors, where small deviations do not grow again."""
    if linear_growth(make_loop(fine.loop.base, _SIZES[0], fine.loop.legs)) >= 0:
        return [None] * len(levels)
    return [settled_radius(coarse, fine, tau_end, level) for level in levels]


def _settled(level: float, found: tuple[float, float] | None) -> Settled:
    if found is None or found[1] > _RADIUS:
        return Settled(level, None, None)
    return Settled(level, *found)


def _trusted(tau: Array, error: Array) -> float:
    """Return the time up to which two meshes agree."""
    return float(tau[error <= _TRUSTED][-1])
