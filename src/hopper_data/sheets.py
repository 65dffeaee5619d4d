"""A table of answers as a netCDF file."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from hopper_data import cf
from hopper_data.contents import CfDataset, CfVariable


def write(path: Path, titles: Sequence[str], rows: Sequence[Mapping[str, Any]]) -> None:
    """Write a variable over ``row`` for each title: numbers where all cells are, else texts."""
    variables: dict[str, CfVariable] = {
        title: (("row",), _column([row[title] for row in rows]), {}) for title in titles
    }
    cf.write(
        CfDataset(variables, {}, {}),
        path,
        title="Answers about a list of hoppers",
        equations="(2.8)-(2.15), (3.1)-(3.5), (4.1), (4.2)",
        parameters={"rows": len(rows)},
    )


def _column(cells: list[Any]) -> Any:
    try:
        return np.array([np.nan if cell in (None, "") else float(cell) for cell in cells])
    except ValueError:
        return np.array(["" if cell is None else str(cell) for cell in cells])
