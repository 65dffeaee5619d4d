"""Lists of hoppers as people keep them: CSV, a row a hopper, columns named as the options."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path

from hopper.brief import brief
from hopper.errors import HopperError, InvalidParameterError
from hopper.stability.modes import Disturbances
from hopper_data.inputs import Case
from hopper_data.walls import Wall

_NEEDED, _WALL = ("geometry", "delta", "half-angle"), ("mu", "phi")
_OPTIONAL = {"model": "mohr-coulomb", "disturbances": ""}


class ListError(HopperError):
    """A list of hoppers cannot be read; the message names the file, and row and column."""


@dataclass(frozen=True)
class HopperList:
    """The titles of a list and its rows as they stand, with the titles that are options."""

    titles: tuple[str, ...]
    rows: tuple[dict[str, str], ...]
    options: Mapping[str, str]

    __repr__ = brief("titles")

    def material(self, row: int) -> tuple[str, str]:
        """Return the cells of geometry and delta of a row."""
        cells = self.rows[row]
        return cells[self.options["geometry"]], cells[self.options["delta"]]

    def case(self, row: int) -> tuple[Case, Disturbances | None]:
        """Return the hopper of a row, and the disturbances it asks for.

        Raises
        ------
        ListError
            If a cell is wrong; the message names its column and the remedy.
        """
        cells = {option: self.rows[row][title].strip() for option, title in self.options.items()}
        known = {name: cells.get(name) or default for name, default in _OPTIONAL.items()}
        delta, half_angle = (_number(cells, name) for name in ("delta", "half-angle"))
        given = [name for name in _WALL if cells.get(name)]
        if len(given) != 1:
            raise ListError("give one of the columns mu and phi in this row")
        friction = _number(cells, given[0])
        wall = Wall.of(mu=friction) if given == ["mu"] else Wall.of(phi_deg=friction)
        case = Case(cells["geometry"], known["model"], delta, half_angle, wall)
        try:
            case.hopper  # noqa: B018 - its values are checked
        except InvalidParameterError as error:
            raise ListError(str(error)) from None
        return case, _disturbances(known["disturbances"])


def read_hoppers(path: Path) -> HopperList:
    """Return the hoppers of a CSV file with a row of titles.

    Raises
    ------
    ListError
        If it cannot be read, is empty, or a column is missing or there twice.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            titles, *rows = [row for row in csv.reader(file) if any(row)] or [[]]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ListError(f"{path} cannot be read: {error}") from None
    if not rows:
        raise ListError(f"{path} has no hoppers: give a row of titles and a row for each hopper")
    twice = sorted({title for title in titles if titles.count(title) > 1})
    if twice:
        raise ListError(f"{path} has the column {twice[0]!r} twice: rename one")
    options = {_option(title): title for title in titles}
    missing = [name for name in _NEEDED if name not in options]
    if not missing and not options.keys() & set(_WALL):
        missing = ["mu or phi"]
    if missing:
        raise ListError(f"{path} has no column {missing[0]}: name it in the first row")
    for number, row in enumerate(rows, 2):
        if len(row) != len(titles):
            raise ListError(
                f"{path}, row {number} has {len(row)} cells, the titles are {len(titles)}: "
                "a comma too many, or too few"
            )
    known = {name: options[name] for name in (*_NEEDED, *_WALL, *_OPTIONAL) if name in options}
    dictionaries = tuple(dict(zip(titles, row, strict=True)) for row in rows)
    return HopperList(tuple(titles), dictionaries, known)


def _option(title: str) -> str:
    return title.strip().lower().replace("_", "-").removesuffix("-deg")


def _disturbances(cell: str) -> Disturbances | None:
    known: dict[str, Disturbances | None] = {"": None, "symmetric": "symmetric", "any": "any"}
    if cell not in known:
        raise ListError(f"column disturbances: {cell!r} is unknown: use symmetric or any")
    return known[cell]


def _number(cells: Mapping[str, str], name: str) -> float:
    cell = cells[name]
    try:
        value = float(cell)
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise ListError(f"column {name}: {cell!r} is no number: give one with a decimal point")
    return value


def harmless(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula; numbers are none."""
    if not text.startswith(("=", "+", "-", "@", "\t", "\r")):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text
