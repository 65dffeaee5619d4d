"""What the subcommands answer where options are gone through in steps: a table."""

import json
from argparse import Namespace
from collections.abc import Iterator
from io import StringIO
from itertools import product
from math import radians
from typing import Any

from hopper.design.design import Demand, design
from hopper.design.material import Material
from hopper.errors import HopperError
from hopper.problem import as_geometry
from hopper.yield_conditions import yield_condition
from hopper_cli import designs, ranges, sentences, sheet_files, sheets
from hopper_cli.columns import Columns
from hopper_cli.errors import UsageError
from hopper_data import assessments, tables
from hopper_data.hopper_lists import HopperList
from hopper_data.walls import Wall

_DESIGN = [name for one in assessments.DESIGN for name in (one.name, f"{one.name}_error")]
_DESIGN_COLUMNS = ("sentence", "governed_by", *_DESIGN, "reason")


def answer(options: Namespace) -> str:
    """Return the table of all steps, or write it where ``--out`` says.

    A row has what ``hopper table`` says of a hopper; of a design, what ``hopper design`` does.

    Raises
    ------
    UsageError
        If the table cannot be written, or the flow function not be read.
    """
    inputs = list(_inputs(options))
    rows = list(_designs(options, inputs) if options.command == "design" else _hoppers(inputs))
    titles = list(rows[0])
    if options.out is not None:
        try:
            sheet_files.write(options.out, titles, rows)
        except OSError as error:
            raise UsageError(f"argument --out: {options.out} cannot be written: {error}") from error
        return f"{len(rows)} rows in {options.out}."
    if options.json:
        return json.dumps(rows, indent=2, allow_nan=False)
    file = StringIO()
    sheet_files.write_csv(file, titles, rows)
    return file.getvalue().rstrip("\n")


def _inputs(options: Namespace) -> Iterator[dict[str, Any]]:
    """Yield the options of each row by their names, the last one running fastest."""
    names = [name for name in ranges.RANGED if getattr(options, name, None) is not None]
    values = [_values(getattr(options, name)) for name in names]
    fixed = {"geometry": options.geometry, "model": options.model}
    if chosen := getattr(options, "disturbances", None):
        fixed["disturbances"] = chosen
    for row in product(*values):
        yield fixed | dict(zip((ranges.option(name)[2:] for name in names), row, strict=True))


def _values(value: ranges.Value) -> list[Any]:
    return value.values if isinstance(value, ranges.Steps) else [value]


def _hoppers(inputs: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    titles = tuple(inputs[0])
    cells = tuple({title: str(value) for title, value in row.items()} for row in inputs)
    listed = HopperList(titles, cells, dict(zip(titles, titles, strict=True)))
    columns = Columns([])
    for number, row in enumerate(inputs):
        yield row | sheets.row_answer(listed, number, columns)


def _designs(options: Namespace, inputs: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    demand = designs.demand(options)
    for row in inputs:
        try:
            yield row | _design(options, row, demand)
        except HopperError as error:
            yield row | dict.fromkeys(_DESIGN_COLUMNS) | {"reason": str(error)}


def _design(options: Namespace, row: dict[str, Any], demand: Demand | None) -> dict[str, Any]:
    material = Material(
        as_geometry(options.geometry),
        radians(row["delta"]),
        Wall.of(row.get("mu"), row.get("phi")).friction_angle,
        yield_condition(options.model),
    )
    found = design(material, radians(options.margin), demand, options.disturbances)
    numbers: dict[str, Any] = {}
    for one in tables.rows(found, assessments.DESIGN):
        numbers |= {one.variable.name: one.value, f"{one.variable.name}_error": one.error}
    return {
        "sentence": sentences.design_sentence(found),
        "governed_by": found.half_angles.governed_by,
        **numbers,
        "reason": "; ".join(found.notes) or None,
    }
