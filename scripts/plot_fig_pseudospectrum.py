"""Pseudospectrum of M, which the paper used and did not print."""

from collections.abc import Sequence

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from hopper_workflow import jobs, plotting, reading


def draw(
    panels: Sequence[str],
    spectra: Sequence[str],
    *,
    levels_log10: Sequence[float],
    formulations: Sequence[str],
    norms: Sequence[str],
) -> Figure:
    """Plot contours of sigma_min(z I - M), a row for each formulation, with the eigenvalues."""
    levels = sorted(levels_log10)
    rows = len(formulations)
    figure, axes = plotting.subplots(
        rows, 2, height=1.1 + 2.7 * rows, sharex=True, sharey=True, squeeze=False
    )
    kept = [reading.read(path) for path in spectra]
    for axis, path, index in zip(axes.flat, panels, range(2 * rows), strict=True):
        row, column = divmod(index, 2)
        mesh = _draw_contours(axis, reading.read(path), levels)
        _draw_eigenvalues(axis, reading.read(path), kept[column])
        axis.set_title(
            f"{plotting.GEOMETRIES[column]}, {formulations[row]} formulation, "
            f"{plotting.NORM_NAMES[norms[row]]}"
        )
    for axis in axes[-1]:
        axis.set_xlabel(r"Re $z$")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"Im $z$")
    bar = figure.colorbar(
        mesh,
        ax=axes,
        location="bottom",
        shrink=0.6,
        aspect=40,
        label=r"$\varepsilon = \sigma_{\min}(zI - M)$",
    )
    bar.set_ticks(levels, labels=[plotting.power_of_ten(level) for level in levels])
    rejected = any(line.get_marker() == "o" for axis in axes.flat for line in axis.lines)
    plotting.below(figure, _KEYS if rejected else _KEYS[:1], 2)
    return figure


def _draw_contours(axis: Axes, data: xr.Dataset, levels: Sequence[float]) -> object:
    # A grid point on an eigenvalue may have the value 0.
    height = np.log10(np.maximum(data.sigma_min, np.finfo(float).tiny))
    x, y = data["real"].to_numpy(), data["imag"].to_numpy()
    norm = BoundaryNorm(levels, 256, extend="both")
    filled = axis.contourf(x, y, height, levels=levels, cmap=_CMAP, norm=norm, extend="both")
    lines = axis.contour(x, y, height, levels=levels, colors="0.15", linewidths=0.5)
    lines.set(linestyle="-")
    for label in axis.clabel(lines, fmt=plotting.power_of_ten, fontsize=plotting.SMALL):
        label.set_path_effects(_HALO)
    axis.set_xlim(x[0], x[-1])
    axis.set_ylim(y[0], y[-1])
    return filled


def _draw_eigenvalues(axis: Axes, data: xr.Dataset, spectrum: xr.Dataset) -> None:
    """Dots; open circles with their value where the filter rejects what the drawing shows."""
    values = data.eigenvalue.to_numpy()
    index = np.arange(spectrum.sizes["mode"])
    run = (index >= int(spectrum.run_start)) & (index < int(spectrum.run_stop))
    kept = spectrum.eigenvalue.to_numpy()[run | (spectrum.kept.to_numpy() == "yes")]
    near = np.abs(values[:, None] - kept).min(axis=1) < 1e-6 * (1 + np.abs(values))
    axis.axvline(0, color="0.5", linewidth=0.6)
    axis.plot(values[near].real, values[near].imag, "k.", markersize=3, zorder=3)
    (low, high), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    for value in values[~near]:
        if low < value.real < high and bottom < value.imag < top:
            axis.plot(value.real, value.imag, "o", color="k", mfc="white", markersize=4, mew=0.8)
            if value.imag >= 0:
                label = plotting.signed(value.real, ".2f")
                axis.annotate(
                    f"{label}, rejected",
                    (value.real, value.imag),
                    (4, 4),
                    textcoords="offset points",
                    fontsize=plotting.SMALL,
                    path_effects=_HALO,
                )


# Light enough for black labels.
_CMAP = ListedColormap(matplotlib.colormaps["viridis"](np.linspace(0.3, 1, 256)))
_HALO = [withStroke(linewidth=1.5, foreground="white")]
_KEYS = (
    plotting.key("eigenvalue", linestyle="", marker=".", color="black"),
    plotting.key(
        "eigenvalue of this mesh that the filter rejects",
        linestyle="",
        marker="o",
        mfc="white",
        color="black",
    ),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
