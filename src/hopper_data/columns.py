"""Some variables of a netCDF file, for jobs that need few: xarray takes a third of a second."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from hopper_data.files import loaded


def columns(path: str | Path, names: Sequence[str]) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Return variables as a file stores them, by their names, and the attributes of the file.

    Flags are codes, complex numbers in two parts.

    Raises
    ------
    OSError
        If it is missing or not a netCDF file.
    IndexError
        If it has no such variable.
    """
    return loaded(partial(_load, names), path)


def _load(names: Sequence[str], path: str | Path) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    with netCDF4.Dataset(path) as file:
        file.set_auto_maskandscale(False)
        return {name: file[name][...] for name in names}, dict(vars(file))
