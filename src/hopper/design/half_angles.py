"""How wide a hopper may be for its material and wall: the half angles at which something ends.

All are functions of the half angle at given delta and wall friction, so that an answer is a root.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import degrees, isnan, nan, pi, radians
from typing import Literal, TypeVar, get_args

import numpy as np

from hopper.arguments import checked
from hopper.assessment.propagation import ROUNDING
from hopper.brief import brief
from hopper.design.material import NARROWEST, Material
from hopper.design.neutral import last_run, neutral_between
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NoLimitError,
    NoRadialSolutionError,
    NowhereError,
)
from hopper.quantity import Quantity
from hopper.radial.flow_curve import WIDEST, flow_curve
from hopper.radial.friction_limit import friction_limit
from hopper.radial.mass_flow import mass_flow_half_angle
from hopper.radial.members import physical_member
from hopper.roots import root_between
from hopper.stability.modes import Disturbances, linear_stability
from hopper.yield_conditions import MOHR_COULOMB

Limit = Literal["classical", "limit", "velocity", "stability"]
LIMITS: tuple[Limit, ...] = get_args(Limit)
_Found = TypeVar("_Found")

# Where roots end (radians).
_ROOT = 1e-12
# Half angles at which stability is looked at, and how far below the limit of friction the last may
# be, relative: the first of these at which fields are resolved.
_SAMPLES, _BELOW = 16, (1e-8, 1e-6, 1e-4, 1e-2, 0.05, 0.2)
# Relative distance of tau within which two members are one.
_CLOSE = 1e-3
# Cones have a radial solution up to the classical limit and mostly little beyond it (radians).
_BESIDE = radians(2)
# Step for slopes, radians.
_STEP = 1e-6


@dataclass(frozen=True)
class HalfAngles:
    """The half angles (radians) up to which something holds, from the narrowest hopper on.

    Attributes
    ----------
    classical : Quantity or None
        The material slips along the wall: sigma_0 -> 0, Jenike's mass-flow limit. Cones with
        sin(delta) >= 1/3.
    limit : Quantity or None
        A radial solution exists.
    velocity : Quantity or None
        Radial flow reaches the wall: psi stays below pi/4.
    stability : Quantity or None
        The radial solution is stable: the largest half angle of which that is true.
    stable_from : Quantity or None
        The least half angle of that stable interval, where narrower hoppers are not stable.
    mass_flow : Quantity or None
        The one of mass flow: ``classical`` of Mohr-Coulomb cones, ``velocity`` of others.
    no_mass_flow : str
        Why that is None; empty otherwise.
    notes : tuple of str
        Why something is None.
    """

    classical: Quantity | None
    limit: Quantity | None
    velocity: Quantity | None
    stability: Quantity | None
    stable_from: Quantity | None
    mass_flow: Quantity | None
    no_mass_flow: str
    notes: tuple[str, ...]

    __repr__ = brief("classical deg", "limit deg", "velocity deg", "stability deg")

    @property
    def governed_by(self) -> Limit | None:
        """Which of the limits is the smallest, None where there is none."""
        known = [name for name in LIMITS if getattr(self, name)]
        return min(known, key=lambda name: getattr(self, name).value, default=None)

    @property
    def smallest(self) -> Quantity | None:
        """The smallest of the limits."""
        found: Quantity | None = self.governed_by and getattr(self, self.governed_by)
        return found


@checked
def half_angles(material: Material, disturbances: Disturbances | None = None) -> HalfAngles:
    """Return the half angles up to which something holds.

    ``disturbances`` as in :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    WallFrictionError
        If the material cannot transmit the wall's friction.
    InvalidParameterError
        If an angle is out of range, or asymmetric disturbances of a cone are asked for.

    Examples
    --------
    >>> from hopper.design.half_angles import half_angles
    >>> from hopper.design.material import Material
    >>> found = half_angles(Material("cone", delta=0.7, friction_angle=0.28))
    >>> round(found.classical.value, 4)
    0.5636
    """
    narrow = material.hopper(NARROWEST)
    narrow.material.wall_angle(narrow.delta, material.friction_angle)
    notes: dict[Limit, str] = {}
    classical = _noted(notes, "classical", lambda: _classical(material))
    limit = _noted(notes, "limit", lambda: _limit(material))
    velocity = _noted(notes, "velocity", lambda: _velocity(material))
    stable = _noted(notes, "stability", lambda: _stable(material, limit, disturbances))
    least, stability = stable or (None, None)
    name: Limit = "classical" if material.slips else "velocity"
    return HalfAngles(
        classical,
        limit,
        velocity,
        stability,
        stable_from=least,
        mass_flow=classical if name == "classical" else velocity,
        no_mass_flow=notes.get(name, ""),
        notes=tuple(f"{name}: {reason}" for name, reason in notes.items()),
    )


@checked
def flow_limit(material: Material) -> Quantity:
    """Return the half angle (radians) up to which there is mass flow.

    That is where the material ceases to slip along the wall in Mohr-Coulomb cones, and where radial
    flow ceases to reach the wall in wedges and for von Mises materials.

    Raises
    ------
    NoLimitError
        If there is no such half angle; the message says whether that is for want of a limit.
    WallFrictionError
        If the material cannot transmit the wall's friction.
    ConvergenceError
        If it is not resolved.

    Examples
    --------
    >>> from hopper.design.half_angles import flow_limit
    >>> from hopper.design.material import Material
    >>> round(flow_limit(Material("cone", delta=0.7, friction_angle=0.28)).value, 4)
    0.5636
    """
    return _classical(material) if material.slips else _velocity(material)


def _noted(notes: dict[Limit, str], name: Limit, find: Callable[[], _Found]) -> _Found | None:
    try:
        return find()
    except HopperError as error:
        notes[name] = str(error)
        return None


def _classical(material: Material) -> Quantity:
    if not material.slips:
        raise NoLimitError("known of Mohr-Coulomb cones only")

    def angle(delta: float) -> float:
        hopper = replace(material.hopper(NARROWEST), delta=delta)
        return mass_flow_half_angle(hopper, material.friction_angle)

    try:
        found = angle(material.delta)
    except InvalidParameterError as error:
        raise NoLimitError(str(error)) from None
    if found <= 0:
        raise NowhereError("the wall is too rough for mass flow at any half angle")
    rounded = abs(angle(material.delta * (1 + ROUNDING)) - found)
    return Quantity(found, rounded + ROUNDING)


def _limit(material: Material) -> Quantity:
    def excess(half_angle: float) -> float:
        try:
            found = friction_limit(material.hopper(half_angle))
        except NoRadialSolutionError:
            return -pi / 2  # not even for a smooth wall
        return found.friction_angle - material.friction_angle

    root = root_between(excess, *_bracket(material, excess), xtol=_ROOT)
    try:
        here, before = (friction_limit(material.hopper(angle)) for angle in (root, root - _STEP))
    except NoRadialSolutionError:  # a smooth wall, of which the limit is where the family ends
        return Quantity(root, _STEP)
    slope = abs(before.friction_angle - here.friction_angle) / _STEP
    return Quantity(root, here.error_estimate / slope + _ROOT + ROUNDING if slope else _STEP)


def _bracket(material: Material, excess: Callable[[float], float]) -> tuple[float, float]:
    """Return half angles with a radial solution and without one, close where that is known."""
    try:
        near = _classical(material).value
    except NoLimitError:
        near = WIDEST
    beyond = near + _BESIDE
    if beyond < WIDEST and excess(near) > 0 and excess(beyond) <= 0:
        return near, beyond
    if excess(NARROWEST) <= 0:
        raise NowhereError("no half angle has a radial solution with this wall")
    if excess(WIDEST) > 0:
        raise NoLimitError("radial solutions exist at every half angle")
    return NARROWEST, WIDEST


def _velocity(material: Material) -> Quantity:
    hopper = material.hopper(NARROWEST)
    psi_wall = hopper.material.wall_angle(hopper.delta, material.friction_angle)
    if psi_wall >= pi / 4:
        raise NowhereError("radial flow reaches the wall at no half angle")
    curve = flow_curve(hopper)
    found = curve and curve.half_angle(psi_wall)
    if not (curve and found and _physical(material, found.value, curve.member.tau)):
        raise NoLimitError("radial flow reaches the wall wherever it exists")
    return found


def _physical(material: Material, half_angle: float, tau: float) -> bool:
    """Whether a hopper's member of that tau is the physical one; only cones have others."""
    if not material.slips:
        return True
    member = physical_member(material.hopper(half_angle), material.friction_angle)
    return member is not None and abs(member.tau / tau - 1) < _CLOSE


