"""Attributes of variables that more than one script writes."""

from typing import Any

import numpy as np
import xarray as xr

Variable = tuple[tuple[str, ...] | str, Any, dict[str, Any]]


def number(dimensions: tuple[str, ...] | str, values: Any, long_name: str) -> Variable:
    """Return a dimensionless variable."""
    return dimensions, values, {"long_name": long_name, "units": "1"}


def angle(
    dimensions: tuple[str, ...] | str, values: Any, long_name: str, units: str = "degree"
) -> Variable:
    """Return a variable of angles."""
    return dimensions, values, {"long_name": long_name, "units": units}


def flag(
    dimensions: tuple[str, ...] | str, values: Any, long_name: str, meanings: tuple[str, ...]
) -> Variable:
    """Return a CF flag variable: codes 0, 1, ... with their meanings."""
    return (
        dimensions,
        np.asarray(values, dtype=np.int8),
        {
            "long_name": long_name,
            "flag_values": np.arange(len(meanings), dtype=np.int8),
            "flag_meanings": " ".join(meanings),
        },
    )


def steps(start: float, stop: float, step: float) -> np.ndarray:
    """Return values from start by steps, up to stop."""
    return np.arange(start, stop + step / 2, step)


def axis(start: float, stop: float, points: int) -> np.ndarray:
    """Return equally spaced values."""
    return np.linspace(start, stop, points)


def complex_number(dimension: str, name: str, values: Any, long_name: str) -> dict[str, Variable]:
    """Return real and imaginary part as two variables; netCDF has no complex type."""
    return {
        f"{name}_real": number(dimension, values.real, f"real part of {long_name}"),
        f"{name}_imag": number(dimension, values.imag, f"imaginary part of {long_name}"),
    }


def as_complex(dataset: xr.Dataset, name: str) -> np.ndarray:
    """Return what :func:`complex_number` stored."""
    parts = dataset[f"{name}_real"].to_numpy(), dataset[f"{name}_imag"].to_numpy()
    return np.asarray(parts[0] + 1j * parts[1])
