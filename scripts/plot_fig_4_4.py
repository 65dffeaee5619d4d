"""Figures 4.4 and 4.4 for another half angle: influence of wall friction on stability."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(
    wedge: str,
    cone: str,
    wedge_second: str | None = None,
    cone_second: str | None = None,
    *,
    half_angle_deg: float,
) -> Figure:
    """Plot max Re(lambda) over mu, wedge left, cone right, a curve for each delta."""
    rows = [(wedge, cone)]
    if wedge_second and cone_second:
        rows.append((wedge_second, cone_second))
    figure, axes = plotting.subplots(len(rows), 2, height=0.7 + 2.6 * len(rows), squeeze=False)
    for axis, path in zip(axes.flat, [path for row in rows for path in row], strict=True):
        data = artifacts.read(path)
        for delta, color in zip(data.delta.values, _COLORS, strict=False):
            _draw_curve(axis, data.sel(delta=delta), color, rf"$\delta$ = {delta:g}°")
        axis.axhline(0, color="0.5", linewidth=0.6)
        axis.set_xlim(0, 1.02 * float(data.mu.max()))
    for axis, geometry in zip(axes[0], ("wedge", "cone"), strict=True):
        axis.set_title(rf"{geometry}, $\vartheta_w$ = {half_angle_deg:g}°")
    for axis in axes[-1]:
        axis.set_xlabel(r"coefficient of wall friction $\mu$")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"max Re $\lambda$")
    for style in _LEGEND:
        axes[0, 0].plot([], [], **style)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _draw_curve(axis: Axes, data: xr.Dataset, color: str, label: str) -> None:
    """Solid where a mode governs, dashed where the line does; a bar at the limit of friction."""
    mu, abscissa = data.mu.values, data.abscissa_symmetric.values
    by_line = data.line.values >= abscissa
    axis.plot(mu, np.where(by_line, np.nan, abscissa), "-", color=color, label=label)
    # A segment between the two kinds belongs to the line: the curves must not have gaps.
    reach = by_line | np.roll(by_line, 1) | np.roll(by_line, -1)
    axis.plot(mu, np.where(reach, abscissa, np.nan), "--", color=color)
    axis.plot(mu, data.abscissa_asymmetric, ":", color=color)
    if float(data.limit_mu) <= mu[-1] * (1 + 1e-9):
        last = abscissa[np.isfinite(abscissa)][-1]
        axis.plot(data.limit_mu, last, "|", color=color, markersize=9, mew=1.6)
    if "check_mu" in data:
        circles = {"marker": "o", "markersize": 3.2, "mfc": "none", "mew": 0.7, "linewidth": 0.5}
        axis.plot(data.check_mu, data.check_as_worded, color=color, **circles)
        axis.plot(data.check_mu, data.check_physical, "x", color=color, markersize=3.2, mew=0.8)


_COLORS = (plotting.BLUE, plotting.ORANGE, plotting.GREEN, plotting.PURPLE, plotting.AMBER)
_LEGEND = (
    {"color": "0.3", "linestyle": "-", "label": "governed by a mode"},
    {"color": "0.3", "linestyle": "--", "label": r"governed by the line $\Lambda$"},
    {"color": "0.3", "linestyle": ":", "label": "asymmetric disturbances of wedges"},
    {"color": "0.3", "linestyle": "", "marker": "|", "markersize": 9, "label": "limit of friction"},
    {
        "color": "0.3",
        "linewidth": 0.5,
        "marker": "o",
        "markersize": 3.2,
        "mfc": "none",
        "label": "paper's algorithm",
    },
    {
        "color": "0.3",
        "linestyle": "",
        "marker": "x",
        "markersize": 3.2,
        "label": "same, the flow's parity, resolved",
    },
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
