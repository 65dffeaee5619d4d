"""Read some variables of netCDF artifacts: apart from others, as it takes no xarray."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hopper_data.columns import columns
from hopper_workflow.artifacts import require_parameters, verify


def read(
    path: str | Path, names: Sequence[str], parameters: Mapping[str, Any] | None = None
) -> dict[str, np.ndarray]:
    """Verify an artifact and return variables as stored: flags as codes, complex numbers in parts.

    Raises
    ------
    ArtifactError
        As :func:`hopper_workflow.reading.read`.
    """
    verify(path)
    values, attributes = columns(path, names)
    require_parameters(path, attributes, parameters)
    return values
