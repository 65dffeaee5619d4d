"""Some rows of a stability map: every n-th delta, all wall friction angles."""

import logging
from typing import Any

import numpy as np
import xarray as xr

from hopper_workflow import artifacts, jobs, ranges
from hopper.domain.stability_map import sweep_friction
from hopper_data.datasets import dataset
from hopper_data.domain import SWEEP
from hopper_data.inputs import hopper_of
from hopper_data.tables import in_degrees, number, within


def compute_map_chunk(
    *,
    geometry: str,
    half_angle_deg: float,
    delta_deg: dict[str, Any],
    phi_deg: dict[str, Any],
    chunk: int,
    chunks: int,
) -> xr.Dataset:
    """Sweep the rows chunk, chunk + chunks, ...; each row is independent of the others."""
    rows = np.arange(chunk, delta_deg["points"], chunks)
    deltas, phis = ranges.spaced(**delta_deg)[rows], ranges.spaced(**phi_deg)
    report = jobs.progress(logging.getLogger(), "rows")
    sweeps = []
    for done, delta in enumerate(deltas, start=1):
        hopper = hopper_of(geometry, delta, half_angle_deg)
        sweeps.append(sweep_friction(hopper, np.radians(phis)))
        report(done, deltas.size)
    result = {"sweeps": sweeps, "delta": deltas, "phi": phis, "row": rows}
    return dataset(result, within("sweeps", SWEEP), AXES, leading="delta")


AXES = (
    in_degrees("delta", "angle of internal friction", "delta"),
    in_degrees("phi", "angle of wall friction", "phi"),
    number("row", "row of the whole map", "delta"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_map_chunk, "Rows of the stability map, {geometry}", "(4.1), (4.2)"
        )
    )
