"""Resolvent norm along the imaginary axis, and the Kreiss bound against the measured growth."""

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(wedge_paper: str, cone_paper: str, wedge_physical: str, cone_physical: str) -> Figure:
    """Plot the resolvent (top) and the relative growth with its Kreiss bound (bottom)."""
    figure, axes = plotting.subplots(2, 2, height=5.0)
    paths = (("wedge", wedge_paper, wedge_physical), ("cone", cone_paper, cone_physical))
    for column, (geometry, paper, physical) in enumerate(paths):
        top, bottom = axes[:, column]
        for mode, path, color in (
            ("paper", paper, plotting.BLUE),
            ("physical", physical, plotting.ORANGE),
        ):
            data = artifacts.read(path)
            _draw_mode(top, bottom, data, mode, {"color": color, "linewidth": 0.9})
        near = [float(artifacts.read(path).distance) for path in (paper, physical)]
        top.set_title(f"{geometry}: distance {near[0]:.2g} (paper), {near[1]:.2g} (physical)")
        top.set_xlabel(r"$y$")
        top.set_ylabel(r"$\|(iy - M)^{-1}\|$")
        top.set_xlim(0, float(data.frequency.max()))
        bottom.set_title(f"{geometry}: growth")
        bottom.set_xlabel(r"$-t = -\log r$")
        bottom.set_ylabel(r"$\|\exp(-t M)\|\, e^{t\alpha}$")
        bottom.set_xlim(0, float(data.elapsed.max()))
    for row, place in ((1, "outside lower center"), (0, "outside upper center")):
        figure.legend(*axes[row, 0].get_legend_handles_labels(), loc=place, ncols=4)
    return figure


def _draw_mode(top: Axes, bottom: Axes, data: xr.Dataset, mode: str, look: dict[str, Any]) -> None:
    dashed = {**look, "linestyle": "--"}
    top.semilogy(data.frequency, data.resolvent, label=f"{mode}, full matrix", **look)
    top.semilogy(data.frequency, data.resolvent_kept, label=f"{mode}, kept modes", **dashed)
    bottom.semilogy(data.elapsed, data.relative_growth, label=mode, **look)
    bottom.axhline(float(data.kreiss_bound), label=f"{mode}, Kreiss bound", **dashed)


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
