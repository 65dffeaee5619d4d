"""Maps over internal and wall friction in chunks of rows."""

import logging
from collections.abc import Callable
from typing import Any

import numpy as np

from hopper_workflow import jobs, ranges
from hopper.problem import Hopper
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import hopper_of
from hopper_data.tables import Table, in_degrees, number, within

_AXES = (
    in_degrees("delta", "angle of internal friction", "delta"),
    in_degrees("phi", "angle of wall friction", "phi"),
    number("row", "row of the whole map", "delta"),
)


def swept(
    sweep: Callable[[Hopper, np.ndarray], Any],
    table: Table,
    hopper: tuple[str, float, str],
    *,
    delta_deg: dict[str, Any],
    phi_deg: dict[str, Any],
    chunk: int,
    chunks: int,
) -> CfDataset:
    """Sweep the rows chunk, chunk + chunks, ...; each row is independent of the others.

    ``hopper`` is geometry, half angle in degrees and model.
    """
    geometry, half_angle_deg, model = hopper
    rows = np.arange(chunk, delta_deg["points"], chunks)
    deltas, phis = ranges.spaced(**delta_deg)[rows], ranges.spaced(**phi_deg)
    report = jobs.progress(logging.getLogger(), "rows")
    sweeps = []
    for done, delta in enumerate(deltas, start=1):
        sweeps.append(sweep(hopper_of(geometry, delta, half_angle_deg, model), np.radians(phis)))
        report(done, deltas.size)
    result = {"sweeps": sweeps, "delta": deltas, "phi": phis, "row": rows}
    return dataset(result, within("sweeps", table), _AXES, leading="delta")
