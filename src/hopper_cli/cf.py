"""netCDF files that follow the CF and ACDD conventions."""

import errno
import json
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from hopper import __version__
from hopper_cli.files import replacing

Variable = tuple[tuple[str, ...] | str, Any, dict[str, Any]]

PAPER = (
    "P.-A. Gremaud, J. V. Matthews, M. Shearer, Similarity solutions for granular flows in "
    "hoppers, Contemporary Mathematics 255 (2000)"
)


def number(
    dimensions: tuple[str, ...] | str, values: Any, long_name: str, units: str = "1"
) -> Variable:
    """Return a variable, dimensionless by default."""
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


def complex_number(dimension: str, name: str, values: Any, long_name: str) -> dict[str, Variable]:
    """Return real and imaginary part as two variables; netCDF has no complex type."""
    return {
        f"{name}_real": number(dimension, values.real, f"real part of {long_name}"),
        f"{name}_imag": number(dimension, values.imag, f"imaginary part of {long_name}"),
    }


def plain(parameters: Mapping[str, Any]) -> str:
    """Return parameters as canonical JSON, the form stored in a file."""
    return json.dumps(parameters, sort_keys=True, default=list)


def write(
    dataset: xr.Dataset,
    path: str | Path,
    *,
    title: str,
    equations: str,
    parameters: Mapping[str, Any],
    history: str = f"written by hopper {__version__}",
) -> None:
    """Write a dataset with its global attributes, nothing of which varies between runs.

    ``equations`` names the equations or sections of the paper the data come from, ``parameters``
    what they depend on.

    Raises
    ------
    OSError
        If the file cannot be written, for one because the disk is full; no part of it stays.
    """
    dataset = dataset.assign_attrs(
        Conventions="CF-1.11, ACDD-1.3",
        title=title,
        summary=f"{title}. Equations: {equations}.",
        keywords="granular flow, hopper, similarity solution, linear stability",
        source=f"hopper {__version__}",
        product_version=__version__,
        institution="hopper project",
        history=history,
        references=PAPER,
        parameters=plain(parameters),
    )
    encoding = {name: {"_FillValue": None} for name in dataset.variables}
    with replacing(path) as temporary:
        try:
            dataset.to_netcdf(temporary, engine="netcdf4", format="NETCDF4", encoding=encoding)
        except RuntimeError as error:
            # What the library says of a full disk is "HDF error".
            free = shutil.disk_usage(temporary.parent).free
            reason = f"{error}, with {free} bytes free on its disk: make room"
            raise OSError(errno.EIO, reason, str(path)) from error
