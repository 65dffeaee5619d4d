"""Stress at the top of a march, read from a file of one's own."""

import csv
from collections.abc import Mapping
from math import pi
from pathlib import Path

import numpy as np

from hopper.arrays import Array
from hopper.errors import HopperError, InvalidParameterError
from hopper.march.tops import Top, profile
from hopper_data.tops import NAMED, named_top

SUFFIXES = (".csv", ".nc")
# Columns with the units they have unless others are given, those of `hopper radial --profile`.
_COLUMNS = {"theta": "degree", "sigma": "rho g r", "psi": "radian"}
_DEGREES, _RADIANS = ("degree", "degrees", "deg", "°"), ("radian", "radians", "rad")
_STRESS = ("rho g r", "1", "")


def top_of(name: str, eps: float | None = None, factor: float | None = None) -> Top:
    """Return a top by its name, as :func:`hopper_data.tops.named_top`, or the one of a file.

    Raises
    ------
    HopperError
        If the number is no number for it, or the file no stress.
    """
    return named_top(name, eps, factor) if name in NAMED else read_top(Path(name))


class TopFileError(InvalidParameterError):
    """A file is no stress at the top; the one-line message names the file and the remedy."""


def read_top(path: Path) -> Top:
    """Return the top that a file holds.

    A table (.csv) has the columns ``theta``, ``sigma`` (average stress over rho g r) and ``psi``,
    each with its unit in brackets: ``theta [degree]`` and ``psi [radian]`` unless it says another.
    In netCDF they are variables of these names with the attribute ``units``. theta goes from 0, or
    from -theta_w, to theta_w.

    Raises
    ------
    TopFileError
        If the file cannot be read, or is no profile.
    """
    try:
        columns = _table(path) if path.suffix.lower() == ".csv" else _dataset(path)
        fields = [_in_units(path, name, *columns[name]) for name in _COLUMNS]
        return profile(*fields)
    except OSError as error:
        reason = error.strerror or "it is not a netCDF file"
        raise TopFileError(f"{path} cannot be read: {reason}") from None
    except TopFileError:
        raise
    except (HopperError, UnicodeDecodeError, csv.Error) as error:
        raise TopFileError(f"{path}: {error}") from None


def _table(path: Path) -> dict[str, tuple[Array, str]]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        header, *rows = [row for row in csv.reader(file) if row] or [[]]
    names, units = [], []
    for title in header:
        name, _, unit = title.partition("[")
        names.append(name.strip())
        units.append(unit.strip(" ]"))
    _require_columns(path, names)
    found = {}
    for name, unit in zip(names, units, strict=True):
        if name in _COLUMNS:
            place = names.index(name)
            found[name] = _numbers(path, name, [row[place : place + 1] for row in rows]), unit
    return found


def _numbers(path: Path, name: str, cells: list[list[str]]) -> Array:
    values = np.empty(len(cells))
    for i, cell in enumerate(cells):
        try:
            values[i] = float(cell[0])
        except (ValueError, IndexError):
            wrong = repr(cell[0]) if cell else "missing"
            raise TopFileError(
                f"{path}: {name} in row {i + 1} is {wrong}: give a number in every row"
            ) from None
    return values


def _dataset(path: Path) -> dict[str, tuple[Array, str]]:
    from hopper_data import reading  # tables need no xarray

    data = reading.open_stored(path)
    _require_columns(path, [str(name) for name in data.variables])
    return {
        name: (
            np.ravel(data[name].to_numpy()).astype(float),
            str(data[name].attrs.get("units", "")),
        )
        for name in _COLUMNS
    }


def _require_columns(path: Path, names: list[str]) -> None:
    for name, unit in _COLUMNS.items():
        if names.count(name) != 1:
            state = "has no" if name not in names else "has more than one"
            wanted = " or ".join(dict.fromkeys([name, f"{name} [{unit}]"]))
            raise TopFileError(f"{path} {state} column {name}: give one with the title {wanted}")


def _in_units(path: Path, name: str, values: Array, unit: str) -> Array:
    """Return a column in radians, or in units of rho g r."""
    known: Mapping[str, float] = (
        dict.fromkeys(_STRESS, 1.0)
        if name == "sigma"
        else dict.fromkeys(_DEGREES, pi / 180) | dict.fromkeys(_RADIANS, 1.0)
    )
    factor = known.get(unit or _COLUMNS[name])
    if factor is None:
        use = "rho g r" if name == "sigma" else "degree or radian"
        raise TopFileError(f"{path}: {name} is in {unit!r}: give it in {use}")
    if not np.isfinite(values).all():
        row = int(np.flatnonzero(~np.isfinite(values))[0]) + 1
        raise TopFileError(f"{path}: {name} in row {row} is not finite: remove the row")
    return factor * values
