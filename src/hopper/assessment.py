"""What is known about one hopper: radial solution, limits of wall friction, stability.

Every number carries an absolute error. Errors of the radial fields are propagated to first order:
the fields are shifted along a few directions, among them the one in which their equations are
worst conditioned, and the changes that follow, scaled to the error of the fields, are added up.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import exp, pi, tan
from typing import Literal, get_args

import numpy as np
from scipy.optimize import minimize_scalar

from hopper.chebyshev import Array
from hopper.domain import NoNeutralPointError, neutral_curve, neutral_delta, tangency_friction
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
    SingularVelocityError,
    TangencyError,
)
from hopper.family import FrictionLimit, friction_limit, members_with_wall_angle
from hopper.flow_factor import flow_factor
from hopper.mass_flow import mass_flow_friction_angle
from hopper.problem import Geometry, Hopper
from hopper.radial import RadialSolution, solve_radial
from hopper.radial_collocation import Member
from hopper.spectrum import HALVES, convergence_filter, mesh_spectrum
from hopper.stability import Complex, Stability, stability, upper_eigenvalues
from hopper.transient import ModalBasis, condition_number, modal_basis, propagator_norm
from hopper.velocity import VelocityField, solve_velocity
from hopper.yield_conditions import MOHR_COULOMB

Verdict = Literal["stable", "unstable", "neutral"]
Outcome = Literal[
    Verdict,
    "tangent_characteristic",
    "no_radial_solution",
    "non_positive_stress",
    "not_converged",
    "not_formulated",
]
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)

_ROUNDING = 4 * float(np.finfo(float).eps)
# Shift of the fields for first-order propagation, relative to their size.
_SHIFT = 1e-8
# Half-grid points on which eigenvalues are followed under such a shift.
_SENSITIVITY_SIZE = 48
# Nodes of the two meshes for transient growth, and the largest change of a kept mode between them.
_NODES, _COARSE_NODES, _CHANGE = 96, 64, 1e-6
# Round trips of a wave between axis and wall over which growth is followed; samples of each.
_TRIPS, _SAMPLES = 4, 64
# Steps, in radians: for slopes over an angle, and in phi along the neutral curve.
_STEP, _PHI_STEP = 1e-6, 0.035
# Error of the end of the neutral curve: 1e-6 degrees.
_END_ERROR = pi / 180e6


@dataclass(frozen=True)
class Quantity:
    """A number and its absolute error, in the same unit."""

    value: float
    error: float


@dataclass(frozen=True)
class Limits:
    """Limits of a hopper's wall friction, whatever the friction of its own wall.

    Attributes
    ----------
    friction : FrictionLimit or None
        Largest friction with a radial solution, and what ends the branch there; None where it is
        not resolved or not even a smooth wall has a solution.
    coefficient : Quantity or None
        The same as mu = tan(phi).
    mass_flow : Quantity or None
        phi of sigma_0 -> 0, radians; None but for Mohr-Coulomb cones with sin(delta) >= 1/3.
    tangency : Quantity or None
        mu at which psi reaches pi/4 - delta/2, where linear stability ends; None where it does
        not, and for von Mises materials.
    """

    friction: FrictionLimit | None
    coefficient: Quantity | None
    mass_flow: Quantity | None
    tangency: Quantity | None


@dataclass(frozen=True)
class RadialAssessment:
    """A radial solution in numbers; angles in radians, stresses in units of rho g r.

    Attributes
    ----------
    solution : RadialSolution
    velocity : VelocityField or None
        None where psi reaches pi/4, or comes too close to be resolved.
    sigma_axis, sigma_wall : Quantity
        Average stress at theta = 0 and theta_w.
    psi_wall, psi_max, theta_psi_max : Quantity
        psi(theta_w), the largest psi, and where it is.
    u_wall : Quantity or None
        u(theta_w) / u(0).
    flow_factor : Quantity
    solutions : int or None
        Number of radial solutions for this wall; None where the family is not resolved.
    limits : Limits
    notes : tuple of str
        Why something is None.
    """

    solution: RadialSolution
    velocity: VelocityField | None
    sigma_axis: Quantity
    sigma_wall: Quantity
    psi_wall: Quantity
    psi_max: Quantity
    theta_psi_max: Quantity
    u_wall: Quantity | None
    flow_factor: Quantity
    solutions: int | None
    limits: Limits
    notes: tuple[str, ...]

    def profiles(self, theta: Array) -> tuple[Array, Array, Array | None]:
        """Return sigma, psi and u at ``theta`` (radians), each of shape (n,); u None if unknown."""
        sigma, psi, _, _ = self.solution.fields(theta)
        return sigma, psi, self.velocity.at(theta) if self.velocity else None


@dataclass(frozen=True)
class Transient:
    """Growth of perturbations in the span of the resolved modes of physical parity.

    The norm is L2 of (sigma1, psi1). Growth is followed for the first four round trips of a wave
    between axis and wall. More modes resolve narrower perturbations, which can grow more; in
    cones, where waves focus on the axis, without bound. So the number of modes is part of the
    answer.

    Attributes
    ----------
    modes : int
    condition : Quantity
        kappa(V), the bound of (4.11) on ``amplification``.
    amplification : Quantity
        Largest ||exp(-t M)|| / exp(-t alpha), alpha the spectral abscissa.
    growth : Quantity or None
        Largest ||exp(-t M)||; None unless the hopper is stable.
    """

    modes: int
    condition: Quantity
    amplification: Quantity
    growth: Quantity | None


@dataclass(frozen=True)
class StabilityAssessment:
    """Linear stability of a radial solution in numbers.

    Attributes
    ----------
    result : Stability
        Low modes, line, and what governs.
    mode_errors : array, shape (n,)
        Absolute errors of the low modes.
    abscissa : Quantity
    spectrum : complex array, shape (k,)
        Low modes, and further modes resolved to 1e-6, Im >= 0, by modulus.
    spectrum_errors : array, shape (k,)
        Absolute.
    transient : Transient or None
        None where too few modes are resolved.
    """

    result: Stability
    mode_errors: Array
    abscissa: Quantity
    spectrum: Complex
    spectrum_errors: Array
    transient: Transient | None

    @property
    def verdict(self) -> Verdict:
        """Stable or unstable; neutral where the error of the abscissa exceeds its size."""
        if abs(self.abscissa.value) <= self.abscissa.error:
            return "neutral"
        return "stable" if self.abscissa.value < 0 else "unstable"


@dataclass(frozen=True)
class NeutralPoint:
    """The delta (radians) that separates unstable (smaller) from stable hoppers."""

    delta: Quantity
    governed_by: Literal["mode", "line"]


@dataclass(frozen=True)
class Assessment:
    """All of the above as far as it exists, and why where it does not.

    Attributes
    ----------
    limits : Limits
    radial : RadialAssessment or None
    stability : StabilityAssessment or None
    outcome : str
        The verdict of stability, or what prevents it.
    reason : str
        What prevents it, in a sentence; empty where there is a verdict.
    """

    limits: Limits
    radial: RadialAssessment | None
    stability: StabilityAssessment | None
    outcome: Outcome
    reason: str


def assess(hopper: Hopper, friction_angle: float) -> Assessment:
    """Return what is known about a hopper with a wall of friction ``friction_angle`` (radians).

    Raises
    ------
    InvalidParameterError
        If the friction is out of range.
    WallFrictionError
        If the material cannot transmit the wall's friction.
    """
    try:
        radial = assess_radial(hopper, friction_angle)
    except (NoRadialSolutionError, NonPositiveStressError, ConvergenceError) as error:
        return Assessment(assess_limits(hopper), None, None, _OUTCOMES[type(error)], str(error))
    try:
        found = assess_stability(radial.solution)
    except (TangencyError, ConvergenceError, InvalidParameterError) as error:
        return Assessment(radial.limits, radial, None, _OUTCOMES[type(error)], str(error))
    return Assessment(radial.limits, radial, found, found.verdict, "")


_OUTCOMES: dict[type[HopperError], Outcome] = {
    NoRadialSolutionError: "no_radial_solution",
    NonPositiveStressError: "non_positive_stress",
    ConvergenceError: "not_converged",
    TangencyError: "tangent_characteristic",
    # The only one that stability knows is a material it has no equations for.
    InvalidParameterError: "not_formulated",
}


def assess_limits(hopper: Hopper) -> Limits:
    """Return the limits of a hopper's wall friction."""
    mass_flow = _mass_flow(hopper)
    try:
        friction = friction_limit(hopper)
    except (NoRadialSolutionError, ConvergenceError):
        return Limits(None, None, mass_flow, None)
    largest = Quantity(friction.friction_angle, friction.error_estimate + _ROUNDING)
    return Limits(friction, _coefficient(largest), mass_flow, tangency_coefficient(hopper))


