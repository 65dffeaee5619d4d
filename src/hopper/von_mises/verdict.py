"""One verdict on a von Mises cone: stable, unstable, or why that is not the question."""

from dataclasses import dataclass
from functools import lru_cache
from math import atan, degrees, isfinite, nan, pi
from typing import Literal

from hopper.arguments import AnyFloat, checked
from hopper.brief import brief
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    SingularVelocityError,
    WallFrictionError,
)
from hopper.problem import Hopper
from hopper.radial.collocation import Member, largest_psi
from hopper.radial.members import physical_member
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.roots import root_between
from hopper.values import require_angle
from hopper.von_mises.characteristics import TENSION, EquationType, equation_type, reaches
from hopper.von_mises.growth import Growth, growth, resolved_growth
from hopper.von_mises.modes import ResolvedModes, low_modes
from hopper.von_mises.saint_venant import EndEffects, end_effects
from hopper.yield_conditions import VON_MISES

Kind = Literal[
    "stable", "unstable", "neutral", "saint_venant", "mixed", "tension", "no_radial_solution",
    "not_converged",
]  # fmt: skip

# Error up to which an abscissa that does not differ from 0 counts as 0.
_NEUTRAL = 1e-6
_FIRST_STEP, _LAST_STEP = 0.1, 1e-4


@dataclass(frozen=True)
class Verdict:
    """What is known of the stability of a cone to axisymmetric disturbances without swirl.

    Attributes
    ----------
    verdict : str
        "stable", "unstable" or "neutral": hyperbolic flow, sup Re(lambda) below, above or at 0;
        "saint_venant": elliptic flow, end effects decay; "mixed": neither; "tension": T_rr <= 0 on
        the axis; "no_radial_solution"; "not_converged".
    reason : str
        One line, in degrees.
    type : EquationType or None
        Type of the equations; None without a radial flow.
    growth : Growth or None
        Of hyperbolic flows: modes, strips and their supremum.
    end_effects : EndEffects or None
        Of elliptic flows: modes, rays and decay exponents.
    modes : ResolvedModes or None
        Resolved modes, of mixed flows as information only.
    abscissa : float
        sup Re(lambda) but for the flow rate, of hyperbolic flows; else NaN, also of unstable ones
        of which no test bounds what modes not resolved may add.
    error_estimate : float
        Of the abscissa, with what modes not resolved may add to it; of the decay exponents.
    border : float
        Wall friction angle (radians) beyond which no radial flow exists, if that is the reason.
    """

    verdict: Kind
    reason: str
    type: EquationType | None = None
    growth: Growth | None = None
    end_effects: EndEffects | None = None
    modes: ResolvedModes | None = None
    abscissa: float = nan
    error_estimate: float = nan
    border: float = nan

    __repr__ = brief("verdict", "abscissa", "error_estimate")

    @property
    def slanted(self) -> bool:
        """Whether data belong on a surface t - f(theta) = const instead of r = const."""
        return self.type is not None and self.type.slanted


