"""The spectral abscissa of hoppers that differ in internal friction.

They are solved from neighbour to neighbour in delta. Near the fold of the family phi is a bad
parameter, as Re(lambda) goes with the square root of the distance: there tau = 1 / sigma_0 is one.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from hopper.arguments import checked
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.problem import Geometry, Hopper, as_geometry
from hopper.radial.collocation import Closure, Member
from hopper.radial.friction_limit import fold_near
from hopper.radial.members import physical_member
from hopper.radial.refinement import solve
from hopper.radial.solution import solution_of
from hopper.stability.asymptotic_line import asymptotic_line
from hopper.stability.low_modes import upper_eigenvalues
from hopper.stability.modes import (
    OTHERS,
    Disturbances,
    LinearStability,
    linear_stability,
    parities_among,
)
from hopper.values import require_angle

# Half-grid points and low modes for what else is neutral at a fold.
_FOLD_SIZE, _FOLD_MODES = 54, 5
# Root finding, in radians: well below 1e-6 degrees. Relative error of the mode that governs there.
ROOT_TOLERANCE, _TOLERANCE = 1e-12, 1e-11
# Where no equation holds at an edge, only that modes cease to be resolved.
COARSE = 1e-4
# A secant's last step: the next one would be far smaller.
_LAST_STEP = 1e-9
_SECANT_STEPS = 12
_PROBE = 1e-6

Missing = Literal["no_radial_solution", "no_wall_angle", "non_positive_stress", "not_converged"]


@dataclass
class Hoppers:
    """Hoppers of one shape and half angle (radians); the last member solved starts the next.

    Raises
    ------
    InvalidParameterError
        If the half angle is out of range, or asymmetric disturbances of a cone are asked for.
    """

    geometry: Geometry
    half_angle: float
    disturbances: Disturbances | None = None
    last: Member | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        require_angle("half_angle", self.half_angle)
        parities_among(self.disturbances, as_geometry(self.geometry))

    @checked
    def hopper(self, delta: float) -> Hopper:
        """Return the hopper with internal friction delta (radians)."""
        return Hopper(self.geometry, delta, self.half_angle)

    @checked
    def at_wall(self, delta: float, friction_angle: float) -> LinearStability | Missing:
        """Return the stability at a wall friction, or what is missing; angles in radians."""
        hopper = self.hopper(delta)
        if friction_angle > hopper.material.largest_friction_angle(delta):
            return "no_wall_angle"
        try:
            member = physical_member(hopper, friction_angle, self.last)
            return "no_radial_solution" if member is None else self._judged(member)
        except ConvergenceError:
            return "not_converged"

    @checked
    def with_tau(self, delta: float, tau: float) -> LinearStability | Missing:
        """Return the stability of the member with the given tau, close to the last one."""
        try:
            member = solve(self.hopper(delta), Closure("tau", tau), self.last)
            return "no_radial_solution" if member is None else self._judged(member)
        except ConvergenceError:
            return "not_converged"

    @checked
    def at_fold(self, delta: float) -> float:
        """Return the spectral abscissa at the fold, near the last member, without the zero mode.

        There a real mode passes 0. Near a corner of the stable domain it is one of two that are
        small: the other one is their sum, whose rounding is not that of a double root.

        Raises
        ------
        ConvergenceError
            If the fold or the modes are not resolved.
        """
        member = fold_near(self.hopper(delta), self.last) if self.last else None
        if member is None:
            raise ConvergenceError(f"no fold near delta = {np.degrees(delta):.6g} deg")
        self.last = member
        solution = solution_of(member)
        first, second, *others = upper_eigenvalues(solution, _FOLD_SIZE)[:_FOLD_MODES]
        if first.imag:
            others += [2 * first, second]
        else:
            others += [second if second.imag else first + second]
        line = asymptotic_line(solution).abscissa
        return max(line, *(float(mode.real) for mode in others))

    def _judged(self, member: Member) -> LinearStability | Missing:
        self.last = member
        if member.tau <= 0:
            return "non_positive_stress"
        return linear_stability(
            solution_of(member), self.disturbances, tolerance=_TOLERANCE, others=OTHERS
        )


@dataclass(frozen=True)
class Root:
    """Where the spectral abscissa vanishes along a line, and its slope there."""

    at: float
    slope: float


@checked
def root_near(
    at: Callable[[float], object], guess: float, slope: float | None = None
) -> Root | None:
    """Return where the abscissa vanishes near a guess, None if nowhere.

    ``at`` returns a LinearStability for a place on a line, such as delta (radians), or something
    else where there is none; ``slope`` is that of a neighbouring root.
    """

    def growth(place: float) -> float:
        result = at(place)
        if isinstance(result, LinearStability):
            return result.abscissa
        raise ConvergenceError(str(result))

    return root(growth, guess, slope)


@checked
def root(
    growth: Callable[[float], float],
    guess: float,
    slope: float | None = None,
    tolerance: float = _LAST_STEP,
) -> Root | None:
    """Converge to a zero by the secant method, or give up.

    The first step is by the slope, or failing that from a second point on either side.
    """
    for side in (slope, -_PROBE, _PROBE):
        if side is None:
            continue
        try:
            before, at_before = guess, growth(guess)
            here = guess - at_before / side if side is slope else guess + side
            for _ in range(_SECANT_STEPS):
                at_here = growth(here)
                slant = (at_here - at_before) / (here - before)
                following = here - at_here / slant
                if abs(following - here) < tolerance:
                    return Root(following, slant)
                before, at_before, here = here, at_here, following
        except (ConvergenceError, InvalidParameterError, ZeroDivisionError):
            continue
    return None
