"""Maps from chunks of their rows: the same whatever the number of chunks."""

from collections.abc import Sequence
from typing import Any

import xarray as xr

from hopper_workflow import reading
from hopper_data.contents import CfDataset


def merged(
    chunks: Sequence[str],
    *,
    geometry: str,
    half_angle_deg: float,
    delta_deg: dict[str, Any],
    phi_deg: dict[str, Any],
) -> CfDataset:
    """Sort the rows of all chunks by delta."""
    parameters = {
        "geometry": geometry,
        "half_angle_deg": half_angle_deg,
        "delta_deg": delta_deg,
        "phi_deg": phi_deg,
    }
    parts = [
        reading.read(path, {**parameters, "chunk": index, "chunks": len(chunks)}, stored=True)
        for index, path in enumerate(chunks)
    ]
    whole = xr.concat(parts, "delta", combine_attrs="drop_conflicts").sortby("row").drop_vars("row")
    data, coordinates = (
        {
            str(name): (tuple(map(str, variable.dims)), variable.values, dict(variable.attrs))
            for name, variable in variables.items()
        }
        for variables in (whole.data_vars, whole.coords)
    )
    return CfDataset(data, coordinates, whole.attrs)
