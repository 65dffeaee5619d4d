"""Assessments as netCDF. What does not exist is left out; flags say why."""

from collections.abc import Iterable
from pathlib import Path
from typing import get_args

import xarray as xr

from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper.assessment.summary import OUTCOMES, Assessment
from hopper.radial.friction_limit import End
from hopper_cli import answers, cf
from hopper_cli.answers import Part
from hopper_cli.inputs import Case
from hopper_cli.rows import Row

_ENDS: tuple[str, ...] = get_args(End)


def assessment_dataset(found: Assessment) -> xr.Dataset:
    """Return all that is known about a hopper."""
    variables = {
        "outcome": cf.flag(
            (),
            OUTCOMES.index(found.outcome),
            "verdict of stability, or why there is none",
            OUTCOMES,
        )
    }
    for part in (found.radial, found.stability):
        if part is not None:
            variables |= _variables(part)
    if found.limits.friction is not None:
        end = _ENDS.index(found.limits.friction.end)
        variables["limit_end"] = cf.flag((), end, "what ends the solutions at mu_limit", _ENDS)
    variables |= _numbers(answers.limit_rows(found.limits))
    reasons = [*(found.radial.notes if found.radial else ()), *filter(None, [found.reason])]
    return xr.Dataset(variables, attrs={"comment": "; ".join(reasons)} if reasons else {})


def write(path: Path, case: Case, found: Part) -> None:
    """Write one part of an assessment."""
    radial = isinstance(found, RadialAssessment)
    cf.write(
        xr.Dataset(_variables(found)),
        path,
        title=f"{'Radial solution' if radial else 'Linear stability'}: {case}",
        equations="(2.8)-(2.15), (3.1)-(3.5)" if radial else "(4.1), (4.2)",
        parameters=case.echoed(),
    )


def _variables(found: Part) -> dict[str, cf.Variable]:
    if isinstance(found, RadialAssessment):
        dimension, rows = "theta", answers.radial_rows(found)
    else:
        dimension, rows = "mode", answers.stability_rows(found)
    variables = {
        column.key: cf.number(dimension, column.values, column.long_name, column.units)
        for column in answers.columns(found)
    }
    if isinstance(found, StabilityAssessment):
        line = found.result.governed_by == "line"
        variables["governed_by"] = cf.flag((), line, "what sets the abscissa", ("mode", "line"))
    return variables | _numbers(rows)


def _numbers(rows: Iterable[Row]) -> dict[str, cf.Variable]:
    variables = {}
    for row in rows:
        if row.value is not None:
            variables[row.key] = cf.number((), row.value, row.long_name, row.units)
        if row.error is not None:
            label = f"error estimate of {row.key}"
            variables[f"{row.key}_error"] = cf.number((), row.error, label, row.units)
    return variables
