"""Pseudospectrum of M, which the paper used and did not print."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(
    wedge_paper: str,
    cone_paper: str,
    wedge_physical: str,
    cone_physical: str,
    *,
    levels_log10: Sequence[float],
    norms: dict[str, str],
) -> Figure:
    """Plot contours of sigma_min(z I - M), labelled in powers of ten, with the eigenvalues."""
    levels = sorted(levels_log10)
    norm = plotting.level_norm(levels)
    figure, axes = plotting.subplots(2, 2, height=6.2, sharex=True, sharey=True)
    paths = ((wedge_paper, cone_paper), (wedge_physical, cone_physical))
    for row, mode in enumerate(("paper", "physical")):
        for column, geometry in enumerate(("wedge", "cone")):
            axis = axes[row, column]
            _draw_contours(axis, artifacts.read(paths[row][column]), levels, norm)
            axis.set_title(f"{geometry}, {mode} mode, {_NORMS[norms[mode]]} norm")
    for axis in axes[1]:
        axis.set_xlabel(r"Re $z$")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"Im $z$")
    plotting.level_bar(figure, axes, _CMAP, norm, levels, r"$\varepsilon = \sigma_{\min}(zI - M)$")
    return figure


def _draw_contours(axis: Axes, data: xr.Dataset, levels: Sequence[float], norm: Normalize) -> None:
    # A grid point on an eigenvalue may have the value 0.
    height = np.log10(np.maximum(data.sigma_min, np.finfo(float).tiny))
    plane, look = (data["real"], data["imag"], height), {"levels": levels, "cmap": _CMAP}
    axis.contourf(*plane, norm=norm, extend="both", alpha=0.45, **look)
    axis.contour(*plane, norm=norm, linewidths=0.8, **look)
    values = data.eigenvalue.to_numpy()
    axis.plot(values.real, values.imag, "k.", markersize=2.5)
    axis.axvline(0, color="0.5", linewidth=0.6)
    axis.set_xlim(data["real"][0], data["real"][-1])
    axis.set_ylim(data["imag"][0], data["imag"][-1])


_CMAP = "viridis"
_NORMS = {"discrete": "discrete", "L2": "$L_2$"}

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
