"""One stability map from its chunks; the same bytes however many there are."""

from collections.abc import Sequence
from typing import Any

import xarray as xr

from support import artifacts, jobs


def merge_map(
    chunks: Sequence[str],
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    half_angle_deg: float,
    delta_deg: dict[str, Any],
    phi_deg: dict[str, Any],
) -> None:
    """Sort the rows of all chunks by delta."""
    parameters = {
        "geometry": geometry,
        "half_angle_deg": half_angle_deg,
        "delta_deg": delta_deg,
        "phi_deg": phi_deg,
    }
    parts = [
        artifacts.read(path, {**parameters, "chunk": index, "chunks": len(chunks)})
        for index, path in enumerate(chunks)
    ]
    merged = xr.concat(parts, "delta", combine_attrs="drop_conflicts")
    merged = merged.sortby("row").drop_vars("row")
    for variable in merged.variables.values():
        # As read, it still names the dropped coordinate.
        variable.encoding.pop("coordinates", None)
    artifacts.write(
        merged,
        artifact,
        provenance,
        title=f"Stability map, {geometry}",
        equations="(4.1), (4.2)",
        parameters=parameters,
    )


if __name__ == "__main__":
    jobs.run(merge_map, snakemake)  # type: ignore[name-defined]  # noqa: F821