def _coefficient(angle: Quantity) -> Quantity:
    """Return mu = tan(phi)."""
    mu = tan(angle.value)
    return Quantity(mu, (1 + mu**2) * angle.error)


def _mass_flow(hopper: Hopper) -> Quantity | None:
    try:
        phi = mass_flow_friction_angle(hopper)
    except InvalidParameterError:
        return None
    # A closed form, but its rounding is magnified near sin(delta) = 1/3.
    rounded = mass_flow_friction_angle(replace(hopper, delta=hopper.delta * (1 + _ROUNDING)))
    return Quantity(phi, abs(rounded - phi) + _ROUNDING)


def tangency_coefficient(hopper: Hopper) -> Quantity | None:
    """Return the mu at which psi reaches pi/4 - delta/2, None where it does not."""
    if hopper.material != MOHR_COULOMB:
        return None
    try:
        phi = tangency_friction(hopper)
        if phi is None:
            return None
        here = solve_radial(hopper, phi)
        before = solve_radial(hopper, phi - _STEP, start=here)
    except HopperError:
        return None
    psi_max = _with_errors(here, lambda solution: np.array(solution.psi_maximum()[1:]))[0]
    residual = abs(psi_max.value - (pi / 4 - hopper.delta / 2)) + psi_max.error
    slope = (psi_max.value - before.psi_maximum()[1]) / _STEP
    return _coefficient(Quantity(phi, residual / slope + _ROUNDING))


