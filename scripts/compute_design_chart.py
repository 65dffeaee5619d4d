"""Design charts of one geometry: limits of wall friction over the half angle, and flow factors."""

import logging
from collections.abc import Sequence
from math import radians
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, ranges
from hopper.design.charts import chart
from hopper.problem import as_geometry
from hopper_data.charts import CHARTS, side_by_side
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import in_degrees


def compute_design_chart(
    *, geometry: str, deltas_deg: Sequence[float], half_angles_deg: dict[str, Any], frictions: int
) -> CfDataset:
    """Compute a chart for each internal friction."""
    report = jobs.progress(logging.getLogger(), "internal frictions")
    angles = np.radians(ranges.spaced(**half_angles_deg))
    charts = []
    for delta in deltas_deg:
        charts.append(chart(as_geometry(geometry), radians(delta), angles, frictions))
        report(len(charts), len(deltas_deg))
    return dataset({**side_by_side(charts), "delta": deltas_deg}, CHARTS, AXES)


AXES = (in_degrees("delta", "angle of internal friction", "delta"),)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_design_chart,
            "Design charts: limits of wall friction over the half angle, and flow factors",
            "(2.8)-(2.15), (3.1)-(3.5), (4.1), (4.2); Jenike (1964)",
        )
    )
