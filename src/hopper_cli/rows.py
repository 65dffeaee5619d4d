"""Numbers and arrays with names, descriptions, units and errors."""

from dataclasses import dataclass, field
from math import radians

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Described:
    """A name for programs, a description for people, and units as CF spells them.

    ``scale`` is what a dimensionless number is a multiple of, where that is not plain.
    """

    key: str
    label: str
    units: str = "1"
    scale: str = ""

    @property
    def long_name(self) -> str:
        """Label and scale."""
        return f"{self.label} over {self.scale}" if self.scale else self.label


@dataclass(frozen=True)
class Row(Described):
    """A number with its absolute error; None where it does not exist."""

    value: float | None = None
    error: float | None = None

    @property
    def relative_error(self) -> float:
        """Error relative to the value; of angles, in radians."""
        if self.value is None or self.error is None:
            return 0.0
        if self.units == "degree":
            return radians(self.error)
        return self.error if self.units == "radian" else self.error / abs(self.value)


@dataclass(frozen=True)
class Column(Described):
    """Values of shape (n,)."""

    values: NDArray[np.float64] = field(kw_only=True)
