"""Neutral curve of cones by the paper's algorithm: where its abscissa changes sign, or jumps."""

import logging
from math import nan, radians
from typing import Any

import numpy as np

from hopper_workflow import artifacts, columns, jobs, ranges
from hopper.errors import HopperError
from hopper.evidence.sign_changes import sign_changes
from hopper.problem import Hopper
from hopper.radial.solution import solve_radial
from hopper.stability.paper_abscissa import paper_abscissa
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import Table, angle, flag, in_degrees, number


def compute_paper_border(
    border: str,
    *,
    half_angle_deg: float,
    frictions: int,
    delta_deg: dict[str, float],
    width_deg: float,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
) -> CfDataset:
    """Follow the abscissa over delta, both parities as worded, at wall frictions up to the corner.

    That is where the neutral curve of ``border`` ends on the fold of the radial solutions.
    """
    corner = float(columns.read(border, ["neutral_phi"])["neutral_phi"][-1])

    def abscissa(delta: float, phi: float) -> float:
        try:
            solution = solve_radial(Hopper("cone", delta, radians(half_angle_deg)), phi)
            return paper_abscissa(solution, nodes, coarse_nodes, tolerance).as_worded
        except HopperError as error:
            logging.debug("%s", error)
            return nan

    report = jobs.progress(logging.getLogger(), "wall frictions")
    phis = np.radians(corner) * np.arange(frictions) / frictions
    deltas, width = np.radians(ranges.steps(**delta_deg)), radians(width_deg)
    rows: list[dict[str, Any]] = []
    for index, phi in enumerate(phis):
        # Solutions begin close above delta = phi.
        first = phi + _BEYOND * width
        places = [first, *deltas[deltas > first + width]]
        found = sign_changes(lambda delta: abscissa(delta, phi), places, width)  # noqa: B023
        rows += [{**vars(change), "phi": phi} for change in found]
        report(index + 1, frictions)
    return dataset({"changes": rows, "phi": np.degrees(phis)}, TABLE, AXES)


# In widths of a bracket.
_BEYOND = 10

TABLE: Table = (
    angle("change_phi", "wall friction", "change", "changes.phi"),
    angle(
        "change_delta", "internal friction of a sign change or a jump", "change", "changes.place"
    ),
    angle("change_error", "half the width of its bracket", "change", "changes.error"),
    number("before", "abscissa by the paper's algorithm at less delta", "change", "changes.before"),
    number("after", "the same at more delta", "change", "changes.after"),
    flag("jump", "whether the abscissa jumps", ("no", "yes"), "change", "changes.jump"),
)
AXES = (in_degrees("phi", "wall friction looked at", "phi"),)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_paper_border,
            "Neutral curve by the paper's algorithm, cone, {half_angle_deg:g} deg",
            "(4.1), (4.2)",
        )
    )
