"""What is known at a point of a box: fields, verdicts and numbers, each looked up once."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from math import nan, pi
from typing import Any, TypeVar

import numpy as np

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.design.flow_pattern import FlowPattern, flow_pattern
from hopper.design.half_angles import flow_limit
from hopper.errors import ConvergenceError, NoLimitError, WallFrictionError
from hopper.radial.collocation import Member, largest_psi
from hopper.radial.mass_flow import LEAST_DELTA
from hopper.radial.members import physical_member
from hopper.radial.solution import RadialSolution
from hopper.stability.modes import OTHERS, Disturbances, LinearStability, linear_stability
from hopper.uncertainty.box import Box
from hopper.uncertainty.friction_limits import FrictionLimits

_Found = TypeVar("_Found")
# Relative error of the governing mode.
_TOLERANCE = 1e-9


@dataclass(frozen=True)
class BoxedHoppers:
    """The hoppers of a box; what was looked up is kept.

    Parameters
    ----------
    box : Box
    disturbances : "symmetric" or "any", optional
        As in :func:`hopper.stability.modes.linear_stability`.
    """

    box: Box
    disturbances: Disturbances | None = None
    _known: dict[tuple[str, bytes], Any] = field(default_factory=dict, repr=False)
    _last: list[Member] = field(default_factory=list, repr=False)
    _limits: list[FrictionLimits] = field(default_factory=list, repr=False)

    __repr__ = brief("box.geometry")

    @cached_property
    def slips(self) -> bool:
        """Whether mass flow is slip along the wall, as in Mohr-Coulomb cones."""
        return self.box.hopper(self.box.middle)[0].slips

    @property
    def closed(self) -> bool:
        """Whether the limit of mass flow has a closed form all over the box."""
        return self.slips and self.box.delta.low >= LEAST_DELTA

    @checked
    def solved(self, point: RealRow) -> RadialSolution | str:
        """Return the radial solution at a point, shape (d,), or in a word why there is none."""
        return self._once("solved", point, self._solve)

    @checked
    def stability(self, point: RealRow) -> LinearStability | str:
        """Return what decides the stability at a point, or in a word why there is nothing."""
        return self._once("stability", point, self._judge)

    @checked
    def mass_flow(self, point: RealRow) -> bool | None:
        """Return whether there is mass flow at a point, None where that is not known.

        As :func:`hopper.design.flow_pattern.flow_pattern`, without its search for the limit where
        the fields tell: psi below pi/4 is a half angle below the one where it is reached.
        """
        solution = "" if self.slips else self.solved(point)
        if isinstance(solution, RadialSolution):
            return largest_psi(solution.member) < pi / 4
        if solution == "no_radial_solution":
            return False
        try:
            return self.pattern(point).mass_flow
        except WallFrictionError:
            return False

    @checked
    def radial_labels(self, point: RealRow) -> list[str]:
        """Return in words what holds at a point: of mass flow, radial solution and velocity."""
        solution = self.solved(point)
        if not isinstance(solution, RadialSolution):
            return [solution, *self.flow_labels(point)]
        moves = largest_psi(solution.member) < pi / 4
        return ["radial_solution", *["velocity"] * moves, *self.flow_labels(point)]

    @checked
    def stability_labels(self, point: RealRow) -> list[str]:
        """Return in words what holds at a point: of mass flow, and the verdict of stability."""
        found = self.stability(point)
        return [found if isinstance(found, str) else found.verdict, *self.flow_labels(point)]

    @checked
    def half_angle_to_spare(self, point: RealRow) -> float:
        """Return the half angle (radians) up to the limit of mass flow.

        NaN without a limit in closed form: others are looked for in the middle of a box only.
        """
        material, half_angle = self.box.hopper(point)
        try:
            return flow_limit(material).value - half_angle if self.slips else nan
        except (NoLimitError, WallFrictionError):
            return nan

    @checked
    def psi_maximum(self, point: RealRow) -> tuple[float, float]:
        """Return where psi is largest, and psi there (radians); NaN without a solution."""

        def found(at: Array) -> tuple[float, float]:
            solution = self.solved(at)
            return (nan, nan) if isinstance(solution, str) else solution.psi_maximum()

        return self._once("psi_max", point, found)

    @checked
    def pattern(self, point: RealRow) -> FlowPattern:
        """Return the flow pattern at a point."""
        return flow_pattern(*self.box.hopper(point))

    @checked
    def border(self, rest: RealRow, margins: float = 1.0) -> Array | None:
        """Return a point at the border of existence; None without one, or if none was met.

        As :meth:`hopper.uncertainty.friction_limits.FrictionLimits.border`.
        """
        return self._limits[0].border(rest, margins) if self._limits else None

    @checked
    def flow_labels(self, point: RealRow) -> list[str]:
        """Return whether there is mass flow at a point, in words; none where there is not."""
        flows = self.mass_flow(point)
        return ["mass_flow_not_known"] if flows is None else ["mass_flow"] * flows

    def _once(self, what: str, point: RealRow, find: Callable[[Array], _Found]) -> _Found:
        at = np.asarray(point, dtype=float)
        key = what, at.tobytes()
        if key not in self._known:
            self._known[key] = find(at)
        return self._known[key]

    def _solve(self, point: Array) -> RadialSolution | str:
        if self._limits and self._limits[0].exclude(point):
            return "no_radial_solution"
        material, half_angle = self.box.hopper(point)
        hopper = material.hopper(half_angle)
        start = self._last[0] if self._last else None
        reached = self._limits[0].thickest(point) if self._limits else 0.0
        try:
            member = physical_member(hopper, material.friction_angle, start, reached)
        except WallFrictionError:
            return "no_wall_angle"
        except ConvergenceError:
            return "not_converged"
        if member is None:
            self._limits[:] = self._limits or [FrictionLimits(self.box)]
            return "no_radial_solution"
        if member.tau <= 0:
            return "non_positive_stress"
        self._last[:] = [member]
        return RadialSolution(hopper, material.friction_angle, "physical", member)

    def _judge(self, point: Array) -> LinearStability | str:
        solution = self.solved(point)
        if isinstance(solution, str):
            return solution
        try:
            return linear_stability(
                solution, self.disturbances, tolerance=_TOLERANCE, others=OTHERS
            )
        except ConvergenceError:
            return "not_converged"