def assess_radial(hopper: Hopper, friction_angle: float) -> RadialAssessment:
    """Solve for the physical branch and return it in numbers.

    Raises
    ------
    HopperError
        As :func:`hopper.radial.solve_radial`.
    """
    return describe_radial(solve_radial(hopper, friction_angle))


def describe_radial(solution: RadialSolution) -> RadialAssessment:
    """Return a radial solution of the physical branch in numbers."""
    notes = []
    hopper = solution.hopper
    sigma_axis, sigma_wall, psi_max, theta_psi_max, factor = _with_errors(solution, _numbers)
    psi_wall = hopper.material.wall_angle(hopper.delta, solution.friction_angle)
    velocity = u_wall = solutions = None
    try:
        known = solve_velocity(solution)
        (log_u,) = _with_errors(solution, _log_u_wall)
    except (SingularVelocityError, ConvergenceError) as unknown:
        notes.append(str(unknown))
    else:
        velocity = known
        u_wall = Quantity(known.wall, known.wall * (log_u.error + known.error_estimate))
    limits = assess_limits(hopper)
    if limits.friction is None:
        notes.append("the largest friction with a radial solution is not resolved")
    try:
        solutions = 1 + len(_further_members(solution))
    except (ConvergenceError, NoRadialSolutionError):
        notes.append("the number of radial solutions is unknown: the family is not resolved")
    return RadialAssessment(
        solution,
        velocity,
        sigma_axis=sigma_axis,
        sigma_wall=sigma_wall,
        psi_wall=Quantity(psi_wall, _wall_angle_rounding(solution)),
        psi_max=psi_max,
        theta_psi_max=theta_psi_max,
        u_wall=u_wall,
        flow_factor=factor,
        solutions=solutions,
        limits=limits,
        notes=tuple(notes),
    )


