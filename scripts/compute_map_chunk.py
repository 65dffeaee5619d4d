"""Some rows of a stability map: every n-th delta, all wall friction angles."""

import logging
from typing import Any

import numpy as np
import xarray as xr

from hopper.domain.stability_map import sweep_friction
from support import artifacts, fields, hoppers, jobs, maps


def compute_map_chunk(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    half_angle_deg: float,
    delta_deg: dict[str, Any],
    phi_deg: dict[str, Any],
    chunk: int,
    chunks: int,
) -> None:
    """Sweep the rows chunk, chunk + chunks, ...; each row is independent of the others."""
    rows = np.arange(chunk, delta_deg["points"], chunks)
    deltas = fields.axis(**delta_deg)[rows]
    phis = fields.axis(**phi_deg)
    report = jobs.progress(logging.getLogger(), "rows")
    sweeps = []
    for done, delta in enumerate(deltas, start=1):
        hopper = hoppers.mohr_coulomb(geometry, delta, half_angle_deg)
        sweeps.append(sweep_friction(hopper, np.radians(phis)))
        report(done, deltas.size)
    artifacts.write(
        xr.Dataset(
            maps.map_variables(sweeps),
            coords={
                "delta": fields.angle("delta", deltas, "angle of internal friction"),
                "phi": fields.angle("phi", phis, "angle of wall friction"),
                "row": fields.number("delta", rows, "row of the whole map"),
            },
        ),
        artifact,
        provenance,
        title=f"Rows of the stability map, {geometry}",
        equations="(4.1), (4.2)",
        parameters={
            "geometry": geometry,
            "half_angle_deg": half_angle_deg,
            "delta_deg": delta_deg,
            "phi_deg": phi_deg,
            "chunk": chunk,
            "chunks": chunks,
        },
    )


if __name__ == "__main__":
    jobs.run(compute_map_chunk, snakemake)  # type: ignore[name-defined]  # noqa: F821
