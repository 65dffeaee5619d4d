"""Attributes of variables that more than one script writes."""

from typing import Any

import numpy as np
import xarray as xr

from hopper_cli.cf import Variable as Variable
from hopper_cli.cf import complex_number as complex_number
from hopper_cli.cf import flag as flag
from hopper_cli.cf import number as number


def angle(
    dimensions: tuple[str, ...] | str, values: Any, long_name: str, units: str = "degree"
) -> Variable:
    """Return a variable of angles."""
    return number(dimensions, values, long_name, units)


def steps(start: float, stop: float, step: float) -> np.ndarray:
    """Return values from start by steps, up to stop."""
    return np.arange(start, stop + 1e-6 * step, step)


def axis(start: float, stop: float, points: int) -> np.ndarray:
    """Return equally spaced values."""
    return np.linspace(start, stop, points)


def as_complex(dataset: xr.Dataset, name: str) -> np.ndarray:
    """Return what :func:`complex_number` stored."""
    parts = dataset[f"{name}_real"].to_numpy(), dataset[f"{name}_imag"].to_numpy()
    return np.asarray(parts[0] + 1j * parts[1])
