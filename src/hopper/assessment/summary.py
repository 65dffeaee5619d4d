"""What is known about one hopper: radial solution, limits of wall friction, stability.

Every number carries an absolute error.
"""

from dataclasses import dataclass
from typing import Literal, get_args

from hopper.arguments import Radians, checked
from hopper.assessment.limits import Limits, assess_limits
from hopper.assessment.radial import RadialAssessment, assess_radial
from hopper.assessment.stability import StabilityAssessment, assess_stability
from hopper.brief import brief
from hopper.errors import (
    ConvergenceError,
    HopperError,
    InvalidParameterError,
    NonPositiveStressError,
    NoRadialSolutionError,
)
from hopper.problem import Hopper
from hopper.stability.modes import Verdict

Outcome = Literal[
    Verdict, "no_radial_solution", "non_positive_stress", "not_converged", "not_formulated"
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

    __repr__ = brief("outcome", "stability.abscissa", "limits.coefficient")


@checked
def assess(hopper: Hopper, friction_angle: Radians) -> Assessment:
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
    except (ConvergenceError, InvalidParameterError) as error:
        return Assessment(radial.limits, radial, None, _OUTCOMES[type(error)], str(error))
    return Assessment(radial.limits, radial, found, found.verdict, "")


_OUTCOMES: dict[type[HopperError], Outcome] = {
    NoRadialSolutionError: "no_radial_solution",
    NonPositiveStressError: "non_positive_stress",
    ConvergenceError: "not_converged",
    # The only one that stability knows is a material it has no equations for.
    InvalidParameterError: "not_formulated",
}
