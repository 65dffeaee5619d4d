"""netCDF files that follow the CF and ACDD conventions, written."""

import errno
import json
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

import hopper
from hopper_data.contents import CfDataset
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
    dataset: CfDataset,
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
    attributes = {
        **dataset.attributes,
        "Conventions": "CF-1.11, ACDD-1.3",
        "title": title,
        "summary": f"{title}. Equations: {equations}.",
        "keywords": "granular flow, hopper, similarity solution, linear stability",
        "source": f"hopper {hopper.__version__}",
        "product_version": hopper.__version__,
        "institution": "hopper project",
        "history": history,
        "references": PAPER,
        "parameters": plain(parameters),
    }
    with replacing(path) as temporary:
        try:
            _store(dataset, attributes, temporary)
        except (RuntimeError, PermissionError) as error:
            # What the library says of a full disk is "HDF error", or that permission is denied.
            free = shutil.disk_usage(temporary.parent).free
            if isinstance(error, PermissionError) and free > _LITTLE:
                raise
            reason = f"{error}, with {free} bytes free on its disk: make room"
            raise OSError(errno.EIO, reason, str(path)) from error


def _store(dataset: CfDataset, attributes: Mapping[str, Any], path: Path) -> None:
    try:
        _fill(dataset, attributes, path)
    except PermissionError:
        if shutil.disk_usage(path.parent).free <= _LITTLE:
            raise
        # HDF5 says so where the file system has no locks: write where there are some.
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder, path.name)
            _fill(dataset, attributes, copy)
            shutil.copyfile(copy, path)


def _fill(dataset: CfDataset, attributes: Mapping[str, Any], path: Path) -> None:
    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        file.setncatts(attributes)
        for name, (dimensions, values, described) in (dataset.coordinates | dataset.data).items():
            values = np.asarray(values)
            words = values.dtype.kind in "UO"
            for dimension, size in zip(dimensions, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            beside = [
                other
                for other, (over, _, _) in dataset.coordinates.items()
                if other not in over and set(over) <= set(dimensions)
            ]
            if name in dataset.data and beside:
                described = described | {"coordinates": " ".join(beside)}
            stored = file.createVariable(name, str if words else values.dtype, dimensions)
            stored.setncatts(described)
            stored[...] = values.astype(object) if words else values
