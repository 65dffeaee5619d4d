"""One mode, or the upper strip, followed from cone to cone.

A mode is followed on one mesh by inverse iteration, which costs a tenth of all its eigenvalues. A
mesh says nothing of what else it does not resolve: the supremum of Re(lambda) needs two meshes and
the strips, as :mod:`hopper.von_mises.growth` finds it.
"""

from dataclasses import dataclass
from math import copysign, nan

import numpy as np
import scipy

from hopper.arguments import Radians, Row, checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.members import physical_member
from hopper.radial.solution import RadialSolution, solution_of
from hopper.values import require_angle
from hopper.von_mises.characteristics import AXIS_HYPERBOLIC, TENSION
from hopper.von_mises.growth import Growth
from hopper.von_mises.high_frequency import high_frequency
from hopper.von_mises.modes import SIZES, matrix_on, rounding_on
from hopper.von_mises.strips import strips
from hopper.yield_conditions import VON_MISES

# Inverse iterations with one shift, shifts, and the relative change of an eigenvalue at the end.
_ITERATIONS, _SHIFTS, _SAME = 12, 3, 1e-14
# The shift is off its eigenvalue by this part, as the matrix is singular there.
_OFF = 1e-6
# Relative errors of a mode: resolved, and fine enough to look no further.
_RESOLVED, _FINE = 1e-6, 1e-11
# How far an eigenvalue may be from where its vectors expect it, over the half angle: a tenth of
# the distance between modes.
_JUMP = 0.25
# Radians: distance from the borders of hyperbolic flow, steps in delta, and of the last one.
MARGIN = 1e-5
_FIRST_STEP, _LARGEST_STEP, _LAST_STEP = 1e-5, 0.02, 1e-11
# A difference of fewer radians is rounding; the part of an error that a root need not reach.
_LEAST_DIFFERENCE, _PART = 1e-7, 0.1
# To which a corner of the neutral curve is found.
_CORNER = 1e-8
_STEPS = 30


@dataclass(frozen=True)
class Followed:
    """A mode, or the upper strip, at one radial flow.

    Attributes
    ----------
    flow : RadialSolution
    value : complex
        lambda of the mode, the strip's upper edge with Im NaN.
    error : float
        Absolute: for a mode the change from the mesh before, and rounding.
    size : int
        Half nodes; 0 for the strip.
    vectors : complex array, shape (2, k)
        Right and left eigenvector; empty for the strip.
    """

    flow: RadialSolution
    value: complex
    error: float
    size: int
    vectors: Complex

    __repr__ = brief("value", "error", "size")

    @checked
    def at(self, flow: RadialSolution) -> "Followed":
        """Return the same at the flow of a cone close to this one, with the error of this one.

        Raises
        ------
        ConvergenceError
            If the mode is lost, or the strips are not resolved.
        """
        if not self.size:
            return upper_strip(flow)
        right, left = self.vectors
        near = _quotient(matrix_on(flow, self.size), right, left)
        value, vectors = _eigenvalue(flow, self.size, near, self.vectors)
        if not abs(value - near) < _JUMP / flow.hopper.half_angle:
            raise ConvergenceError(f"mode lost near lambda = {near:.6g}; change delta")
        return Followed(flow, value, self.error, self.size, vectors)

    @checked
    def resolved(self) -> "Followed":
        """Return the same on a mesh fine enough for it here, with its error here.

        Raises
        ------
        ConvergenceError
            If no mesh resolves it.
        """
        return _mode_near(self.flow, self.value, self.size) if self.size else self


@checked
def upper_strip(flow: RadialSolution) -> Followed:
    """Return the upper strip of a hyperbolic flow.

    Raises
    ------
    ConvergenceError
        If the strips are not resolved.
    """
    lie = strips(high_frequency(flow))
    empty = np.empty((2, 0), dtype=np.complex128)
    return Followed(flow, complex(lie.upper_edge, nan), lie.error_estimate, 0, empty)


def _mode_near(flow: RadialSolution, near: complex, first: int) -> Followed:
    """Return the mode next to ``near`` on the first mesh of ``SIZES`` that is fine enough for it.

    Errors stop falling where they are rounding. ``first`` is the size to begin with.
    """
    best, before = None, None
    for size in SIZES[max(SIZES.index(first) - 1, 0) :]:
        value, vectors = _eigenvalue(flow, size, near, None)
        if before is not None:
            change, rounding = abs(value - before), rounding_on(flow, size) * max(1, abs(value))
            found = Followed(flow, value, change + rounding, size, vectors)
            if best is None or found.error < best.error:
                best = found
            if best.error < _RESOLVED * abs(value) and (
                best is not found or change < max(rounding, _FINE * abs(value))
            ):
                return best
        before = value
    if best is None or best.error > _RESOLVED * abs(best.value):
        raise ConvergenceError(f"no mode resolved near lambda = {near:.6g}; change delta")
    return best


@checked
def governing(found: Growth, flow: RadialSolution) -> Followed:
    """Return what governs the supremum of Re(lambda) of a flow.

    Raises
    ------
    ConvergenceError
        If no mesh resolves it.
    """
    if found.governed_by == "strip":
        return upper_strip(flow)
    before = SIZES[max(SIZES.index(found.modes.size) - 3, 1)]
    return _mode_near(flow, complex(found.abscissa, found.frequency), before)


