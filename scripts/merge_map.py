"""One stability map from its chunks; the same bytes however many there are."""

from collections.abc import Sequence
from typing import Any

import xarray as xr

from hopper_workflow import artifacts, jobs


def merge_map(
    chunks: Sequence[str],
    *,
    geometry: str,
    half_angle_deg: float,
    delta_deg: dict[str, Any],
    phi_deg: dict[str, Any],
) -> xr.Dataset:
    """Sort the rows of all chunks by delta."""
    parameters = {
        "geometry": geometry,
        "half_angle_deg": half_angle_deg,
        "delta_deg": delta_deg,
        "phi_deg": phi_deg,
    }
    parts = [
        artifacts.read(path, {**parameters, "chunk": index, "chunks": len(chunks)}, stored=True)
        for index, path in enumerate(chunks)
    ]
    merged = xr.concat(parts, "delta", combine_attrs="drop_conflicts")
    merged = merged.sortby("row").drop_vars("row")
    for variable in merged.variables.values():
        # As read, it still names the dropped coordinate.
        variable.encoding.pop("coordinates", None)
    return merged


if __name__ == "__main__":
    jobs.run(artifacts.writing(merge_map, "Stability map, {geometry}", "(4.1), (4.2)"))
