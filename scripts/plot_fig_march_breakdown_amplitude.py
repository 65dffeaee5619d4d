"""Depth of breakdown over the amplitude of the top, beside geometric optics."""

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str, depth: float) -> Figure:
    """Plot tau of the first crossing, a panel for each hopper."""
    data = reading.read(artifact)
    figure, axes = plotting.grid(data.sizes["hopper"], 2, height=2.7, sharey=True, sharex=True)
    for index, axis in enumerate(axes):
        _draw_hopper(axis, data.isel(hopper=index), depth)
    for axis in axes[::2]:
        axis.set_ylabel(r"depth $\tau_b$ of the first crossing")
    plotting.below(figure, plotting.all_keys(axes), 3)
    return figure


def _draw_hopper(axis: Axes, data: xr.Dataset, depth: float) -> None:
    none = data.eps.where(data.breakdown_kind == "none", drop=True)
    broken = data.eps.where(data.breakdown_kind == "crossing", drop=True)
    if none.size and broken.size and none.max() < broken.min():
        axis.axvspan(none.max(), broken.min(), color="0.88", label="threshold in between")
    axis.loglog(data.eps, data.breakdown_tau, "o", color=plotting.BLUE, label="first crossing")
    axis.loglog(data.estimate_eps, data.estimate, color=plotting.ORANGE, label="geometric optics")
    axis.loglog(none, [depth] * none.size, "v", mfc="none", color="0.3", label=f"none to {depth:g}")
    threshold = float(data.threshold)
    if threshold > 0:
        axis.axvline(threshold, color="black", linestyle=":", label="threshold of short waves")
    line = plotting.signed(float(data.line), ".3g")
    axis.set_title(rf"{data.hopper.item()}, $\Lambda$ = {line}")
    axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.yaxis.set_minor_locator(NullLocator())
    axis.set_xticks(data.eps, [f"{size:g}" for size in data.eps.to_numpy()], minor=False)
    axis.set_xticks([], minor=True)
    axis.set_xlabel(r"amplitude $\epsilon$ of the top")


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
