"""Everything about one hopper of the list `cases`: fields, limits, spectrum, verdict."""

import logging
from typing import Any

from hopper_workflow import artifacts, jobs, own_hoppers
from hopper.assessment.summary import assess
from hopper.design.flow_pattern import flow_pattern
from hopper_cli import range_answers, ranges, sentences
from hopper_data.assessments import comment, described
from hopper_data.datasets import dataset
from hopper_data.inputs import Case
from hopper_data.walls import Wall


def compute_case(artifact: str, provenance: str, *, case: dict[str, Any]) -> None:
    """Assess the hopper as far as its radial solution and its stability exist.

    Of one that is given in ranges the middle is assessed, and shares of the ranges are added.
    """
    given = _middle(case)
    found = assess(given.hopper, given.wall.friction_angle)
    logging.info("%s: %s %s", given, found.outcome, found.reason)
    words = _words(case)
    artifacts.write(
        dataset(*described(found), attributes=comment(found) | words),
        artifact,
        provenance,
        title=f"Case {case['name']}: {given}" + (", in the middle" if "shares" in words else ""),
        equations="(2.8)-(2.15), (3.1)-(3.5), (4.1), (4.2), (4.11)",
        parameters=case,
    )


def _middle(case: dict[str, Any]) -> Case:
    given = own_hoppers.middle(case)
    wall = Wall(given.pop("mu"), given.pop("phi_deg"))
    return Case(**given, wall=wall)


def _words(case: dict[str, Any]) -> dict[str, str]:
    """Return the sentence of mass flow, and the shares of ranges."""
    given, options = _middle(case), own_hoppers.options(case)
    pattern = flow_pattern(given.material, given.hopper.half_angle)
    if not ranges.of_kind(options, ranges.Given):
        return {"sentence": sentences.mass_flow_sentence(pattern)}
    over = range_answers.judged_over(options)
    return {
        "sentence": sentences.mass_flow_sentence(pattern, over),
        "shares": "; ".join(": ".join(cell) for cell in range_answers.share_cells(over.shares)),
    }


if __name__ == "__main__":
    jobs.run(compute_case)
