"""netCDF files of the workflow and the command, read as xarray datasets."""

from pathlib import Path

import xarray as xr

from hopper_data.contents import CfDataset
from hopper_data.decoding import decoded
from hopper_data.files import loaded


def as_xarray(dataset: CfDataset) -> xr.Dataset:
    """Return the variables of a file as a dataset, as :func:`open_stored` would."""
    return xr.Dataset(dataset.data, dataset.coordinates, dataset.attributes)


def open_stored(path: str | Path) -> xr.Dataset:
    """Load a netCDF file into memory as it is stored: flags as codes, complex numbers in two parts.

    Raises
    ------
    OSError
        If it is missing or not a netCDF file.
    """
    return loaded(_load, path)


def _load(path: str | Path) -> xr.Dataset:
    with xr.open_dataset(path, engine="netcdf4") as stored:
        return stored.load()


def open_artifact(path: str | Path) -> xr.Dataset:
    """Load an artifact of the workflow, or a file of the command, into memory.

    Flags are named, complex numbers in one piece; units stand in the attributes, angles in degrees
    unless these say radians.

    Raises
    ------
    OSError
        If it is missing or not a netCDF file.

    Examples
    --------
    >>> from tempfile import NamedTemporaryFile
    >>> import xarray
    >>> from hopper_data import open_artifact
    >>> with NamedTemporaryFile(suffix=".nc") as file:
    ...     xarray.Dataset({"psi": ("theta", [0.0, 0.5])}).to_netcdf(file.name)
    ...     print(open_artifact(file.name).psi.values)
    [0.  0.5]
    """
    return decoded(open_stored(path))
