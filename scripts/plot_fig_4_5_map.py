"""Figure 4.5 as a map: max Re(lambda) over internal and wall friction."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LinearSegmentedColormap, ListedColormap, SymLogNorm
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from hopper_workflow import artifacts, domains, jobs, plotting

# A panel has fewer pixels; every cell more costs memory and time.
_MOST = 1000
# Panels that are drawn two in a row, more four.
_FEW = 6
# Lightness grows with the value and jumps at zero: signs differ in grey as well.
_CMAP = LinearSegmentedColormap.from_list(
    "signs", [(0, "#08306B"), (0.5, "#6BAED6"), (0.5, "#FDBE6F"), (1, "#FFF7E0")]
)


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
    most = 2 if len(maps) <= _FEW else 4
    figure, axes = plotting.grid(len(maps), most, height=2.5, sharex=True, sharey=True)
    for axis, path, border, title in zip(axes, maps, borders, panels, strict=True):
        whole = artifacts.read(path)
        data = domains.thinned(whole, _MOST)
        _mark_undecided(axis, data)
        mesh = _cells(axis, data, data.abscissa, cmap=_CMAP, norm=norm)
        known = artifacts.read(border)
        domains.hatch_unreached(axis, known)
        domains.draw_borders(axis, known)
        axis.set_xlim(float(whole.delta.min()), float(whole.delta.max()))
        axis.set_ylim(0, float(whole.phi.max()))
        domains.name_regions(axis, known)
        axis.set_title(title)
        if axis.get_subplotspec().is_first_col():
            axis.set_ylabel(r"wall friction $\phi$ (degrees)")
    for axis in axes[-most:]:
        axis.set_xlabel(r"internal friction $\delta$ (degrees)")
    figure.colorbar(
        mesh,
        ax=axes,
        label=r"max Re $\lambda$, physical formulation (stable below 0)",
        shrink=0.7,
        extend="both",
    )
    plotting.below(figure, plotting.all_keys(axes), 3)
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
        if np.isnan(mask).all():
            continue
        _cells(axis, data, mask, cmap=ListedColormap([color]))
        axis.fill([], [], color=color, label=label)


_GREYS = {
    "no_radial_solution": ("0.80", "no radial solution"),
    "non_positive_stress": ("0.62", "stress not positive"),
    "not_converged": ("0.3", "not resolved"),
}

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