def _eigenvalue(
    flow: RadialSolution, size: int, near: complex, vectors: Complex | None
) -> tuple[complex, Complex]:
    """Return the eigenvalue next to a guess, with its vectors, by two-sided inverse iteration."""
    matrix = matrix_on(flow, size)
    unit = np.eye(len(matrix))
    right, left = np.ones((2, len(matrix)), dtype=complex) if vectors is None else vectors
    value = near
    for _ in range(_SHIFTS):
        factors = scipy.linalg.lu_factor(matrix - value * (1 + _OFF) * unit, check_finite=False)
        for _ in range(_ITERATIONS):
            right = _unit(scipy.linalg.lu_solve(factors, right, check_finite=False))
            left = _unit(scipy.linalg.lu_solve(factors, left, trans=2, check_finite=False))
            last, value = value, _quotient(matrix, right, left)
            if abs(value - last) < _SAME * abs(value):
                return value, np.array([right, left])
    if not abs(value - last) < _FINE * abs(value):
        raise ConvergenceError(f"mode lost near lambda = {near:.6g}; change delta")
    return value, np.array([right, left])


def _quotient(matrix: Array, right: Complex, left: Complex) -> complex:
    """Return Rayleigh's quotient, to first order an eigenvalue where vectors are another's."""
    return complex(left.conj() @ (matrix @ right) / (left.conj() @ right))


def _unit(vector: Array | Complex) -> Complex:
    scaled: Complex = vector / np.linalg.norm(vector)
    return scaled


@checked
def flow_at(
    half_angle: Radians, friction_angle: Radians, delta: Radians, start: RadialSolution
) -> RadialSolution:
    """Return the radial flow of a von Mises cone from that of one close to it.

    Raises
    ------
    ConvergenceError
        If there is none, it is not resolved, or not hyperbolic on the axis.
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    hopper = Hopper("cone", delta, half_angle, VON_MISES)
    if not AXIS_HYPERBOLIC + MARGIN < delta < TENSION - MARGIN:
        raise ConvergenceError(
            f"delta = {np.degrees(delta):.6g} deg leaves hyperbolic flows; change the wall friction"
        )
    member = physical_member(hopper, friction_angle, start.member)
    if member is None or member.tau <= 0:
        raise ConvergenceError(f"no radial solution beside {start!r}")
    return solution_of(member)


@checked
def neutral_from(
    start: Followed, friction_angle: Radians, delta: Radians, slope: float | None = None
) -> tuple[Followed, float, float]:
    """Return the mode or strip where its Re(lambda) = 0, its slope over delta, and the last step.

    Parameters
    ----------
    start : Followed
        Of a cone close by.
    friction_angle, delta : float
        phi, and a guess of the neutral delta, radians.
    slope : float, optional
        A guess of d Re(lambda) / d delta.

    Raises
    ------
    ConvergenceError
        If there is no such delta close by, or the mode is lost.
    HopperError
        As :func:`flow_at`.
    """
    require_angle("friction_angle", friction_angle, zero_allowed=True)
    require_angle("delta", delta)
    half_angle = start.flow.hopper.half_angle
    here = start.at(flow_at(half_angle, friction_angle, delta, start.flow))
    step = -here.value.real / slope if slope else _FIRST_STEP
    for _ in range(_STEPS):
        step = copysign(min(abs(step), _LARGEST_STEP), step)
        if slope and (abs(step) < _LAST_STEP or abs(here.value.real) < _PART * here.error):
            return here, slope, abs(step)
        delta += step
        there = here.at(flow_at(half_angle, friction_angle, delta, here.flow))
        if abs(step) > _LEAST_DIFFERENCE or not slope:
            slope = (there.value.real - here.value.real) / step
        here = there
        step = -here.value.real / slope if slope else _LARGEST_STEP
    raise ConvergenceError(
        f"no neutral delta of the mode near lambda = {start.value:.6g}; change the wall friction"
    )


@checked
def both_neutral(
    one: Followed, other: Followed, place: Row, jacobian: Array
) -> tuple[Followed, Followed]:
    """Return two modes, or one and the strip, where both are neutral, by Broyden's iteration.

    Parameters
    ----------
    one : Followed
        Of a cone close by.
    other : Followed
        Of another one.
    place : array, shape (2,)
        A guess of delta and phi, radians.
    jacobian : array, shape (2, 2)
        A guess of the slopes of Re(lambda) of both over delta and phi.

    Raises
    ------
    ConvergenceError
        If there is no such place close by, or a mode is lost.
    HopperError
        As :func:`flow_at`.
    """
    half_angle, flow, slopes = one.flow.hopper.half_angle, one.flow, jacobian.copy()
    step = np.zeros(2)
    for iteration in range(_STEPS):
        flow = flow_at(half_angle, float(place[1]), float(place[0]), flow)
        one, other = one.at(flow), other.at(flow)
        values = np.array([one.value.real, other.value.real])
        if iteration:
            slopes += np.outer(values, step) / (step @ step)
        step = -np.linalg.solve(slopes, values)
        if np.abs(step).max() < _CORNER:
            return one, other
        if np.abs(step).max() > _LARGEST_STEP:
            break
        place = np.add(place, step)
    raise ConvergenceError(
        f"no corner of the neutral curve near phi = {np.degrees(place[1]):.6g} deg"
    )
