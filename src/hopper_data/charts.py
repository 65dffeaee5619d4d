"""Design charts of one geometry as a table: charts of several internal frictions side by side."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from hopper.design.charts import Chart
from hopper_data.tables import Table, Variable, angle, number

_LIMITS = {
    "classical": "wall friction at which the stress on the axis vanishes, mass flow of cones",
    "limit": "largest wall friction with a radial solution",
    "velocity": "wall friction at which the largest psi is 45 degrees, mass flow of wedges",
    "stability": "largest wall friction that is stable",
    "stable_from": "least wall friction of that stable interval, NaN where smoother walls are too",
}


def _with_error(name: str, words: str) -> tuple[Variable, Variable]:
    return (
        angle(f"{name}_phi", words, "delta point", f"{name}.friction_angle"),
        angle(f"{name}_error", f"error estimate of {name}_phi", "delta point", f"{name}.error"),
    )


CHARTS: Table = (
    angle("half_angle", "half opening angle, NaN beyond the last", "delta point"),
    *(one for name, words in _LIMITS.items() for one in _with_error(name, words)),
    angle(
        "phi", "wall friction, from 0 to the limit of mass flow", "delta point wall",
        "friction_angle",
    ),
    number("flow_factor", "flow factor there", "delta point wall"),
)  # fmt: skip


def side_by_side(charts: Sequence[Chart]) -> dict[str, Any]:
    """Return charts stacked, as :data:`CHARTS` describes; the shorter ones end with NaN."""
    longest = max(chart.half_angle.size for chart in charts)

    def stacked(path: Sequence[str]) -> np.ndarray:
        rows = []
        for chart in charts:
            found: Any = chart
            for name in path:
                found = getattr(found, name)
            more = ((0, longest - len(found)), *[(0, 0)] * (found.ndim - 1))
            rows.append(np.pad(found, more, constant_values=np.nan))
        return np.array(rows)

    sources = [(variable.source or variable.name).split(".") for variable in CHARTS]
    result: dict[str, Any] = {}
    for path in sources:
        inner = result
        for name in path[:-1]:
            inner = inner.setdefault(name, {})
        inner[path[-1]] = stacked(path)
    return result
