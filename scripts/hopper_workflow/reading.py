"""Read netCDF artifacts: apart from writing, as xarray takes half a second to import."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from hopper_data.reading import open_artifact, open_stored
from hopper_workflow.artifacts import require_parameters, verify


def read(
    path: str | Path, parameters: Mapping[str, Any] | None = None, *, stored: bool = False
) -> xr.Dataset:
    """Verify an artifact and load it into memory, flags and complex numbers as names and numbers.

    With ``stored`` as the file holds it.

    Raises
    ------
    ArtifactError
        As :func:`hopper_workflow.artifacts.verify`, or if it holds other parameters than
        ``parameters``.
    """
    verify(path)
    loaded = open_stored(path) if stored else open_artifact(path)
    require_parameters(path, loaded.attrs, parameters)
    return loaded
