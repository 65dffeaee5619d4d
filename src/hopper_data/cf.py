"""netCDF files that follow the CF and ACDD conventions, written and read."""

import errno
import json
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import xarray as xr

import hopper
from hopper_data.decoding import decoded
from hopper_data.files import replacing

# Bytes below which a disk is full for an artifact.
_LITTLE = 2**16
WRITTEN_BY = f"written by hopper {hopper.__version__}"
PAPER = (
    "P.-A. Gremaud, J. V. Matthews, M. Shearer, Similarity solutions for granular flows in "
    "hoppers, Contemporary Mathematics 255 (2000)"
)


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
    history: str = WRITTEN_BY,
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
        source=f"hopper {hopper.__version__}",
        product_version=hopper.__version__,
        institution="hopper project",
        history=history,
        references=PAPER,
        parameters=plain(parameters),
    )
    with replacing(path) as temporary:
        try:
            _store(dataset, temporary)
        except (RuntimeError, PermissionError) as error:
            # What the library says of a full disk is "HDF error", or that permission is denied.
            free = shutil.disk_usage(temporary.parent).free
            if isinstance(error, PermissionError) and free > _LITTLE:
                raise
            reason = f"{error}, with {free} bytes free on its disk: make room"
            raise OSError(errno.EIO, reason, str(path)) from error


def _store(dataset: xr.Dataset, path: Path) -> None:
    encoding = {name: {"_FillValue": None} for name in dataset.variables}
    try:
        dataset.to_netcdf(path, engine="netcdf4", format="NETCDF4", encoding=encoding)
    except PermissionError:
        if shutil.disk_usage(path.parent).free <= _LITTLE:
            raise
        # HDF5 says so where the file system has no locks: write where there are some.
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder, path.name)
            dataset.to_netcdf(copy, engine="netcdf4", format="NETCDF4", encoding=encoding)
            shutil.copyfile(copy, path)


def open_stored(path: str | Path) -> xr.Dataset:
    """Load a netCDF file into memory as it is stored: flags as codes, complex numbers in two parts.

    Raises
    ------
    OSError
        If it is missing or not a netCDF file.
    """
    try:
        return _load(path)
    except OSError:
        if not Path(path).is_file():
            raise
        # Not a netCDF file, or one on a file system that has no locks for HDF5.
        with tempfile.TemporaryDirectory() as folder:
            return _load(shutil.copy2(path, folder))


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
