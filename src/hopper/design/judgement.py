"""The short answer about one hopper: mass flow, stability, flow factor, or why there is none."""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import Radians, checked
from hopper.assessment.propagation import with_errors
from hopper.brief import brief
from hopper.design.flow_pattern import FlowPattern, flow_pattern
from hopper.design.material import Material
from hopper.errors import HopperError
from hopper.quantity import Quantity
from hopper.radial.flow_factor import flow_factor
from hopper.stability.modes import Disturbances, LinearStability, linear_stability


@dataclass(frozen=True)
class Judgement:
    """What is known in short; each part is None where it does not exist.

    Attributes
    ----------
    pattern : FlowPattern or None
    flow_factor : Quantity or None
    stability : LinearStability or None
    reason : str
        Why a part does not exist; empty where all do.
    """

    pattern: FlowPattern | None
    flow_factor: Quantity | None
    stability: LinearStability | None
    reason: str

    __repr__ = brief("pattern.mass_flow", "flow_factor", "stability.verdict", "reason")


@checked
def judge_hopper(
    material: Material, half_angle: Radians, disturbances: Disturbances | None = None
) -> Judgement:
    """Return the short answer about a hopper of half angle ``half_angle`` (radians).

    What has no answer says so in ``reason``: nothing is raised but for arguments that are wrong.
    ``disturbances`` as in :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range, or asymmetric disturbances of a cone are asked for.

    Examples
    --------
    >>> from hopper.design.judgement import judge_hopper
    >>> from hopper.design.material import Material
    >>> found = judge_hopper(Material("cone", delta=0.7, friction_angle=0.28), half_angle=0.35)
    >>> found.pattern.mass_flow, found.stability.verdict, round(found.flow_factor.value, 3)
    (True, 'stable', 1.467)
    """
    pattern = factor = stability = None
    material.hopper(half_angle)
    try:
        pattern = flow_pattern(material, half_angle)
        solution = material.solution(half_angle)
        (factor,) = with_errors(solution, lambda one: np.array([flow_factor(one)]))
        stability = linear_stability(solution, disturbances)
    except HopperError as error:
        return Judgement(pattern, factor, stability, str(error))
    return Judgement(pattern, factor, stability, "")
