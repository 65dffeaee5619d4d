"""Figure 4.4 and others of its kind: influence of wall friction on stability."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


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
    figure, axes = plotting.subplots(len(rows), 2, height=1.0 + 2.6 * len(rows), squeeze=False)
    for axis, path in zip(axes.flat, [path for row in rows for path in row], strict=True):
        data = reading.read(path)
        for delta, color in zip(data.delta.values, _colors(data), strict=True):
            _draw_curve(axis, data.sel(delta=delta), color)
            _name_curve(axis, data.sel(delta=delta), color, rf"$\delta$ = {delta:g}°")
        axis.axhline(0, color="0.5", linewidth=0.6)
        last = float(np.nanmax([data.mu.max(), data.limit_mu.where(_reached(data)).max()]))
        axis.set_xlim(0, 1.03 * last)
        axis.margins(y=0.1)
        axis.set_xlabel(r"coefficient of wall friction $\mu$")
    for axis, geometry in zip(axes[0], plotting.GEOMETRIES, strict=True):
        axis.set_title(rf"{geometry}, $\vartheta_w$ = {half_angle_deg:g}°, physical formulation")
    for axis, geometry in zip(axes[1:].flat, plotting.GEOMETRIES, strict=False):
        axis.set_title(f"{geometry}, physical formulation, up to the limit of friction")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"max Re $\lambda$")
    drawn = {line.get_marker() for axis in axes.flat for line in axis.lines}
    plotting.below(figure, [key for key in _KEYS if key.get_marker() in drawn], 3)
    return figure


def _colors(data: xr.Dataset) -> list[object]:
    return plotting.sequence(data.sizes["delta"])


def _reached(data: xr.Dataset) -> xr.DataArray:
    """Where a curve runs up to the limit of friction."""
    return data.limit_mu <= data.mu.max("point") * (1 + 1e-9)


def _draw_curve(axis: Axes, data: xr.Dataset, color: object) -> None:
    """Solid where a mode is the largest, dashed where the line is; a bar at the limit."""
    mu, abscissa = data.mu.values, data.abscissa_symmetric.values
    by_line = data.line.values >= abscissa
    axis.plot(mu, np.where(by_line, np.nan, abscissa), "-", color=color)
    # A segment between the two kinds belongs to the line: the curves must not have gaps.
    reach = by_line | np.roll(by_line, 1) | np.roll(by_line, -1)
    axis.plot(mu, np.where(reach, abscissa, np.nan), "--", color=color)
    axis.plot(mu, data.abscissa_asymmetric, ":", color=color)
    if bool(_reached(data)):
        (known,) = np.nonzero(np.isfinite(abscissa))
        end = [mu[known[-1]], float(data.limit_mu)], [abscissa[known[-1]]] * 2
        axis.plot(*end, color=color, linewidth=0.5)
        axis.plot(end[0][1], end[1][1], "|", color=color, markersize=9, mew=1.6)
    if "check_mu" in data:
        circles = {"marker": "o", "markersize": 3.2, "mfc": "none", "mew": 0.7, "linewidth": 0.4}
        axis.plot(data.check_mu, data.check_as_worded, color=color, **circles)
        axis.plot(data.check_mu, data.check_physical, "x", color=color, markersize=3.2, mew=0.8)


def _name_curve(axis: Axes, data: xr.Dataset, color: object, name: str) -> None:
    """Write the angle below the middle of its curve: others of the same angle lie above."""
    abscissa = data.abscissa_symmetric.values
    (known,) = np.nonzero(np.isfinite(abscissa))
    middle = int(np.searchsorted(data.mu, _NAMED * float(data.mu[known[-1]])))
    falling = abscissa[middle + 1] < abscissa[middle]
    axis.annotate(
        name,
        (float(data.mu[middle]), abscissa[middle]),
        (0, -3),
        textcoords="offset points",
        ha="right" if falling else "left",
        va="top",
        fontsize=plotting.SMALL,
        color=color,
        bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.1},
    )


# Part of its length at which a curve is named.
_NAMED = 0.55
_KEYS = (
    plotting.key("a mode is the largest"),
    plotting.key(r"the line $\Lambda$ is the largest", linestyle="--"),
    plotting.key("wedge: asymmetric disturbances", linestyle=":"),
    plotting.key("limit of friction (thin: not resolved)", marker="|", markersize=9, linewidth=0.5),
    plotting.key("paper's formulation", marker="o", markersize=3.2, mfc="none", linewidth=0.4),
    plotting.key("the same, the flow's parity, resolved", marker="x", markersize=3.2, linestyle=""),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