def _widest_solved(material: Material, widest: float) -> float:
    """Return the half angle closest to the widest one whose radial solution is resolved."""
    for share in _BELOW:
        try:
            material.solution(widest * (1 - share))
        except (ConvergenceError, NoRadialSolutionError):
            continue
        return widest * (1 - share)
    raise ConvergenceError("no radial solution is resolved close to the limit of friction")


def _stable(
    material: Material, limit: Quantity | None, disturbances: Disturbances | None
) -> tuple[Quantity | None, Quantity]:
    """Return the ends of the last stable interval of half angles; the first None without one."""
    if material.condition != MOHR_COULOMB:
        raise NoLimitError("looked at for Mohr-Coulomb materials only")

    def abscissa(half_angle: float) -> float:
        return linear_stability(material.solution(half_angle), disturbances).abscissa

    def root(low: float, high: float) -> Quantity:
        return neutral_between(material.solution, low, high, _ROOT, disturbances)

    end = _widest_solved(material, limit.value) if limit else WIDEST
    angles = np.linspace(NARROWEST, end, _SAMPLES)
    values = np.array([_or_nan(abscissa, angle) for angle in angles.tolist()])
    run = last_run(values < 0)
    if run is None:
        known = "" if np.isfinite(values).all() else " of those resolved"
        raise NowhereError(f"no half angle is stable{known}")
    first, last = run
    least = root(angles[first - 1], angles[first]) if first and values[first - 1] >= 0 else None
    if last + 1 < angles.size and not isnan(values[last + 1]):
        return least, root(angles[last], angles[last + 1])
    widest = degrees(angles[last])
    if last + 1 < angles.size:
        raise ConvergenceError(f"stable up to {widest:.4g} deg at least; not resolved beyond")
    if limit is None:
        raise NoLimitError(f"stable up to {widest:.4g} deg, the widest looked at")
    return least, limit


def _or_nan(function: Callable[[float], float], half_angle: float) -> float:
    try:
        return function(half_angle)
    except HopperError:
        return nan
