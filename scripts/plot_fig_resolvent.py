"""Resolvent norm along the imaginary axis, and the Kreiss bound against the measured growth."""

from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(wedge_paper: str, cone_paper: str, wedge_physical: str, cone_physical: str) -> Figure:
    """Plot the resolvent (top) and the relative growth with its Kreiss bound (bottom)."""
    figure, axes = plotting.subplots(2, 2, height=5.4, sharey="row")
    paths = ((wedge_paper, wedge_physical), (cone_paper, cone_physical))
    for column, (geometry, both) in enumerate(zip(plotting.GEOMETRIES, paths, strict=True)):
        top, bottom = axes[:, column]
        for path, color in zip(both, _COLORS, strict=True):
            _draw_case(top, bottom, reading.read(path), {"color": color, "linewidth": 0.8})
        data = reading.read(both[0])
        verdict = "stability" if data.eigenvalue.to_numpy().real.max() > 0 else "instability"
        near = [f"{float(reading.read(path).distance):.2g}" for path in both]
        top.set_title(f"{geometry}: distance to {verdict} {near[0]} (paper), {near[1]} (physical)")
        top.set_xlabel(r"$y$")
        top.set_xlim(0, float(data.frequency.max()))
        bottom.set_title(f"{geometry}: growth on the kept modes")
        bottom.set_xlabel(r"$-t = -\log r$")
        bottom.set_xlim(0, float(data.elapsed.max()))
    axes[0, 0].set_ylabel(r"$\|(iy - M)^{-1}\|$")
    axes[1, 0].set_ylabel(r"$\|\exp(-t M)\|\, e^{t\alpha}$")
    plotting.below(figure, _KEYS, 3)
    return figure


def _draw_case(top: Axes, bottom: Axes, data: xr.Dataset, look: dict[str, Any]) -> None:
    top.semilogy(data.frequency, data.resolvent, **look)
    top.semilogy(data.frequency, data.resolvent_kept, linestyle="--", **look)
    bottom.semilogy(data.elapsed, data.relative_growth, **look)
    bottom.axhline(float(data.kreiss_bound), linestyle=":", **{**look, "linewidth": 1.2})


_COLORS = (plotting.BLACK, plotting.ORANGE)
_KEYS = (
    plotting.key("paper's formulation", color=_COLORS[0], linewidth=3),
    plotting.key("full matrix; growth", color="0.4"),
    plotting.key("kept modes alone", color="0.4", linestyle="--"),
    plotting.key("physical formulation", color=_COLORS[1], linewidth=3),
    plotting.key("Kreiss bound of the growth", color="0.4", linestyle=":"),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
