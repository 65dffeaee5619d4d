"""What a CF file holds."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

CfVariable = tuple[tuple[str, ...], Any, dict[str, Any]]


@dataclass(frozen=True)
class CfDataset:
    """What a CF file holds, as xarray.Dataset takes it; xarray takes half a second to import.

    Attributes
    ----------
    data, coordinates : dict
        Dimensions, values and attributes of each variable: flags are codes, complex numbers in two
        parts.
    attributes : mapping
        Of the whole file.
    """

    data: dict[str, CfVariable]
    coordinates: dict[str, CfVariable]
    attributes: Mapping[str, Any]

    def __repr__(self) -> str:
        """Return how many variables there are, and over what."""
        return f"CfDataset({len(self.data)} variables over {', '.join(self.coordinates) or 'none'})"