def _further_members(solution: RadialSolution) -> list[Member]:
    """Return the members of the family with the same wall and less stress on the axis."""
    member = solution.member
    found = members_with_wall_angle(solution.hopper, member.psi_wall, start=member)
    return [other for other in found if other.tau > (1 + _SHIFT) * member.tau]


def _numbers(solution: RadialSolution) -> Array:
    theta_psi_max, psi_max = solution.psi_maximum()
    return np.array([
        solution.sigma_axis, solution.sigma_wall, psi_max, theta_psi_max, flow_factor(solution),
    ])  # fmt: skip


def _log_u_wall(solution: RadialSolution) -> Array:
    return solve_velocity(solution).log_u[-1:]


def _with_errors(
    solution: RadialSolution, numbers: Callable[[RadialSolution], Array]
) -> list[Quantity]:
    """Return numbers computed from the fields, with what the fields' error makes of them."""
    values = numbers(solution)
    errors = _propagated(solution, lambda shifted: np.abs(numbers(shifted) - values))
    errors = errors + _ROUNDING * np.abs(values)
    return [Quantity(float(v), float(e)) for v, e in zip(values, errors, strict=True)]


def _propagated(solution: RadialSolution, change: Callable[[RadialSolution], Array]) -> Array:
    """Return the sum of the changes that the error of the fields makes, to first order.

    The family's tangent is among the directions: near a fold psi_w hardly determines the solution,
    so that rounding moves it along the family.
    """
    member = solution.member
    size, tau = member.grid.size, max(1.0, abs(member.tau))
    x = solution.theta / solution.hopper.half_angle
    directions = np.zeros((4, member.u.size))
    directions[0, :size] = x**2
    directions[1, size:-1] = x
    directions[2, -1] = tau
    steepest = max(np.abs(member.tangent[:-1]).max(), abs(member.tangent[-1]) / tau)
    directions[3] = member.tangent / steepest
    rounding = _ROUNDING * size
    errors = np.full(4, solution.error_estimate + rounding)
    rounding += _wall_angle_rounding(solution)
    errors[3] += rounding / max(abs(directions[3, -2]), rounding**0.5)
    shifted = (
        replace(solution, member=replace(member, u=member.u + _SHIFT * direction))
        for direction in directions
    )
    return errors / _SHIFT @ np.array([change(one) for one in shifted])


def _wall_angle_rounding(solution: RadialSolution) -> float:
    """Return the rounding of psi_w (radians), large where the wall law determines it badly."""
    delta, law, psi = solution.hopper.delta, solution.hopper.material, solution.psi_wall
    step = _ROUNDING ** (1 / 3)
    slope = law.friction_angle(delta, psi + step) - law.friction_angle(delta, psi - step)
    slope = max(abs(slope) / (2 * step), _ROUNDING**0.5)
    return _ROUNDING * (1 + solution.friction_angle / slope)


def assess_stability(solution: RadialSolution) -> StabilityAssessment:
    """Return the linear stability of a radial solution in numbers.

    Raises
    ------
    HopperError
        As :func:`hopper.stability.stability`.
    """
    result, mode_errors, abscissa = _abscissa(solution)
    low = result.eigenvalues
    kept, changes = _resolved_modes(solution)
    # What rounding and the fields leave is alike for all modes, relative to their modulus.
    changes = changes + np.abs(kept) * np.max(mode_errors / np.abs(low))
    further = (kept.imag >= 0) & (np.abs(kept) > (1 + _CHANGE) * np.abs(low[-1]))
    return StabilityAssessment(
        result,
        mode_errors,
        abscissa,
        spectrum=np.concatenate([low, kept[further]]),
        spectrum_errors=np.concatenate([mode_errors, changes[further]]),
        transient=_transient(solution, kept, result) if kept.size else None,
    )


