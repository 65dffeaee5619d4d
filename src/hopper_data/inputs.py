"""A hopper as people give it: names, and angles in degrees."""

from dataclasses import asdict, dataclass
from math import atan, radians
from typing import Any

from hopper.design.material import Material
from hopper.problem import Hopper, as_geometry
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.yield_conditions import yield_condition
from hopper_data.walls import Wall


def hopper_of(
    geometry: str, delta_deg: float, half_angle_deg: float, model: str = "mohr-coulomb"
) -> Hopper:
    """Return the hopper for the numerics, in radians.

    Raises
    ------
    InvalidParameterError
        If a value is out of range or the combination is not modelled.

    Examples
    --------
    >>> from hopper_data.inputs import hopper_of
    >>> hopper_of("cone", delta_deg=40, half_angle_deg=20)
    Hopper(cone, delta=40 deg, half_angle=20 deg, Mohr-Coulomb)
    """
    angles = radians(delta_deg), radians(half_angle_deg)
    return Hopper(as_geometry(geometry), *angles, yield_condition(model))


def solution_of(
    geometry: str, delta_deg: float, half_angle_deg: float, mu: float, model: str = "mohr-coulomb"
) -> RadialSolution:
    """Return the radial solution of the physical branch, as :func:`hopper_of`.

    Examples
    --------
    >>> from hopper_data.inputs import solution_of
    >>> round(solution_of("cone", delta_deg=40, half_angle_deg=20, mu=0.3).sigma_wall, 6)
    0.260314
    """
    return solve_radial(hopper_of(geometry, delta_deg, half_angle_deg, model), atan(mu))


@dataclass(frozen=True)
class Case:
    """A hopper, its material (angles in degrees) and its wall."""

    geometry: str
    model: str
    delta_deg: float
    half_angle_deg: float
    wall: Wall

    @property
    def hopper(self) -> Hopper:
        """The hopper for the numerics, in radians.

        Raises
        ------
        InvalidParameterError
            If a value is out of range or the combination is not modelled.
        """
        return hopper_of(self.geometry, self.delta_deg, self.half_angle_deg, self.model)

    @property
    def material(self) -> Material:
        """What fills the hopper, and its wall, as :attr:`hopper`."""
        hopper = self.hopper
        return Material(hopper.geometry, hopper.delta, self.wall.friction_angle, hopper.material)

    def echoed(self) -> dict[str, Any]:
        """Return the inputs by their keys in JSON and netCDF."""
        inputs = asdict(self)
        return inputs | inputs.pop("wall")

    def __str__(self) -> str:
        """Return everything in one line."""
        return (
            f"{self.geometry}, {self.model}, delta {self.delta_deg:.6g} deg, half angle "
            f"{self.half_angle_deg:.6g} deg, {self.wall}"
        )
