"""Answers in words."""

from math import degrees

from hopper.assessment.neutral import NeutralAssessment
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper_cli.text import described

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


def stability_sentence(geometry: str, found: StabilityAssessment) -> str:
    """Return the verdict in words, and which disturbances it is about."""
    known = (
        "axisymmetric disturbances without swirl"
        if geometry == "cone"
        else "disturbances, symmetric or not"
        if "asymmetric" in found.modes
        else "symmetric disturbances"
    )
    cause = described(found.result.governed_by, found.result.parity)
    words = {
        "neutral": f"Neutral to {known}: the abscissa is zero within its error.",
        "stable": f"Stable: {known} decay down the hopper, governed by {cause}.",
        "stable_symmetric_only": "Stable to symmetric disturbances only: asymmetric ones grow down "
        f"the hopper, governed by {cause}.",
        "unstable": f"Unstable: {known} can grow down the hopper, governed by {cause}.",
    }
    return words[found.verdict]


def neutral_sentence(geometry: str, found: NeutralAssessment) -> str:
    """Return the answer in words."""
    to = " to axisymmetric disturbances without swirl" if geometry == "cone" else ""
    if not found.intervals:
        return f"No delta is stable{to} at this wall friction."
    intervals = [
        f"{degrees(one.lower.value):.6g} to {degrees(one.upper.value):.6g} deg"
        for one in found.intervals
    ]
    return f"Stable{to} where delta is from {' and from '.join(intervals)}."
