"""Answers as text for people and as JSON for programs."""

import json
from collections.abc import Sequence
from math import isfinite
from typing import Any

from hopper_cli import text
from hopper_data import glossary
from hopper_data.tables import Row


def as_text(title: str, cells: Sequence[tuple[str, str]], sentences: Sequence[str]) -> str:
    """Return a title, a table of labels and values, and sentences."""
    table = [text.table(cells), ""] if cells else []
    return "\n".join([title, "", *table, *sentences])


def explained(answer: str) -> str:
    """Return a text with the definitions of its terms below."""
    terms = glossary.explained(answer)
    return "\n".join([answer, "", *(f"{term}: {words}" for term, words in terms.items())])


def as_json(inputs: dict[str, Any], rows: Sequence[Row], **more: Any) -> str:
    """Return inputs, numbers by their names, what else there is, and the numbers' errors."""
    rows = [*rows, *(row.in_degrees() for row in rows if row.variable.units == "radian")]
    errors = {row.variable.name: row.error for row in rows if row.error is not None}
    errors |= more.pop("errors", {})
    numbers = {row.variable.name: row.value for row in rows}
    document = {**inputs, **numbers, **more, "errors": errors}
    return json.dumps(_finite(document), indent=2, allow_nan=False)


def over_ranges(inputs: dict[str, Any], rows: Sequence[tuple[Row, Row]], **more: Any) -> str:
    """Return an answer over ranges: as :func:`as_json`, numbers and errors as [low, high]."""
    rows = [
        *rows,
        *((a.in_degrees(), b.in_degrees()) for a, b in rows if a.variable.units == "radian"),
    ]
    known = {
        low.variable.name: (low, high) if low.value is not None else None for low, high in rows
    }
    numbers = {name: pair and [row.value for row in pair] for name, pair in known.items()}
    errors = {name: [row.error for row in pair] for name, pair in known.items() if pair}
    return json.dumps(
        _finite({**inputs, **numbers, **more, "errors": errors}), indent=2, allow_nan=False
    )


def _finite(value: Any) -> Any:
    """Return a JSON value with null for what is not finite: JSON has no NaN."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value
