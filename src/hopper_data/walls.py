"""Wall friction as people give it. No numerics: the configuration is read with it."""

from dataclasses import dataclass
from math import atan, degrees, radians, tan
from typing import Self


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
