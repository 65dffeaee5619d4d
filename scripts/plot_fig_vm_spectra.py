"""Spectra of von Mises cones, with what is known of high frequencies."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(spectra: Sequence[str]) -> Figure:
    """Draw the upper half plane of each spectrum."""
    figure, axes = plotting.grid(len(spectra), 3, height=2.9)
    for axis, path in zip(axes, spectra, strict=True):
        data = reading.read(path)
        modes, kind = data.eigenvalue.to_numpy(), data.type.item()
        axis.axvline(0, color="0.6", linewidth=0.6)
        if kind == "elliptic":
            _draw_rays(axis, data, modes.imag.max())
        elif "strips" in data:
            for low, high in data.strips.values:
                axis.axvspan(low, high, color="0.78", label="strips")
        elif "ring_spacing" in data:
            _draw_ladder(axis, float(data.ring_spacing), modes)
        _draw_modes(axis, data)
        if "strips" in data:
            _draw_upper_strip(axis, data)
        axis.plot(0, 0, "s", color="black", markersize=3.2, label=r"flow rate, $\lambda$ = 0")
        friction = rf"$\mu$ = {plotting.parameters_of(data)['mu']:g}"
        axis.set_title(f"{kind}, {friction}\n{plotting.hopper_of(data)}")
        axis.set_xlabel(r"Re $\lambda$")
        axis.margins(x=0.12)
        axis.set_ylim(bottom=-0.02 * modes.imag.max())
    axes[0].set_ylabel(r"Im $\lambda$")
    plotting.below(figure, plotting.all_keys(axes), 3)
    return figure


def _draw_modes(axis: Axes, data: xr.Dataset) -> None:
    modes = data.eigenvalue.to_numpy()
    axis.plot(modes.real, modes.imag, "o", color=plotting.BLUE, markersize=1.8, label="modes")
    if "root" in data:
        roots = data.root.to_numpy()
        axis.plot(roots.real, roots.imag, "o", color=plotting.ORANGE, markersize=4,
                  mfc="none", mew=0.6, label="law of high frequency")  # fmt: skip


def _draw_upper_strip(axis: Axes, data: xr.Dataset) -> None:
    """Draw the upper strip again, wide enough to tell its edges from the modes in it."""
    low, high = data.strips.values[-1]
    left, right = low - (high - low), max(high, 0.0) + (high - low) / 2
    inset = axis.inset_axes((0.09, 0.3, 0.38, 0.6))
    inset.axvspan(low, high, color="0.78")
    inset.axvline(0, color="0.6", linewidth=0.6)
    _draw_modes(inset, data)
    inset.set_xlim(left, right)
    inset.set_ylim(np.array([-0.02, 1.05]) * data.eigenvalue.to_numpy().imag.max())
    inset.set_xticks([round(float(low), 2), 0])
    inset.set_yticks([])
    inset.tick_params(labelsize=plotting.SMALL)
    inset.set_title("upper strip", fontsize=plotting.SMALL)


def _draw_rays(axis: Axes, data: xr.Dataset, top: float) -> None:
    for start, step in zip(data.ray_start.to_numpy(), data.ray_step.to_numpy(), strict=True):
        ends = start + step * np.array([1.0, (top - start.imag) / step.imag])
        axis.plot(ends.real, ends.imag, color="0.35", linewidth=0.8, label="rays")


def _draw_ladder(axis: Axes, spacing: float, modes: np.ndarray) -> None:
    """Draw steps of the mean spacing of the modes that run in the hyperbolic ring."""
    for height in np.arange(0, modes.imag.max(), spacing):
        axis.axhline(
            height, color="0.78", linewidth=0.6, zorder=0, label="mean spacing in the ring"
        )


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
