"""How far below the top the stress is radial, over hoppers and tops."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(artifact: str) -> Figure:
    """Plot r where the stress is radial to 5 and 1 %, or breaks, a panel for each top."""
    data = artifacts.read(artifact)
    height = 0.9 + 0.19 * data.sizes["hopper"]
    figure, axes = plotting.grid(data.sizes["top"], 3, height=height, sharey=True, sharex=True)
    for index, axis in enumerate(axes):
        _draw_top(axis, data.isel(top=index))
    for axis in axes[-min(3, len(axes)) :]:
        axis.set_xlabel(r"$r/r_\mathrm{top}$")
    plotting.below(figure, _KEYS, 3)
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
_KEYS = (
    plotting.key("within 5 % for good", linestyle="", **_LEVELS[0]),
    plotting.key("within 1 % for good", linestyle="", **_LEVELS[1]),
    plotting.key("characteristics cross", linestyle="", **_ENDS["crossing"]),
    plotting.key("characteristic tangent to an arc", linestyle="", **_ENDS["tangency"]),
    plotting.key("a kink breaks", linestyle="", **_ENDS["kink"]),
    plotting.key("march not trusted", linestyle="", **_ENDS["not_trusted"]),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
