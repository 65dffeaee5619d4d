"""Exponents with which end effects decay in elliptic von Mises cones, down and up."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading

# Degrees of delta.
_LABELS_FROM_END = 1.0
_LEVELS = (0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10)


def draw(domains: Sequence[str], *, half_angles_deg: Sequence[float]) -> Figure:
    """Draw a row for each half angle: contours over elliptic flows, up to their border."""
    rows = len(domains)
    figure, axes = plotting.subplots(rows, 2, height=2.5 * rows + 0.3, squeeze=False, sharey=True)
    for row, path, angle in zip(axes, domains, half_angles_deg, strict=True):
        data = reading.read(path)
        for axis, name, end in zip(row, ("decay_down", "decay_up"), _ENDS, strict=True):
            _contours(axis, data, name)
            axis.set_title(rf"$\vartheta_w$ = {angle:g}°, {end}")
        row[0].set_ylabel(r"wall friction $\phi$ (degrees)")
    for axis in axes[-1]:
        axis.set_xlabel(r"internal friction $\delta$ (degrees)")
    plotting.letter(axes.flat)
    figure.suptitle(
        "Contours of the exponent $a$; dashed: end of elliptic flows; white below it: not resolved",
        fontsize=8,
    )
    return figure


def _contours(axis: Axes, data: xr.Dataset, name: str) -> None:
    phi, rates = data.decay_phi.values, data[name].values
    delta = np.broadcast_to(data.decay_delta.values[:, None], phi.shape)
    axis.contourf(delta, phi, rates, levels=_LEVELS, cmap="viridis", extend="both", alpha=0.55)
    lines = axis.contour(delta, phi, rates, levels=_LEVELS, colors="black", linewidths=0.8)
    inside = float(data.axis_hyperbolic) - _LABELS_FROM_END
    for label in axis.clabel(lines, fontsize=plotting.SMALL, fmt="%g", inline=False):
        label.set(rotation=0, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6})
        # Contours crowd at the border.
        if label.get_position()[0] > inside:
            label.remove()
    axis.plot(data.delta, data.sonic_phi, color="black", linestyle="--", linewidth=1)
    axis.set_xlim(float(data.decay_delta.min()), float(data.axis_hyperbolic))
    axis.set_ylim(bottom=0)


_ENDS = ("top: decay like $r^a$", "outlet: decay like $r^{-a}$")

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
