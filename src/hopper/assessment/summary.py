"""What is known about one hopper: radial solution, limits of wall friction, stability.

Every number carries an absolute error.
"""

from dataclasses import dataclass
from typing import Literal, get_args

from hopper.arguments import Radians, checked
from hopper.assessment.coupled import CoupledStability, assess_coupled
from hopper.assessment.limits import Limits, assess_limits
from hopper.assessment.radial import RadialAssessment, assess_radial
from hopper.assessment.stability import StabilityAssessment, assess_stability
from hopper.brief import brief
from hopper.errors import (
    ConvergenceError,
    HopperError,
    NonPositiveStressError,
    NoRadialSolutionError,
)
from hopper.problem import Hopper
from hopper.stability.modes import Verdict
from hopper.yield_conditions import VON_MISES

Outcome = Literal[
    Verdict,
    "saint_venant",
    "mixed",
    "tension",
    "no_radial_solution",
    "non_positive_stress",
    "not_converged",
]
OUTCOMES: tuple[Outcome, ...] = get_args(Outcome)


@dataclass(frozen=True)
class Assessment:
    """All parts as far as they exist, and why where they do not.

    Attributes
    ----------
    limits : Limits
    radial : RadialAssessment or None
    stability : StabilityAssessment or None
        Of Mohr-Coulomb materials.
    coupled : CoupledStability or None
        Of von Mises materials.
    outcome : str
        The verdict of stability, or what prevents it.
    reason : str
        What prevents it, in a sentence; empty where there is a verdict.
    """

    limits: Limits
    radial: RadialAssessment | None
    stability: StabilityAssessment | None
    coupled: CoupledStability | None
    outcome: Outcome
    reason: str

    __repr__ = brief("outcome", "stability.abscissa", "coupled.abscissa", "limits.coefficient")


@checked
def assess(hopper: Hopper, friction_angle: Radians) -> Assessment:
    """Return what is known about a hopper with a wall of friction ``friction_angle`` (radians).

    Raises
    ------
    InvalidParameterError
        If the friction is out of range.
    WallFrictionError
        If the material cannot transmit the wall's friction.

    Examples
    --------
    >>> from hopper import Hopper, assess
    >>> assess(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3).outcome
    'stable'
    """
    try:
        radial = assess_radial(hopper, friction_angle)
    except (NoRadialSolutionError, NonPositiveStressError, ConvergenceError) as error:
        limits = assess_limits(hopper)
        return Assessment(limits, None, None, None, _OUTCOMES[type(error)], str(error))
    if hopper.material == VON_MISES:
        coupled = assess_coupled(hopper, friction_angle)
        reason = "" if coupled.abscissa or coupled.decay_down else coupled.judged.reason
        return Assessment(radial.limits, radial, None, coupled, coupled.verdict, reason)
    try:
        found = assess_stability(radial.solution)
    except ConvergenceError as error:
        return Assessment(radial.limits, radial, None, None, "not_converged", str(error))
    return Assessment(radial.limits, radial, found, None, found.verdict, "")


_OUTCOMES: dict[type[HopperError], Outcome] = {
    NoRadialSolutionError: "no_radial_solution",
    NonPositiveStressError: "non_positive_stress",
    ConvergenceError: "not_converged",
}
