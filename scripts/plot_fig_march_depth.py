"""How far below the top the stress is radial, over hoppers and tops."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str) -> Figure:
    """Plot r where the stress is radial to 5 and 1 %, or breaks, a panel for each top."""
    data = reading.read(artifact)
    height = 0.9 + 0.19 * data.sizes["hopper"]
    figure, axes = plotting.grid(data.sizes["top"], 3, height=height, sharey=True, sharex=True)
    for index, axis in enumerate(axes):
        _draw_top(axis, data.isel(top=index))
    for axis in axes[-min(3, len(axes)) :]:
        axis.set_xlabel(r"$r/r_\mathrm{top}$")
    plotting.below(figure, _keys({str(kind) for kind in data.breakdown_kind.to_numpy().flat}), 3)
    return figure


def _draw_top(axis: Axes, data: xr.Dataset) -> None:
    rows = np.arange(data.sizes["hopper"])
    end = data.end.where(data.breakdown_kind != "none")
    last = np.fmin(data.settled.min("level"), data.end)
    axis.hlines(rows, last, 1, color="0.75", linewidth=2.2)
    for level, look in zip(data.level.to_numpy(), _LEVELS, strict=False):
        axis.plot(data.settled.sel(level=level), rows, linestyle="", **look)
    for kind, look in _ENDS.items():
        axis.plot(end.where(data.breakdown_kind == kind), rows, linestyle="", **look)
    axis.set_xlim(1.03, 0)
    axis.set_ylim(rows[-1] + 0.6, -0.6)
    axis.set_yticks(rows, [str(name) for name in data.hopper.to_numpy()])
    axis.set_title(str(data.top.item()))


def _keys(kinds: set[str]) -> list[Line2D]:
    """Return the keys of what there is."""
    return [
        plotting.key(name, linestyle="", **look)
        for name, look in (
            ("within 5 % for good", _LEVELS[0]),
            ("within 1 % for good", _LEVELS[1]),
            *((_WORDS[kind], look) for kind, look in _ENDS.items() if kind in kinds),
        )
    ]


_WORDS = {
    "crossing": "characteristics cross",
    "tangency": "characteristic tangent to an arc",
    "kink": "a kink breaks",
    "not_trusted": "march not trusted",
}
_LEVELS: tuple[dict[str, Any], ...] = (
    {"marker": "o", "color": plotting.BLUE},
    {"marker": "o", "color": plotting.BLUE, "mfc": "white"},
)
_ENDS: dict[str, dict[str, Any]] = {
    "crossing": {"marker": "x", "color": plotting.ORANGE, "mew": 1.4},
    "tangency": {"marker": "d", "color": plotting.ORANGE},
    "kink": {"marker": "+", "color": plotting.BLACK, "mew": 1.4, "markersize": 6},
    "not_trusted": {"marker": "s", "color": plotting.BLACK, "mfc": "white"},
}

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
