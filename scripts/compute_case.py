"""Everything about one hopper of the list `cases`: fields, limits, spectrum, verdict."""

import logging
from typing import Any

from hopper_workflow import artifacts, jobs
from hopper.assessment.summary import assess
from hopper_data.assessments import comment, described
from hopper_data.datasets import dataset
from hopper_data.inputs import Case, Wall


def compute_case(artifact: str, provenance: str, *, case: dict[str, Any]) -> None:
    """Assess the hopper as far as its radial solution and its stability exist."""
    inputs = {key: value for key, value in case.items() if key not in ("name", "mu")}
    given = Case(**inputs, wall=Wall.of(case["mu"]))
    found = assess(given.hopper, given.wall.friction_angle)
    logging.info("%s: %s %s", given, found.outcome, found.reason)
    artifacts.write(
        dataset(*described(found), attributes=comment(found)),
        artifact,
        provenance,
        title=f"Case {case['name']}: {given}",
        equations="(2.8)-(2.15), (3.1)-(3.5), (4.1), (4.2), (4.11)",
        parameters=case,
    )


if __name__ == "__main__":
    jobs.run(compute_case)
