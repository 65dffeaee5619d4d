"""Linear stability of von Mises cones in numbers: verdict, modes, strips, decay of end effects."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan, isfinite

import numpy as np

from hopper.arguments import Radians, checked
from hopper.arrays import Array, Complex
from hopper.assessment.neutral import Interval, NeutralAssessment, NeutralPoint
from hopper.assessment.propagation import ROUNDING, propagated
from hopper.brief import brief
from hopper.domain.growth import COARSE
from hopper.domain.neutral_points import IntervalEnd
from hopper.errors import HopperError
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.stability.collocation import Parity
from hopper.values import require_angle
from hopper.von_mises.characteristics import TENSION
from hopper.von_mises.characteristics import Kind as Type
from hopper.von_mises.growth import Governor
from hopper.von_mises.modes import ResolvedModes, upper_eigenvalues
from hopper.von_mises.neutral import SCAN, neutral_point
from hopper.von_mises.verdict import Kind, Verdict, flow_limit, judge, judge_solution
from hopper.yield_conditions import VON_MISES

# Half nodes on which eigenvalues are followed under a shift of the fields.
_SENSITIVITY_SIZE = 30


@dataclass(frozen=True)
class CoupledStability:
    """Linear stability of a von Mises cone in numbers; what a verdict does not have is None.

    Attributes
    ----------
    judged : Verdict
    modes : ResolvedModes or None
        But for the flow rate; errors with what the fields leave uncertain.
    abscissa : Quantity or None
        Supremum of Re(lambda) of a hyperbolic flow, the flow rate left out; the error holds what
        modes that are not resolved may add to it. None where nothing bounds that.
    decay_down, decay_up : Quantity or None
        Exponents of r of an elliptic flow: disturbances of the top die out at least like
        r**decay_down, those of the outlet like r**-decay_up.
    """

    judged: Verdict
    modes: ResolvedModes | None = None
    abscissa: Quantity | None = None
    decay_down: Quantity | None = None
    decay_up: Quantity | None = None

    __repr__ = brief("verdict", "type", "abscissa", "decay_down", "decay_up")

    @property
    def verdict(self) -> Kind:
        """One word, as :class:`hopper.von_mises.verdict.Verdict` has it."""
        return self.judged.verdict

    @property
    def type(self) -> Type | None:
        """Type of the equations, None without a radial flow."""
        return None if self.judged.type is None else self.judged.type.kind

    @property
    def strips(self) -> Array | None:
        """Intervals of Re(lambda) of the modes of high frequency, shape (k, 2)."""
        growth = self.judged.growth
        return None if growth is None else growth.strips.intervals

    @property
    def governed_by(self) -> Governor | None:
        """What the abscissa is due to, if it is known: a mode, or the upper strip."""
        growth = self.judged.growth
        return None if growth is None or self.abscissa is None else growth.governed_by


@checked
def assess_coupled(hopper: Hopper, friction_angle: Radians) -> CoupledStability:
    """Return the stability of a von Mises cone with a wall of that friction (radians) in numbers.

    Raises
    ------
    InvalidParameterError
        If the friction is not valid, or the material is not von Mises.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial, yield_condition
    >>> from hopper.assessment.coupled import assess_coupled
    >>> hopper = Hopper("cone", 0.7, 0.2, yield_condition("von-mises"))
    >>> found = assess_coupled(hopper, friction_angle=0.1)
    >>> found.type, found.verdict
    ('hyperbolic', 'stable')
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    try:
        if hopper.delta < TENSION:
            return describe_coupled(solve_radial(hopper, friction_angle))
    except HopperError:
        pass
    return CoupledStability(judge(hopper, friction_angle))


@checked
def describe_coupled(solution: RadialSolution) -> CoupledStability:
    """Return the stability of a radial flow in numbers, as :func:`assess_coupled`.

    Raises
    ------
    SingularVelocityError
        If psi reaches pi/4.
    """
    judged = judge_solution(solution)
    if judged.modes is None:
        return CoupledStability(judged)
    modes = _with_fields(solution, judged.modes)
    share = modes.errors - judged.modes.errors
    value = judged.abscissa
    if isfinite(value):
        error = judged.error_estimate + _share_of(value, modes, share)
        return CoupledStability(judged, modes, Quantity(value, error))
    if judged.end_effects is None:
        return CoupledStability(judged, modes)
    ends = judged.end_effects
    down, up = (
        Quantity(rate, ends.error_estimate + _share_of(sign * rate, modes, share))
        for sign, rate in ((-1, ends.decay_down), (1, ends.decay_up))
    )
    return CoupledStability(judged, modes, decay_down=down, decay_up=up)


