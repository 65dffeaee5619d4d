"""Numbers with errors."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """A number and its absolute error, in the same unit."""

    value: float
    error: float

    def __repr__(self) -> str:
        """Return both in one short line."""
        return f"{self.value:.10g} +- {self.error:.0e}"
