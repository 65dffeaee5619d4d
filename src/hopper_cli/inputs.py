"""A hopper as people give it: names, and angles in degrees."""

from dataclasses import asdict, dataclass
from math import atan, degrees, radians, tan
from typing import Any, Self

from hopper.problem import Hopper, as_geometry
from hopper.yield_conditions import yield_condition


@dataclass(frozen=True)
class Wall:
    """Wall friction, both as coefficient ``mu`` = tan(phi) and as angle ``phi_deg`` (degrees)."""

    mu: float
    phi_deg: float

    @classmethod
    def of(cls, mu: float | None = None, phi_deg: float | None = None) -> Self:
        """Return the wall of the one that is given."""
        if phi_deg is not None:
            return cls(tan(radians(phi_deg)), phi_deg)
        if mu is None:
            raise TypeError("give mu or phi_deg")
        return cls(mu, degrees(atan(mu)))

    @property
    def friction_angle(self) -> float:
        """Phi, radians."""
        return atan(self.mu)

    def __str__(self) -> str:
        """Return both, rounded."""
        return f"mu = {self.mu:.6g} (phi = {self.phi_deg:.6g} deg)"


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
        return Hopper(
            as_geometry(self.geometry),
            radians(self.delta_deg),
            radians(self.half_angle_deg),
            yield_condition(self.model),
        )

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