@checked
def judge(
    hopper: Hopper,
    friction_angle: AnyFloat,
    start: RadialSolution | None = None,
    *,
    tolerance: float = 1e-9,
    resolve: bool = True,
) -> Verdict:
    """Return the verdict on a von Mises cone; every valid cone has one.

    Parameters
    ----------
    hopper : Hopper
        A cone of von Mises material.
    friction_angle : float
        Wall friction angle phi, radians, in [0, pi/2).
    start : RadialSolution, optional
        A neighbour in a sweep; saves Newton steps.
    tolerance : float
        Relative error of the six lowest modes, between 1e-10 and 1e-6.
    resolve : bool
        Whether to refine hyperbolic flows until the test of resolution of
        :mod:`hopper.von_mises.growth` settles them; without, few stable ones are called so.

    Raises
    ------
    InvalidParameterError
        If the friction or the tolerance is not valid, or the material is not von Mises.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial, yield_condition
    >>> from hopper.von_mises.verdict import judge
    >>> hopper = Hopper("cone", 0.7, 0.2, yield_condition("von-mises"))
    >>> judge(hopper, friction_angle=0.1).verdict
    'stable'
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    _require_von_mises(hopper)
    if hopper.delta >= TENSION:
        return _tension(hopper)
    try:
        solution = solve_radial(hopper, friction_angle, start=start)
        return judge_solution(solution, tolerance=tolerance, resolve=resolve)
    except NonPositiveStressError as error:
        return Verdict("no_radial_solution", str(error))
    except (
        SingularVelocityError, NoRadialSolutionError, WallFrictionError, ConvergenceError,
    ) as error:  # fmt: skip
        return _no_flow(hopper, friction_angle, error)


@checked
def judge_solution(
    solution: RadialSolution, *, tolerance: float = 1e-9, resolve: bool = True
) -> Verdict:
    """Return the verdict on a radial flow, as :func:`judge`.

    Raises
    ------
    InvalidParameterError
        As :func:`judge`.
    SingularVelocityError
        If psi reaches pi/4.
    """
    _require_von_mises(solution.hopper)
    if solution.hopper.delta >= TENSION:
        return _tension(solution.hopper)
    if reaches(solution, pi / 4):
        theta, _ = solution.psi_maximum()
        raise SingularVelocityError("no radial flow: psi reaches 45 deg", theta)
    kind = equation_type(solution)
    try:
        if kind.kind == "mixed":
            return _mixed(solution, kind, tolerance)
        if kind.kind == "elliptic":
            return _elliptic(end_effects(solution, tolerance), kind)
        find = resolved_growth if resolve else growth
        return _hyperbolic(find(solution, tolerance), kind)
    except ConvergenceError as error:
        return Verdict("not_converged", str(error), kind)


@checked
@lru_cache(maxsize=256)
def flow_limit(hopper: Hopper) -> float:
    """Return the wall friction angle (radians) up to which a radial flow exists.

    There psi reaches pi/4: at the wall at mu = sin(delta), in wide cones inside and earlier. 0
    where not even a smooth wall has one.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises.
    """
    _require_von_mises(hopper)

    neighbour: Member | None = None

    def excess(phi: float) -> float:
        nonlocal neighbour
        member = physical_member(hopper, phi, neighbour)
        if member is None:
            raise ConvergenceError(f"no radial solution found at phi = {degrees(phi):.6g} deg")
        neighbour = member
        return largest_psi(member) - pi / 4 if member.tau > 0 else -pi / 4

    at_wall = atan(hopper.s)
    low, step = 0.0, _FIRST_STEP
    while step > _LAST_STEP and low < at_wall:
        high = min(low + step, at_wall)
        try:
            if excess(high) >= 0:
                return root_between(excess, low, high, xtol=1e-12)
            low = high
        except (ConvergenceError, NoRadialSolutionError):
            step /= 2
    return low


def _require_von_mises(hopper: Hopper) -> None:
    if hopper.material != VON_MISES:
        raise InvalidParameterError(
            f"material = {hopper.material.name} has a verdict of its own: use model = von-mises"
        )


def _tension(hopper: Hopper) -> Verdict:
    return Verdict(
        "tension",
        f"delta = {degrees(hopper.delta):.6g} deg is 60 deg or more: T_rr <= 0 on the axis; "
        "lower delta",
        EquationType("tension"),
    )


def _no_flow(hopper: Hopper, friction_angle: float, error: HopperError) -> Verdict:
    border = flow_limit(hopper)
    if border == 0:
        return Verdict("no_radial_solution", str(error), border=border)
    if friction_angle < border and isinstance(error, ConvergenceError):
        return Verdict("not_converged", str(error))
    reason = (
        f"no radial flow at phi = {degrees(friction_angle):.6g} deg: psi reaches 45 deg at "
        f"phi = {degrees(border):.6g} deg; lower the wall friction"
    )
    return Verdict("no_radial_solution", reason, border=border)


def _mixed(solution: RadialSolution, kind: EquationType, tolerance: float) -> Verdict:
    where = ", ".join(f"{degrees(theta):.6g}" for theta in kind.sonic)
    reason = (
        f"elliptic core and hyperbolic ring, sonic at theta = {where} deg: marching is ill-posed, "
        "and no set of end conditions is known to fit; modes are information only"
    )
    try:
        modes = low_modes(solution, tolerance)
    except ConvergenceError:
        modes = None
    return Verdict("mixed", reason, kind, modes=modes)


def _elliptic(found: EndEffects, kind: EquationType) -> Verdict:
    reason = (
        "elliptic: marching is ill-posed; end effects decay like "
        f"r**{found.decay_down:.6g} down and r**-{found.decay_up:.6g} up the hopper"
    )
    return Verdict(
        "saint_venant", reason, kind, end_effects=found, modes=found.modes,
        error_estimate=found.error_estimate,
    )  # fmt: skip


def _hyperbolic(found: Growth, kind: EquationType) -> Verdict:
    error = max(found.error_estimate, found.bound - found.abscissa)
    verdict: Kind
    value = f"sup Re(lambda) = {found.abscissa:.6g}, by a {found.governed_by}"
    if found.abscissa > found.error_estimate:
        verdict, reason = "unstable", value
        if not isfinite(error):
            reason = f"Re(lambda) up to {found.abscissa:.6g}, and modes not resolved may exceed it"
    elif found.bound + found.error_estimate < 0:
        verdict, reason = "stable", f"{value}; no mode seen or expected above {found.bound:.6g}"
    elif error <= _NEUTRAL:
        verdict, reason = "neutral", f"{value}, which is 0 within its error"
    else:
        verdict, reason = "not_converged", f"{value}, but modes not resolved may grow"
    known = verdict != "not_converged" and isfinite(error)
    return Verdict(
        verdict, reason, kind, growth=found, modes=found.modes,
        abscissa=found.abscissa if known else nan, error_estimate=error if known else nan,
    )  # fmt: skip
