"""What the error of the radial fields makes of numbers computed from them.

Errors of the fields are propagated to first order: the fields are shifted along a few directions,
among them the one in which their equations are worst conditioned, and the changes that follow,
scaled to the error of the fields, are added up.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.quantity import Quantity
from hopper.radial.solution import RadialSolution

ROUNDING = 4 * float(np.finfo(float).eps)
# Shift of the fields for first-order propagation, relative to their size.
SHIFT = 1e-8


@checked
def with_errors(
    solution: RadialSolution, numbers: Callable[[RadialSolution], Array]
) -> list[Quantity]:
    """Return numbers computed from the fields, with what the fields' error makes of them.

    Examples
    --------
    >>> from numpy import array
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.assessment.propagation import with_errors
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> [tau] = with_errors(solution, lambda one: array([one.member.tau]))
    >>> round(tau.value, 6), tau.error < 1e-11
    (8.435564, True)
    """
    values = numbers(solution)
    errors = propagated(solution, lambda shifted: np.abs(numbers(shifted) - values))
    errors = errors + ROUNDING * np.abs(values)
    return [Quantity(float(v), float(e)) for v, e in zip(values, errors, strict=True)]


@checked
def propagated(solution: RadialSolution, change: Callable[[RadialSolution], Array]) -> Array:
    """Return the sum of the changes that the error of the fields makes, to first order.

    The family's tangent is among the directions: near a fold psi_w hardly determines the solution,
    so that rounding moves it along the family.
    """
    member = solution.member
    size, tau = member.grid.size, max(1.0, abs(member.tau))
    x = solution.theta / solution.hopper.half_angle
    directions = np.zeros((4, member.u.size))
    directions[0, :size] = x**2
    directions[1, size:-1] = x
    directions[2, -1] = tau
    steepest = max(np.abs(member.tangent[:-1]).max(), abs(member.tangent[-1]) / tau)
    directions[3] = member.tangent / steepest
    rounding = ROUNDING * size
    errors = np.full(4, solution.error_estimate + rounding)
    rounding += wall_angle_rounding(solution)
    errors[3] += rounding / max(abs(directions[3, -2]), rounding**0.5)
    shifted = (
        replace(solution, member=replace(member, u=member.u + SHIFT * direction))
        for direction in directions
    )
    return errors / SHIFT @ np.array([change(one) for one in shifted])


@checked
def wall_angle_rounding(solution: RadialSolution) -> float:
    """Return the rounding of psi_w (radians), large where the wall law determines it badly."""
    delta, law, psi = solution.hopper.delta, solution.hopper.material, solution.psi_wall
    step = ROUNDING ** (1 / 3)
    slope = law.friction_angle(delta, psi + step) - law.friction_angle(delta, psi - step)
    slope = max(abs(slope) / (2 * step), ROUNDING**0.5)
    return ROUNDING * (1 + solution.friction_angle / slope)