def _share_of(real: float, modes: ResolvedModes, share: Array) -> float:
    """Return what the fields leave in the mode of that real part; of a strip, in the modes."""
    distance = np.abs(modes.eigenvalues.real - real)
    return float(share[distance.argmin()])


def _with_fields(solution: RadialSolution, found: ResolvedModes) -> ResolvedModes:
    """Return modes with the errors that the fields leave in them added."""
    modes = found.eigenvalues

    def followed(shifted: RadialSolution) -> Complex:
        near = upper_eigenvalues(shifted, max(_SENSITIVITY_SIZE, found.size))
        return near[np.abs(modes[:, None] - near).argmin(axis=1)]

    before = followed(solution)
    share = propagated(solution, lambda shifted: np.abs(followed(shifted) - before))
    return replace(found, errors=found.errors + share)


@checked
def assess_coupled_neutral(half_angle: Radians, friction_angle: Radians) -> NeutralAssessment:
    """Return what is stable of all von Mises cones with one wall; angles in radians.

    Delta is scanned over hyperbolic flows, 35.26 to 60 deg; ends of intervals are neutral points,
    the border of tension, or where flows end or are no longer resolved.

    Raises
    ------
    InvalidParameterError
        If an angle is out of range.
    """
    require_angle("half_angle", half_angle)
    require_angle("friction_angle", friction_angle, zero_allowed=True)

    def verdict(delta: float) -> Kind:
        return judge(Hopper("cone", delta, half_angle, VON_MISES), friction_angle).verdict

    deltas = [*SCAN, TENSION]
    verdicts = [verdict(delta) for delta in deltas]
    points: list[NeutralPoint] = []
    intervals: list[Interval] = []
    lower: tuple[Quantity, IntervalEnd] | None = None
    for (one, before), (two, after) in pairwise(zip(deltas, verdicts, strict=True)):
        if (before == "stable") is (after == "stable"):
            continue
        wall = half_angle, friction_angle
        delta, kind, point = _end(wall, (one, two), (before, after), verdict)
        points += [point] if point else []
        if after == "stable":
            lower = delta, kind
        elif lower:
            intervals.append(Interval(lower[0], delta, lower[1], kind))
    return NeutralAssessment(tuple(points), tuple(intervals))


def _end(
    wall: tuple[float, float],
    bracket: tuple[float, float],
    verdicts: tuple[Kind, Kind],
    verdict: Callable[[float], Kind],
) -> tuple[Quantity, IntervalEnd, NeutralPoint | None]:
    """Return the end of a stable interval between two deltas, and the neutral point there."""
    inside, outside = bracket if verdicts[0] == "stable" else bracket[::-1]
    reason = next(one for one in verdicts if one != "stable")
    if reason == "tension":
        return Quantity(TENSION, ROUNDING), "tension", None
    if reason in ("unstable", "neutral"):
        found = neutral_point(*wall, guess=sum(bracket) / 2)
        if found and bracket[0] < found.delta < bracket[1]:
            delta = Quantity(found.delta, found.error_estimate)
            parity: Parity | None = None if found.governed_by == "strip" else "symmetric"
            return delta, "neutral", NeutralPoint(delta, found.governed_by, parity)
    while abs(inside - outside) > COARSE:
        middle = (inside + outside) / 2
        found_there = verdict(middle)
        if found_there == "stable":
            inside = middle
        else:
            outside, reason = middle, found_there
    label: IntervalEnd = "not_converged"
    if reason == "no_radial_solution":
        hopper = Hopper("cone", outside, wall[0], VON_MISES)
        label = "interior" if flow_limit(hopper) < atan(hopper.s) else "wall"
    return Quantity(inside, COARSE), label, None
