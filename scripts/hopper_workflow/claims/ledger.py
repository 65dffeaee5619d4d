"""From claims and artifacts to the rows of the ledger."""

import inspect
from collections.abc import Mapping, Sequence
from math import isfinite
from types import ModuleType

import xarray as xr

from hopper_workflow.claims import (
    section_1,
    section_1_marches,
    section_2,
    section_3,
    section_4_parameters,
    section_4_smooth_wall,
    section_4_spectrum,
    section_4_transient,
)
from hopper_workflow.claims.finding import (
    UNDECIDED,
    Finding,
    Judge,
    Printed,
    UndecidedError,
    rounded_up,
)
from hopper_workflow.claims.results import parameters
from hopper_workflow.claims.words import Claim

SECTIONS: tuple[ModuleType, ...] = (
    section_1,
    section_1_marches,
    section_2,
    section_3,
    section_4_smooth_wall,
    section_4_spectrum,
    section_4_transient,
    section_4_parameters,
)
COLUMNS = (
    "number",
    "id",
    "place",
    "claim",
    "paper",
    "computed",
    "error",
    "bound",
    "unit",
    "test",
    "verdict",
    "artifact",
    "remark",
)


# The public functions of the sections, by their names.
JUDGES: dict[str, Judge] = {
    name: function
    for module in SECTIONS
    for name, function in inspect.getmembers(module, inspect.isfunction)
    if function.__module__ == module.__name__ and not name.startswith("_")
}


def judge(claim: Claim, artifacts: Mapping[str, xr.Dataset]) -> Finding:
    """Judge a claim by its artifacts, given under the paths it names.

    A claim whose artifacts lack a value, or were made with other parameters than those it is
    about, cannot be decided.
    """
    data = {name: artifacts[path] for name, path in zip(claim.artifacts, claim.paths, strict=True)}
    function = JUDGES[claim.id]
    arguments = {**data, **claim.numbers}
    if "printed" in inspect.signature(function).parameters:
        exact = claim.exactly
        arguments["printed"] = Printed.parse(claim.paper) if exact is None else Printed.exact(exact)
    try:
        for dataset in data.values():
            _require_parameters(claim, dataset)
        return function(**arguments)
    except UndecidedError as reason:
        return Finding(float("nan"), float("nan"), UNDECIDED, f"No verdict: {reason}.")


def _require_parameters(claim: Claim, data: xr.Dataset) -> None:
    made_with = parameters(data)
    for name, wanted in claim.parameters.items():
        # A range of values is what the claim's function picks from.
        if isinstance(made_with.get(name), dict):
            continue
        if name in made_with and made_with[name] != wanted:
            raise UndecidedError(
                f"the claim is about {name} = {wanted}, the artifact has {made_with[name]}"
            )


def rows(claims: Sequence[Claim], artifacts: Mapping[str, xr.Dataset]) -> list[dict[str, str]]:
    """Return the ledger, a row for each claim, every column filled."""
    return [_row(number, claim, judge(claim, artifacts)) for number, claim in enumerate(claims, 1)]


def _row(number: int, claim: Claim, finding: Finding) -> dict[str, str]:
    known = isfinite(finding.computed)
    values = (
        str(number),
        claim.id,
        claim.place,
        claim.claim,
        claim.paper,
        f"{finding.computed:.10g}" if known else "none",
        rounded_up(finding.error) if known else "none",
        claim.bound,
        claim.unit,
        claim.test_in_full,
        finding.verdict,
        "; ".join(dict.fromkeys(claim.paths)),
        finding.remark,
    )
    return dict(zip(COLUMNS, values, strict=True))
