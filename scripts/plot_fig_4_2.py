"""Figure 4.2 and others of its kind: converged part of the discrete spectrum, exact eigenvalues."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hopper_workflow import jobs, plotting, reading


def draw(wedge: str, cone: str, wedge_exact: str, cone_exact: str, *, zoom_imag: float) -> Figure:
    """Plot the first unbroken run kept as worded (top), and its low part with (4.7), (4.9).

    The upper half plane is enough, as eigenvalues come in conjugate pairs.
    """
    figure, axes = plotting.subplots(2, 2, height=5.6)
    columns = (("wedge", wedge, wedge_exact, "(4.7)"), ("cone", cone, cone_exact, "(4.9)"))
    for column, (geometry, spectrum, exact, equation) in enumerate(columns):
        data, theory = reading.read(spectrum), reading.read(exact)
        top, bottom = axes[:, column]
        count = int(data.run_stop - data.run_start)
        # So many dots above each other that they must not melt into a bar.
        _draw_spectrum(top, data, float(np.clip(200 / count, 0.8, 3)))
        _draw_spectrum(bottom, data, 3.0)
        crosses = _exact(theory, geometry)
        crosses = crosses[np.abs(crosses.imag) <= zoom_imag]
        bottom.plot(crosses.real, crosses.imag, "x", color=plotting.ORANGE, markersize=6)
        bottom.set_ylim(-0.05 * zoom_imag, zoom_imag)
        top.set_ylim(bottom=-0.02 * top.get_ylim()[1])
        top.set_title(f"{geometry}, paper's formulation: {count} converged")
        bottom.set_title(f"{geometry}: low part, crosses exact {equation}, smooth wall")
        for axis in (top, bottom):
            axis.set_xlabel(r"Re $\lambda$")
            axis.margins(x=0.12)
    for axis in axes[:, 0]:
        axis.set_ylabel(r"Im $\lambda$ (conjugates not drawn)")
    plotting.below(figure, [key for key in _KEYS if _drawn(key, axes)], 3)
    return figure


def _drawn(key: Line2D, axes: np.ndarray) -> bool:
    """Tell whether a panel has what a key stands for: points of its marker and filling."""
    looks = {
        (line.get_marker(), line.get_markerfacecolor())
        for axis in axes.flat
        for line in axis.lines
        if len(line.get_xdata())
    }
    return (key.get_marker(), key.get_markerfacecolor()) in looks


def _exact(theory: xr.Dataset, geometry: str) -> np.ndarray:
    """Return the families the paper plots: all of the wedge, Bessel's for the cone."""
    values = theory.eigenvalue.to_numpy()
    return values if geometry == "wedge" else values[theory.kind.to_numpy() == "bessel"]


def _draw_spectrum(axis: Axes, data: xr.Dataset, size: float) -> None:
    run = slice(int(data.run_start), int(data.run_stop))
    values = data.eigenvalue.to_numpy()[run]
    kept = data.kept.to_numpy()[run] == "yes"
    axis.axvline(0, color="0.5", linewidth=0.6)
    for chosen, look in (
        (~kept, {"mfc": "none", "mew": 0.5, "markersize": 2 * size}),
        (kept, {"mew": 0, "markersize": size}),
    ):
        shown = values[chosen & (values.imag >= 0)]
        axis.plot(shown.real, shown.imag, "o", color=plotting.BLUE, **look)


_DOT = {"linestyle": "", "color": plotting.BLUE}
_KEYS = (
    plotting.key("resolved: matched one to one", marker="o", markersize=3, mew=0, **_DOT),
    plotting.key(
        "not resolved: merely near one of the other mesh",
        marker="o",
        markersize=5,
        mfc="none",
        **_DOT,
    ),
    plotting.key("exact", linestyle="", marker="x", markersize=6, color=plotting.ORANGE),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
