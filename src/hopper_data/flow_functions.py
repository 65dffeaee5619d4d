"""Flow functions of materials as people measure them: a CSV file of stresses in kPa."""

import csv
from pathlib import Path

import numpy as np

from hopper.design.outlet import FlowFunction, flow_function
from hopper.errors import InvalidParameterError

COLUMNS = ("sigma_1", "f_c")


def read_flow_function(path: Path) -> FlowFunction:
    """Return the flow function of a CSV file with columns sigma_1 and f_c, in kPa.

    Raises
    ------
    InvalidParameterError
        If it cannot be read, a column is missing, or a cell is no stress; the message names row
        and column.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InvalidParameterError(f"{path} cannot be read: {error}") from None
    if not rows:
        raise InvalidParameterError(f"{path} has no rows: give {', '.join(COLUMNS)} in kPa")
    missing = [name for name in COLUMNS if name not in rows[0]]
    if missing:
        raise InvalidParameterError(f"{path} has no column {missing[0]}: name it in the first row")
    stresses = np.array(
        [[_stress(path, i, name, row[name]) for name in COLUMNS] for i, row in enumerate(rows, 2)]
    )
    try:
        return flow_function(stresses[:, 0], stresses[:, 1])
    except InvalidParameterError as error:
        raise InvalidParameterError(f"{path}: {error}") from None


def _stress(path: Path, row: int, column: str, cell: str | None) -> float:
    try:
        value = float(cell or "")
    except ValueError:
        value = -1.0
    if not 0 <= value < np.inf:
        raise InvalidParameterError(
            f"{path}, row {row}, column {column}: {cell!r} is no stress: give kPa, 0 or more, with "
            "a decimal point"
        )
    return value
