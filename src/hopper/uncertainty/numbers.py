"""The numbers of an answer at a point of a box, each with its error."""

from collections.abc import Callable
from dataclasses import dataclass
from math import nan, tan

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.assessment.limits import coefficient, tangency_coefficient
from hopper.assessment.propagation import ROUNDING, with_errors
from hopper.assessment.radial import wall_velocity
from hopper.brief import brief
from hopper.domain.borders import tangency_friction
from hopper.errors import HopperError
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.flow_factor import flow_factor
from hopper.radial.friction_limit import friction_limit
from hopper.radial.mass_flow import mass_flow_friction_angle
from hopper.radial.solution import RadialSolution
from hopper.radial.velocity import solve_velocity
from hopper.stability.modes import LinearStability
from hopper.uncertainty.hoppers import BoxedHoppers


@dataclass(frozen=True)
class Number:
    """A number at a point of a box, its error there, and the ranges on which it depends."""

    value: Callable[[Array], float]
    error: Callable[[Array], float]
    depends: tuple[str, ...] = ("delta", "wall", "half_angle")

    __repr__ = brief("depends")


@checked
def radial_numbers(hoppers: BoxedHoppers) -> dict[str, Number]:
    """Return those of the radial solution and the limits of friction, by name."""
    numbers = {name: _of_solution(hoppers, number) for name, number in _RADIAL.items()}
    for place, name in enumerate(("theta_psi_max", "psi_max")):
        numbers[name] = _psi_maximum(hoppers, place)
    return numbers | {"u_wall": _velocity(hoppers)} | _limits(hoppers)


@checked
def stability_numbers(hoppers: BoxedHoppers) -> dict[str, Number]:
    """Return the abscissae, and the limit of tangency, by name."""
    return {
        "line": _of_modes(hoppers, lambda found: (found.line.abscissa, found.line.error_estimate)),
        "abscissa": _of_modes(hoppers, lambda found: (found.abscissa, found.error_estimate)),
        "symmetric": _of_modes(hoppers, lambda found: found.symmetric),
        "asymmetric": _of_modes(hoppers, lambda found: found.asymmetric or (nan, nan)),
        "tangency": _limits(hoppers)["tangency"],
    }


def _of_solution(hoppers: BoxedHoppers, number: Callable[[RadialSolution], float]) -> Number:
    def value(point: Array) -> float:
        solution = hoppers.solved(point)
        return nan if isinstance(solution, str) else number(solution)

    def error(point: Array) -> float:
        solution = hoppers.solved(point)
        if isinstance(solution, str):
            return nan
        return with_errors(solution, lambda one: np.array([number(one)]))[0].error

    return Number(value, error)


_RADIAL: dict[str, Callable[[RadialSolution], float]] = {
    "sigma_axis": lambda solution: solution.sigma_axis,
    "sigma_wall": lambda solution: solution.sigma_wall,
    "psi_wall": lambda solution: solution.psi_wall,
    "flow_factor": flow_factor,
}


def _psi_maximum(hoppers: BoxedHoppers, place: int) -> Number:
    slow = _of_solution(hoppers, lambda solution: solution.psi_maximum()[place])
    return Number(lambda point: hoppers.psi_maximum(point)[place], slow.error)


def _velocity(hoppers: BoxedHoppers) -> Number:
    def value(point: Array) -> float:
        solution = hoppers.solved(point)
        try:
            return nan if isinstance(solution, str) else solve_velocity(solution).wall
        except HopperError:
            return nan

    def error(point: Array) -> float:
        solution = hoppers.solved(point)
        return nan if isinstance(solution, str) else wall_velocity(solution)[1].error

    return Number(value, error)


@checked
def spare_number(hoppers: BoxedHoppers) -> Number:
    """Return the half angle to spare, where its limit has a closed form."""

    def error(point: Array) -> float:
        quantity = hoppers.pattern(point).spare
        return quantity.error if quantity else nan

    return Number(hoppers.half_angle_to_spare, error)


def _of_modes(
    hoppers: BoxedHoppers, numbers: Callable[[LinearStability], tuple[float, float]]
) -> Number:
    def at(point: Array) -> tuple[float, float]:
        found = hoppers.stability(point)
        return (nan, nan) if isinstance(found, str) else numbers(found)

    return Number(lambda point: at(point)[0], lambda point: at(point)[1])


def _limits(hoppers: BoxedHoppers) -> dict[str, Number]:
    """Return the limits of friction, on which the wall of the hopper itself has no influence."""

    def at(point: Array) -> Hopper:
        material, half_angle = hoppers.box.hopper(point)
        return material.hopper(half_angle)

    def number(value: Callable[[Hopper], float], name: str) -> Number:
        def found(point: Array) -> float:
            try:
                return value(at(point))
            except HopperError:
                return nan

        def error(point: Array) -> float:
            quantity = _LIMIT_ERRORS[name](at(point))
            return quantity.error if quantity else nan

        return Number(found, error, ("delta", "half_angle"))

    return {
        "coefficient": number(lambda one: _largest(one).value, "coefficient"),
        "fold": number(_fold, "fold"),
        "mass_flow": number(mass_flow_friction_angle, "mass_flow"),
        "tangency": number(_tangency, "tangency"),
    }


def _largest(hopper: Hopper) -> Quantity:
    limit = friction_limit(hopper)
    return coefficient(Quantity(limit.friction_angle, limit.error_estimate + ROUNDING))


_LIMIT_ERRORS: dict[str, Callable[[Hopper], Quantity | None]] = {
    "coefficient": _largest,
    "fold": _largest,
    "mass_flow": lambda hopper: Quantity(0.0, ROUNDING),
    "tangency": tangency_coefficient,
}


def _fold(hopper: Hopper) -> float:
    limit = friction_limit(hopper)
    return tan(limit.friction_angle) if limit.end == "fold" else nan


def _tangency(hopper: Hopper) -> float:
    phi = tangency_friction(hopper)
    return nan if phi is None else tan(phi)
