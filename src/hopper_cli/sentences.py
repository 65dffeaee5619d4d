"""Answers in words."""

from math import degrees

from hopper.assessment.neutral import NeutralPoint
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment

_ENDS = {
    "fold": "where a second branch of solutions begins",
    "wall": "where the wall is as rough as the material",
    "interior": "where psi reaches its singular angle inside the hopper",
    "axis": "where the stress on the axis vanishes",
}


def radial_sentence(radial: RadialAssessment) -> str:
    """Return the answer in words."""
    limits, sentence = radial.limits, "A radial solution exists"
    if limits.friction is not None and limits.coefficient is not None:
        sentence += f" up to mu = {limits.coefficient.value:.6g}, {_ENDS[limits.friction.end]}"
    if limits.mass_flow is not None:
        flows = radial.solution.friction_angle <= limits.mass_flow.value
        limit = f"the mass-flow limit, phi = {degrees(limits.mass_flow.value):.6g} deg"
        sentence += f"; the wall is {'within' if flows else 'beyond'} {limit}"
    return f"{sentence}."


def stability_sentence(found: StabilityAssessment) -> str:
    """Return the verdict in words."""
    if found.verdict == "neutral":
        return "Neutral: the abscissa is zero within its error."
    change = "decay" if found.verdict == "stable" else "grow"
    cause = {"mode": "a low mode", "line": "the asymptotic line"}[found.result.governed_by]
    verdict = found.verdict.capitalize()
    return f"{verdict}: perturbations {change} down the hopper, governed by {cause}."


def neutral_sentence(found: NeutralPoint) -> str:
    """Return the answer in words."""
    delta = f"{degrees(found.delta.value):.6g} deg"
    return f"Stable above delta = {delta}, unstable just below."
