"""How far below the top the stress is radial, over hoppers and tops."""

import logging
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, marches
from hopper.march.outcome import march
from hopper.march.result import March
from hopper.stability.asymptotic_line import asymptotic_line
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import Table, flag, number, text
from hopper_data.tops import named_top

_LEVELS = (0.05, 0.01)


def compute_march_depth(
    *,
    hoppers: Sequence[Mapping[str, Any]],
    tops: Sequence[Mapping[str, Any]],
    depth: float,
    cells: int,
    tolerance: float,
) -> CfDataset:
    """March every top down every hopper."""
    report = jobs.progress(logging.getLogger(), "marches", 8)
    found: list[dict[str, Any]] = []
    for hopper in hoppers:
        base = marches.base(hopper)
        marched = []
        for top in tops:
            found_here = march(base, named_top(**top), depth, tolerance, _LEVELS, cells)
            marched.append(_numbers(found_here, depth))
            report(len(found) * len(tops) + len(marched), len(hoppers) * len(tops))
        line = asymptotic_line(base.solution).abscissa
        name = marches.name_of_hopper(**hopper)
        found.append({"name": name, "line": line, "marches": marched})
    names = [marches.name_of_top(**top) for top in tops]
    return dataset({"hoppers": found, "tops": names, "levels": list(_LEVELS)}, TABLE, AXES)


def _numbers(found: March, depth: float) -> dict[str, Any]:
    end = found.breakdown
    unbroken = "none" if found.trusted_tau == depth else "not_trusted"
    return {
        "radius": [np.nan if each.radius is None else each.radius for each in found.settled],
        "error": [np.nan if each.error is None else each.error for each in found.settled],
        "kind": found.kind or unbroken,
        "end": np.exp(-found.trusted_tau) if end is None else end.radius,
        "end_error": np.nan if end is None else end.error * end.radius,
    }


TABLE: Table = (
    number(
        "settled",
        "r from which on the stress is within a level of the radial field",
        "hopper top level",
        "hoppers.marches.radius",
        scale="r_top",
    ),
    number(
        "settled_error", "error estimate of settled", "hopper top level", "hoppers.marches.error"
    ),
    flag(
        "breakdown_kind",
        "how the march ends",
        ("none", "crossing", "tangency", "kink", "not_trusted"),
        "hopper top",
        "hoppers.marches.kind",
    ),
    number("end", "r where the march ends", "hopper top", "hoppers.marches.end", scale="r_top"),
    number("end_error", "error estimate of end", "hopper top", "hoppers.marches.end_error"),
    number("line", "asymptotic line of Re(lambda)", "hopper", "hoppers.line"),
)
AXES: Table = (
    text("hopper", "hopper: delta, half angle (degrees), mu", "hopper", "hoppers.name"),
    text("top", "stress at the top", "top", "tops"),
    number("level", "distance from the radial stress", "level", "levels", scale="sigma"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_march_depth, "How far below the top the stress is radial", "(2.8)-(2.11), (3.1)"
        )
    )
