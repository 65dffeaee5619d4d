"""Tables in files: CSV, workbooks, JSON, netCDF."""

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from math import isfinite
from pathlib import Path
from typing import Any, TextIO

from hopper_data.files import replacing
from hopper_data.hopper_lists import harmless

_Rows = Iterable[Mapping[str, Any]]


def write(out: Path, titles: Sequence[str], rows: _Rows) -> None:
    """Write a table by the suffix of its name; it appears whole or not at all."""
    with replacing(out) as temporary:
        suffix = out.suffix.lower()
        if suffix == ".json":
            temporary.write_text(json.dumps(list(rows), indent=2) + "\n", encoding="utf-8")
        elif suffix == ".nc":
            from hopper_data import sheets

            sheets.write(temporary, titles, list(rows))
        elif suffix == ".xlsx":
            _write_workbook(temporary, titles, rows)
        else:
            with temporary.open("w", newline="", encoding="utf-8") as file:
                write_csv(file, titles, rows)


def write_csv(file: TextIO, titles: Sequence[str], rows: _Rows) -> None:
    """Write a table of which no cell is a formula."""
    csv.writer(file, lineterminator="\n").writerows(_cells(titles, rows))


def _write_workbook(path: Path, titles: Sequence[str], rows: _Rows) -> None:
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    sheet = book.create_sheet("hoppers")
    for row in _cells(titles, rows):
        sheet.append([_number(cell) for cell in row])
    book.save(path)


def _cells(titles: Sequence[str], rows: _Rows) -> Iterable[Sequence[Any]]:
    return chain([titles], ([_cell(row[title]) for title in titles] for row in rows))


def _cell(value: Any) -> Any:
    return harmless(value) if isinstance(value, str) else value


def _number(cell: Any) -> Any:
    """Return the number that a text spells, others as they are: a workbook knows numbers."""
    try:
        number = float(cell)
    except (TypeError, ValueError):
        return cell
    return number if isfinite(number) else cell
