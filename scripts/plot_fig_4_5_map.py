"""Figure 4.5 as a map: max Re(lambda) over internal and wall friction."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, SymLogNorm
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from hopper_workflow import artifacts, domains, jobs, plotting

# A panel has fewer pixels; every cell more costs memory and time.
_MOST = 1000


def draw(
    maps: Sequence[str],
    borders: Sequence[str],
    *,
    panels: Sequence[str],
    color_range: Sequence[float],
) -> Figure:
    """Plot one panel for each geometry and half angle, with the borders over the map."""
    linear, largest = color_range
    norm = SymLogNorm(linear, vmin=-largest, vmax=largest)
    figure, axes = plotting.subplots(2, 2, height=5.9, sharex=True, sharey=True)
    for axis, path, border, title in zip(axes.flat, maps, borders, panels, strict=True):
        whole = artifacts.read(path)
        data = domains.thinned(whole, _MOST)
        _mark_undecided(axis, data)
        mesh = _cells(axis, data, data.abscissa, cmap="RdBu_r", norm=norm)
        known = artifacts.read(border)
        domains.hatch_unreached(axis, known)
        domains.draw_borders(axis, known)
        axis.set_xlim(float(whole.delta.min()), float(whole.delta.max()))
        axis.set_ylim(0, float(whole.phi.max()))
        axis.set_title(title)
    for axis in axes[1]:
        axis.set_xlabel(r"angle of internal friction $\delta$ (degrees)")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"angle of wall friction $\phi$ (degrees)")
    figure.colorbar(
        mesh,
        ax=axes,
        label=r"max Re $\lambda$ (red: unstable, blue: stable)",
        shrink=0.7,
        extend="both",
    )
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _cells(axis: Axes, data: xr.Dataset, values: ArrayLike, **style: Any) -> QuadMesh:
    """Colour the cells around the points of a map."""
    return axis.pcolormesh(
        data.delta, data.phi, np.asarray(values).T, shading="nearest", rasterized=True, **style
    )


def _mark_undecided(axis: Axes, data: xr.Dataset) -> None:
    """Grey, by reason, wherever there is no verdict."""
    for name, (color, label) in _GREYS.items():
        mask = np.where(data.region == name, 1.0, np.nan)
        _cells(axis, data, mask, cmap=ListedColormap([color]))
        axis.fill([], [], color=color, label=label)


_GREYS = {
    "no_radial_solution": ("0.93", "no radial solution"),
    "non_positive_stress": ("0.7", "stress not positive"),
    "not_converged": ("0.3", "not resolved"),
}

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
