"""Answers in words."""

from math import degrees, exp

from hopper.assessment.coupled import CoupledStability
from hopper.assessment.march import MarchAssessment
from hopper.assessment.neutral import NeutralAssessment
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper.design.design import Design
from hopper.design.flow_pattern import FlowPattern
from hopper.design.half_angles import Limit
from hopper.uncertainty.designs import RangedDesign
from hopper.uncertainty.ranged import Ranged
from hopper.uncertainty.sampling import Share
from hopper_cli.text import described

_ENDS = {
    "fold": "where a second branch of solutions begins",
    "wall": "where the wall is as rough as the material",
    "interior": "where psi reaches its singular angle inside the hopper",
    "axis": "where the stress on the axis vanishes",
}


def mass_flow_sentence(found: FlowPattern, over: Ranged | None = None) -> str:
    """Return whether there is mass flow, and with how much half angle to spare.

    ``over`` is the answer over a range, of which ``found`` is the middle: then also in which share
    of the range there is mass flow, and how probable it is.
    """
    words = {True: "yes", False: "no", None: "not known"}[found.mass_flow]
    spare = found.spare and f"{abs(degrees(found.spare.value)):.3g} deg"
    if spare is None:
        words += f", {found.reason}"
    elif found.mass_flow:
        words += f", with {spare} of half angle to spare"
    else:
        words += f", the half angle is {spare} too large"
    return f"Mass flow: {words}{_where(found, over) if over else ''}."


def _where(found: FlowPattern, over: Ranged) -> str:
    """Return where in a range there is mass flow."""
    what = "" if found.mass_flow else "mass flow "
    words = f"; {what}in {_extent(over.shares.get('mass_flow'))} the given range"
    if over.probabilities is not None:
        chance = percent(over.probabilities.get("mass_flow"))
        words += f", with a probability of {chance}"
    return words


def _extent(share: Share | None) -> str:
    if share is not None and not share.error:
        return "all of" if share.value else "no part of"
    return f"{percent(share)} of"


def percent(share: Share | None) -> str:
    """Return a share without a fraction, None if it was nowhere seen."""
    if share is None or share.value < 0.01:
        return "less than 1 %"
    return "more than 99 %" if share.value > 0.99 else f"{100 * share.value:.0f} %"


_LIMITS: dict[Limit, str] = {
    "classical": "the classical limit of mass flow",
    "limit": "the largest half angle with a radial solution",
    "velocity": "where radial flow ceases to reach the wall",
    "stability": "where the flow ceases to be stable",
}


def design_range_sentence(found: RangedDesign, margin: float) -> str:
    """Return the same over a range; ``margin`` in degrees."""
    flows = found.numbers.get("half_angles.mass_flow")
    words = found.middle.half_angles.no_mass_flow
    if flows:
        low, high = (f"{degrees(end.value):.4g}" for end in (flows.low, flows.high))
        words = f"up to a half angle of {low} to {high} deg in the given range"
    if found.recommended is None:
        return f"Mass flow: {words}; no half angle is recommended."
    return (
        f"Mass flow: {words}; recommended {degrees(found.recommended.value):.4g} deg, {margin:.3g} "
        "deg below the smallest limit of the whole range."
    )


def design_sentence(found: Design) -> str:
    """Return up to which half angle there is mass flow, and the recommended one."""
    angles = found.half_angles
    flows = (
        f"up to a half angle of {degrees(angles.mass_flow.value):.4g} deg"
        if angles.mass_flow
        else angles.no_mass_flow
    )
    if found.recommended is None or angles.governed_by is None or angles.smallest is None:
        return f"Mass flow: {flows}; no half angle is recommended."
    kept = degrees(angles.smallest.value - found.recommended.value)
    return (
        f"Mass flow: {flows}; recommended {degrees(found.recommended.value):.4g} deg, {kept:.3g} "
        f"deg below {_LIMITS[angles.governed_by]}."
    )


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


def coupled_sentence(found: CoupledStability) -> str:
    """Return the verdict on a von Mises cone in words."""
    known = "axisymmetric disturbances without swirl"
    sentence = f"No verdict: {found.judged.reason}."
    if found.decay_down is not None and found.decay_up is not None:
        down, up = f"{found.decay_down.value:.4g}", f"{found.decay_up.value:.4g}"
        sentence = (
            f"Elliptic, so that nothing can be marched: each end carries half of the conditions. "
            f"A disturbance at the top dies out down the hopper as r^{down}, one at the outlet up "
            f"the hopper as r^-{up}; the flow rate alone is kept, and set by one end."
        )
    elif found.verdict in ("stable", "unstable", "neutral"):
        cause = "a mode" if found.governed_by == "mode" else "the upper strip of high frequency"
        words = {
            "neutral": f"Neutral to {known}: the abscissa is zero within its error.",
            "stable": f"Stable: {known} decay down the hopper, governed by {cause}; that no other "
            "mode grows is tested, not proved.",
            "unstable": f"Unstable: {known} can grow down the hopper, governed by {cause}.",
        }
        if found.abscissa is None:
            words["unstable"] = f"Unstable: {known} can grow, {found.judged.reason}."
        sentence = words[found.verdict]
    if found.judged.slanted:
        sentence += " Data belong on a slanted surface: a characteristic lies in r = const."
    return sentence


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


def march_sentence(found: MarchAssessment, depth: float) -> str:
    """Return how the march ends, and from where on the stress is radial."""
    reached = [
        f"within {percent} % of the radial field from r = {radius.value:.3g} r_top on"
        for percent, radius in ((5, found.settled_5_percent), (1, found.settled_1_percent))
        if radius is not None
    ]
    near = f"The stress is {' and '.join(reached)}" if reached else ""
    if found.kind is None and found.end < depth:
        end = f"The march is not resolved below tau = {found.end:.6g}."
    elif found.kind is None:
        bottom = f"tau = {depth:g} (r = {exp(-depth):.3g} r_top)"
        end = f"No breakdown down to {bottom}."
        near = near or "It is not known to be within 5 % of the radial field for good"
    elif found.kind == "kink":
        end = f"A kink of the stress breaks at a place that is not known, by tau = {found.end:.3g}."
    elif found.breakdown_radius is not None:
        what = "Characteristics cross" if found.kind == "crossing" else "A characteristic turns"
        end = (
            f"{what} at r = {found.breakdown_radius.value:.4g} r_top: the stress is smooth down to "
            "there only, a discontinuity is to be expected below."
        )
    return f"{end} {near}." if near else end
