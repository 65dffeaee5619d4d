"""Figure 4.3 in several norms: which part of the oscillation belongs to the norm."""

from itertools import product
from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(wedge: str, cone: str) -> Figure:
    """Plot the growth relative to exp(-t alpha), a row for each formulation."""
    panels = [reading.read(path) for path in (wedge, cone)]
    rows = panels[0].sizes["kept_in"]
    figure, axes = plotting.subplots(
        rows, 2, height=0.8 + 2.1 * rows, sharex=True, sharey="row", squeeze=False
    )
    for column, (data, title) in enumerate(zip(panels, plotting.GEOMETRIES, strict=True)):
        for row, formulation in enumerate(data["kept_in"].values):
            axis = axes[row, column]
            _draw_curves(axis, data.isel(kept_in=row))
            axis.set_title(f"{title}, {formulation} formulation")
            axis.set_xlim(0, float(data.elapsed.max()))
        axes[-1, column].set_xlabel(r"$-t = -\log r$")
    for axis in axes[:, 0]:
        axis.set_ylim(bottom=0.9)
        axis.set_ylabel(r"$\|\exp(-t M)\|\, e^{t\alpha}$")
    plotting.below(figure, [plotting.key(**look) for look in _looks(panels[0])], 2)
    return figure


def _draw_curves(axis: Axes, case: xr.Dataset) -> None:
    choices = product(range(case.sizes["norm"]), range(case.sizes["psi_scale"]))
    for (norm, scale), look in zip(choices, _looks(case), strict=True):
        here = case.isel(norm=norm, psi_scale=scale).dropna("elapsed")
        axis.semilogy(here.elapsed, here.growth / here.lower_bound, **look)


def _looks(data: xr.Dataset) -> list[dict[str, Any]]:
    """Return a look for each norm and weight of psi: colour and width, and dashes."""
    return [
        {
            "color": _COLORS[str(norm)],
            "linestyle": style,
            "linewidth": 0.7,
            "label": f"{plotting.NORM_NAMES[str(norm)]}, {_unknowns(float(scale))}",
        }
        for norm in data.norm.values
        for scale, style in zip(data.psi_scale.values, _DASHES, strict=False)
    ]


def _unknowns(scale: float) -> str:
    known = {1.0: ", as defined", 2.0: ", as (4.1) is printed"}.get(scale, "")
    over = rf"\psi_1/{scale:g}" if scale != 1 else r"\psi_1"
    return rf"unknowns $(\sigma_1, {over})${known}"


_COLORS = {"discrete": plotting.BLACK, "L2": plotting.ORANGE}
_DASHES = ("-", (0, (3, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)))

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
