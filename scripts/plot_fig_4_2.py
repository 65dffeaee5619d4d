"""Figure 4.2: converged part of the discrete spectrum, and the exact smooth-wall eigenvalues."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(wedge: str, cone: str, wedge_exact: str, cone_exact: str, *, zoom_imag: float) -> Figure:
    """Plot the first unbroken run kept as worded (top), and its low part with (4.7), (4.9)."""
    figure, axes = plotting.subplots(2, 2, height=5.2)
    columns = (("wedge", wedge, wedge_exact, "(4.7)"), ("cone", cone, cone_exact, "(4.9)"))
    for column, (geometry, spectrum, exact, equation) in enumerate(columns):
        data, theory = artifacts.read(spectrum), artifacts.read(exact)
        top, bottom = axes[:, column]
        _draw_spectrum(top, data)
        _draw_spectrum(bottom, data)
        # The families the paper plots: all of the wedge, Bessel's for the cone.
        shown = (
            np.full(theory.sizes["mode"], True) if geometry == "wedge" else theory.kind == "bessel"
        )
        crosses = theory.eigenvalue.to_numpy()[shown]
        crosses = crosses[np.abs(crosses.imag) <= zoom_imag]
        bottom.plot(
            crosses.real,
            crosses.imag,
            "x",
            color=plotting.ORANGE,
            markersize=5,
            label=f"exact, {equation}",
        )
        bottom.set_ylim(-zoom_imag, zoom_imag)
        top.set_title(f"{geometry}: {int(data.run_stop - data.run_start)} converged eigenvalues")
        bottom.set_title(f"{geometry}: comparison with smooth-wall theory")
        bottom.legend(loc="lower left")
    top_left, top_right = axes[0]
    top_left.legend(loc="lower left")
    top_right.legend(loc="lower left")
    for axis in axes.flat:
        axis.set_xlabel(r"Re $\lambda$")
        axis.set_ylabel(r"Im $\lambda$")
        axis.margins(x=0.12)
    return figure


def _draw_spectrum(axis: Axes, data: xr.Dataset) -> None:
    """Filled: confirmed by the sound filter. Open: kept by the paper's wording alone."""
    run = slice(int(data.run_start), int(data.run_stop))
    values = data.eigenvalue.to_numpy()[run]
    kept = data.kept.to_numpy()[run] == "yes"
    axis.axvline(0, color="0.5", linewidth=0.6)
    axis.plot(
        values[~kept].real,
        values[~kept].imag,
        "o",
        markersize=5,
        mfc="none",
        mew=0.6,
        color=plotting.BLUE,
        label="nearest match only",
    )
    axis.plot(
        values[kept].real,
        values[kept].imag,
        "o",
        markersize=2.6,
        color=plotting.BLUE,
        label="resolved",
    )


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
