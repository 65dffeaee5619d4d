"""A radial solution in numbers."""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import Radians, checked
from hopper.arrays import Array
from hopper.assessment.limits import Limits, assess_limits
from hopper.assessment.propagation import wall_angle_rounding, with_errors
from hopper.brief import brief
from hopper.errors import ConvergenceError, NoRadialSolutionError, SingularVelocityError
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.flow_factor import flow_factor
from hopper.radial.members import number_of_solutions
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.radial.velocity import VelocityField, solve_velocity


@dataclass(frozen=True)
class RadialAssessment:
    """A radial solution in numbers; angles in radians, stresses in units of rho g r.

    Attributes
    ----------
    solution : RadialSolution
    velocity : VelocityField or None
        None where psi reaches pi/4, or comes too close to be resolved.
    sigma_axis, sigma_wall : Quantity
        Average stress at theta = 0 and theta_w.
    psi_wall, psi_max, theta_psi_max : Quantity
        psi(theta_w), the largest psi, and where it is.
    u_wall : Quantity or None
        u(theta_w) / u(0).
    flow_factor : Quantity
    solutions : int or None
        Number of radial solutions for this wall; None where the family is not resolved.
    limits : Limits
    notes : tuple of str
        Why something is None.
    """

    solution: RadialSolution
    velocity: VelocityField | None
    sigma_axis: Quantity
    sigma_wall: Quantity
    psi_wall: Quantity
    psi_max: Quantity
    theta_psi_max: Quantity
    u_wall: Quantity | None
    flow_factor: Quantity
    solutions: int | None
    limits: Limits
    notes: tuple[str, ...]

    __repr__ = brief("sigma_axis", "sigma_wall", "flow_factor", "solutions")

    @checked
    def profiles(self, theta: Array) -> tuple[Array, Array, Array | None]:
        """Return sigma, psi and u at ``theta`` (radians), each of shape (n,); u None if unknown."""
        sigma, psi, _, _ = self.solution.fields(theta)
        return sigma, psi, self.velocity.at(theta) if self.velocity else None


@checked
def assess_radial(hopper: Hopper, friction_angle: Radians) -> RadialAssessment:
    """Solve for the physical branch and return it in numbers.

    Raises
    ------
    HopperError
        As :func:`hopper.radial.solve_radial`.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.assessment.radial import assess_radial
    >>> found = assess_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> round(found.sigma_wall.value, 6), round(found.flow_factor.value, 4)
    (0.259154, 1.4503)
    """
    return describe_radial(solve_radial(hopper, friction_angle))


@checked
def describe_radial(solution: RadialSolution) -> RadialAssessment:
    """Return a radial solution of the physical branch in numbers."""
    notes = []
    hopper = solution.hopper
    sigma_axis, sigma_wall, psi_max, theta_psi_max, factor = with_errors(solution, _numbers)
    psi_wall = hopper.material.wall_angle(hopper.delta, solution.friction_angle)
    velocity = u_wall = solutions = None
    try:
        velocity, u_wall = wall_velocity(solution)
    except (SingularVelocityError, ConvergenceError) as unknown:
        notes.append(str(unknown))
    limits = assess_limits(hopper)
    if limits.friction is None:
        notes.append("the largest friction with a radial solution is not resolved")
    try:
        solutions = number_of_solutions(hopper, solution.friction_angle)
    except (ConvergenceError, NoRadialSolutionError):
        notes.append("the number of radial solutions is unknown: the family is not resolved")
    return RadialAssessment(
        solution,
        velocity,
        sigma_axis=sigma_axis,
        sigma_wall=sigma_wall,
        psi_wall=Quantity(psi_wall, wall_angle_rounding(solution)),
        psi_max=psi_max,
        theta_psi_max=theta_psi_max,
        u_wall=u_wall,
        flow_factor=factor,
        solutions=solutions,
        limits=limits,
        notes=tuple(notes),
    )


@checked
def wall_velocity(solution: RadialSolution) -> tuple[VelocityField, Quantity]:
    """Return the velocity field of a radial solution, and u(theta_w) / u(0).

    Raises
    ------
    SingularVelocityError, ConvergenceError
        As :func:`hopper.radial.velocity.solve_velocity`.
    """
    velocity = solve_velocity(solution)
    (log_u,) = with_errors(solution, _log_u_wall)
    error = velocity.wall * (log_u.error + velocity.error_estimate)
    return velocity, Quantity(velocity.wall, error)


def _numbers(solution: RadialSolution) -> Array:
    theta_psi_max, psi_max = solution.psi_maximum()
    return np.array(
        [solution.sigma_axis, solution.sigma_wall, psi_max, theta_psi_max, flow_factor(solution)]
    )


def _log_u_wall(solution: RadialSolution) -> Array:
    return solve_velocity(solution).log_u[-1:]