def _abscissa(solution: RadialSolution) -> tuple[Stability, Array, Quantity]:
    """Return what decides stability, the errors of its low modes, and the abscissa."""
    result = stability(solution)
    modes = result.eigenvalues

    def followed(shifted: RadialSolution) -> Complex:
        found = upper_eigenvalues(shifted, _SENSITIVITY_SIZE)
        return found[np.abs(modes[:, None] - found).argmin(axis=1)]

    before = followed(solution)
    share = _propagated(solution, lambda shifted: np.abs(followed(shifted) - before))
    errors = result.mode_errors + share
    # The line's own estimate covers the fields already.
    governed_by_mode = result.governed_by == "mode"
    error = float(errors[np.argmax(modes.real)]) if governed_by_mode else result.error_estimate
    return result, errors, Quantity(result.abscissa, error)


def _resolved_modes(solution: RadialSolution) -> tuple[Complex, Array]:
    """Return the modes of physical parity on which two meshes agree, and by how much (absolute)."""
    fine, coarse = mesh_spectrum(solution, _NODES), mesh_spectrum(solution, _COARSE_NODES)
    try:
        found = convergence_filter(fine, coarse, _CHANGE)
    except ConvergenceError:
        return np.empty(0, complex), np.empty(0)
    kept = found.kept & (fine.half == HALVES.index("physical"))
    # Both of a pair or none: the filter's thresholds see them apart by rounding.
    kept &= np.isin(fine.eigenvalues.conj(), fine.eigenvalues[kept])
    modes = fine.eigenvalues[kept]
    return modes, found.change[kept] * np.abs(modes)


def _transient(solution: RadialSolution, kept: Complex, result: Stability) -> Transient:
    fine, coarse = (modal_basis(solution, n, "physical", kept) for n in (_NODES, _COARSE_NODES))
    period = 2 * pi / result.line.spacing

    def on_both(number: Callable[[ModalBasis], float]) -> Quantity:
        value, rounding = number(fine), _ROUNDING * condition_number([fine])
        return Quantity(value, abs(value - number(coarse)) + rounding * value)

    def largest(rate: float) -> Quantity:
        elapsed = _time_of_largest(fine, rate, period)
        return on_both(lambda basis: _scaled_norm(basis, elapsed, rate))

    return Transient(
        modes=kept.size,
        condition=on_both(lambda basis: condition_number([basis])),
        amplification=largest(result.abscissa),
        growth=largest(0.0) if result.stable else None,
    )


def _scaled_norm(basis: ModalBasis, elapsed: float, rate: float) -> float:
    """Return ||exp(-t M)|| exp(-rate elapsed)."""
    return float(propagator_norm([basis], elapsed)) * exp(-rate * elapsed)


def _time_of_largest(basis: ModalBasis, rate: float, period: float) -> float:
    times = np.linspace(0, _TRIPS * period, _TRIPS * _SAMPLES + 1)
    peak = times[np.argmax(propagator_norm([basis], times) * np.exp(-rate * times))]
    around = max(0.0, peak - times[1]), min(peak + times[1], times[-1])
    found = minimize_scalar(
        lambda elapsed: -_scaled_norm(basis, elapsed, rate), bounds=around, method="bounded"
    )
    return float(found.x)


def assess_neutral(geometry: Geometry, half_angle: float, friction_angle: float) -> NeutralPoint:
    """Return the neutral delta of a Mohr-Coulomb hopper; angles in radians.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    NoNeutralPointError
        If no delta separates unstable from stable hoppers at this friction.
    """
    delta = neutral_delta(geometry, half_angle, friction_angle)
    at, beyond = (
        solve_radial(Hopper(geometry, angle, half_angle), friction_angle)
        for angle in (delta, delta + _STEP)
    )
    result, _, abscissa = _abscissa(at)
    slope = (stability(beyond).abscissa - abscissa.value) / _STEP
    error = (abs(abscissa.value) + abscissa.error) / abs(slope)
    return NeutralPoint(Quantity(delta, error), result.governed_by)


def largest_neutral_coefficient(geometry: Geometry, half_angle: float) -> Quantity | None:
    """Return the largest mu that has a neutral delta, None if not even a smooth wall has one."""
    try:
        curve = neutral_curve(geometry, half_angle, _PHI_STEP)
    except NoNeutralPointError:
        return None
    return _coefficient(Quantity(float(curve.friction_angle[-1]), _END_ERROR))
