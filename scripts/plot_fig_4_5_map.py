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

from hopper_workflow import domains, jobs, plotting, reading

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
        whole, known = reading.read(path), reading.read(border)
        data = domains.thinned(whole, _MOST)
        # Beyond its end each row is continued: what lies there is drawn over it, with its border.
        continued = data.abscissa.to_pandas().bfill(axis=1).ffill(axis=1)
        mesh = _cells(axis, data, continued, cmap=_CMAP, norm=norm)
        _mark_undecided(axis, data, known)
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


def _mark_undecided(axis: Axes, data: xr.Dataset, known: xr.Dataset) -> None:
    """Grey, by reason, wherever there is no verdict; white where the wall is rougher than delta."""
    delta, limit = known.delta.values, np.nan_to_num(known.limit_phi.values)
    axis.fill_between(delta, limit, delta, color="0.80", lw=0, label="no radial solution")
    least = known.positive_stress_phi.to_numpy()
    least = np.where(np.isnan(least), limit, least)
    if least.any():
        axis.fill_between(delta, 0, least, color="0.62", lw=0, label="stress not positive")
    axis.fill_between(delta, delta, 90, color="white", lw=0)
    unresolved = np.where(data.region == "not_converged", 1.0, np.nan)
    if np.isfinite(unresolved).any():
        _cells(axis, data, unresolved, cmap=ListedColormap(["0.3"]))
        axis.fill([], [], color="0.3", label="not resolved")


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
