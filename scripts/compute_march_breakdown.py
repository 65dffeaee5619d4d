"""A march to its breakdown: fields over depth and angle, and the net of characteristics."""

from collections.abc import Mapping
from typing import Any

from hopper_workflow import artifacts, jobs
from hopper.assessment.march import assess_march
from hopper.march.lines import characteristics
from hopper_data import assessments
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.tables import Table, angle, flag, number
from hopper_data.tops import named_top


def compute_march_breakdown(
    *, hopper: Mapping[str, Any], top: Mapping[str, Any], depth: float, cells: int
) -> CfDataset:
    """March one top down one hopper."""
    given = named_top(**top)
    found = assess_march(solution_of(**hopper), given, depth)
    lines = characteristics(found.result.base, given, cells, found.end)
    return dataset({"profiles": found.profiles(), "march": found, "lines": lines}, TABLE)


TABLE: Table = (
    *assessments.MARCH_WHOLE,
    number("line_tau", "log(r_top / r) of both ends of a piece", "piece end", "lines.tau"),
    angle("line_theta", "polar angle of both ends of a piece", "piece end", "lines.theta"),
    flag("line_family", "family of characteristics", ("minus", "plus"), "piece", "lines.forward"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_march_breakdown, "March of the stress to its breakdown", "(2.8)-(2.11), (3.1)"
        )
    )
