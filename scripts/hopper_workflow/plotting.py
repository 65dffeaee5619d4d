"""One look for all figures: sizes, colours, line styles, reproducible files."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from hopper_cli import drawing
from hopper_workflow.artifacts import replacing

# Whatever a matplotlibrc says: handles of legends are made when the scripts are imported.
matplotlib.rcdefaults()

COLUMN_WIDTH, PAGE_WIDTH = 3.4, 7.1  # inches: one column of a page, and two
SMALL = 7  # points, the least text at these widths
BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY, BLACK = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#E69F00",
    "#56B4E9",
    "#000000",
)
MODEL_STYLES = {
    "mohr-coulomb": {"linestyle": "-", "label": "Mohr-Coulomb"},
    "von-mises": {"linestyle": "--", "label": "von Mises"},
}
GEOMETRY_COLORS = {"wedge": BLUE, "cone": ORANGE}
GEOMETRIES = ("wedge", "cone")
NORM_NAMES = {"discrete": "discrete norm", "L2": "$L_2$ norm"}
STYLE = drawing.STYLE


def subplots(
    rows: int = 1, columns: int = 1, *, width: float = PAGE_WIDTH, height: float = 2.6, **more: Any
) -> tuple[Figure, Any]:
    """Return a figure and its axes in the style of the paper; sizes in inches.

    The style lies on Matplotlib's defaults, whatever a matplotlibrc of the user says.
    """
    plt.style.use(["default", STYLE])
    figure, axes = plt.subplots(rows, columns, figsize=(width, height), **more)
    return figure, axes


def letter(axes: Sequence[Axes]) -> None:
    """Mark panels (a), (b), ... above their upper left corners."""
    for axis, name in zip(axes, ascii_lowercase, strict=False):
        axis.set_title(f"({name})", loc="left")


def grid(panels: int, most: int, *, height: float, **more: Any) -> tuple[Figure, list[Axes]]:
    """Return a figure and this many axes, at most so many in a row, each row of the given height.

    Labels that rows share stand at the last panel of each column.
    """
    columns = min(panels, most)
    rows = -(-panels // columns)
    figure, axes = subplots(rows, columns, height=height * rows + 0.6, squeeze=False, **more)
    for axis in axes.flat[panels:]:
        axis.remove()
    for axis in axes.flat[max(0, panels - columns) : panels]:
        axis.xaxis.set_tick_params(labelbottom=True)
    return figure, list(axes.flat[:panels])


def series(count: int) -> list[dict[str, Any]]:
    """Return looks of curves that differ without colour: by lightness, and by a sparse marker."""
    return [
        {"color": color, "marker": marker, "markevery": (0.05 + 0.03 * index, 0.3)}
        for index, (color, marker) in enumerate(zip(sequence(count), _MARKERS, strict=False))
    ]


def parameters_of(data: xr.Dataset) -> dict[str, Any]:
    """Return what an artifact was made with."""
    found: dict[str, Any] = json.loads(data.attrs["parameters"])
    return found


def hopper_of(data: xr.Dataset) -> str:
    """Return the hopper that an artifact is of, from its parameters."""
    made_with = parameters_of(data)
    return (
        rf"{made_with['geometry']}, $\delta$ = {made_with['delta_deg']:g}°, "
        rf"$\vartheta_w$ = {made_with['half_angle_deg']:g}°"
    )


def signed(value: float, digits: str) -> str:
    """Return a number with a true minus sign."""
    return drawing.typeset(f"{value:{digits}}")


def below(figure: Figure, handles: Sequence[Artist], columns: int) -> None:
    """Put a legend below all panels, where it hides no curve."""
    figure.legend(handles=handles, loc="outside lower center", ncols=columns)


def all_keys(axes: Sequence[Axes]) -> list[Artist]:
    """Return one handle for each label of several panels."""
    found: dict[str, Artist] = {}
    for axis in axes:
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    return list(found.values())


def key(label: str, **style: Any) -> Line2D:
    """Return a line for a legend."""
    return Line2D([], [], label=label, **{"color": "0.2", **style})


_MARKERS = "os^DvP*X"
_STAMPS = ("CreationDate", "Producer", "Creator")


def save(figure: Figure, png: str | Path, pdf: str | Path) -> None:
    """Write PNG and PDF without time stamps, one layout for both, and close the figure."""
    figure.set_dpi(plt.rcParams["savefig.dpi"])
    # Once, by itself: savefig would lay out each file in a drawing of its own that nobody sees.
    if layout := figure.get_layout_engine():
        layout.execute(figure)
    figure.set_layout_engine("none")
    with replacing(png) as path:
        FigureCanvasAgg(figure).print_png(path, metadata={"Software": None})
    with replacing(pdf) as path:
        FigureCanvasPdf(figure).print_pdf(path, metadata=dict.fromkeys(_STAMPS))
    plt.close(figure)


def saving(draw: Callable[..., Figure]) -> Callable[..., None]:
    """Return the function of a plot's rule: it draws from the job's inputs and params, and saves.

    ``draw`` itself writes nothing, so that checks can look at the figure.
    """

    def plot(*, png: str, pdf: str, **arguments: Any) -> None:
        save(draw(**arguments), png, pdf)

    return plot


def degree_ticks(axis: Axes, half_angle: float, step: float) -> None:
    """Tick a symmetric angle axis, in degrees."""
    count = int(half_angle // step)
    axis.set_xticks(np.arange(-count, count + 1) * step)
    axis.set_xlim(-half_angle, half_angle)


def sequence(count: int) -> list[Any]:
    """Return colours that order by lightness, for curves of an increasing parameter."""
    return [matplotlib.colormaps["viridis"](x) for x in np.linspace(0, 0.82, count)]


def level_norm(levels: Sequence[float]) -> Normalize:
    """Return the colour scale of contours at the given levels."""
    margin = 0.5 * (levels[-1] - levels[0]) / max(1, len(levels) - 1)
    return Normalize(levels[0] - margin, levels[-1] + margin)


def power_of_ten(level: float) -> str:
    """Return the label of a contour."""
    return rf"$10^{{{level:g}}}$"


def level_bar(
    figure: Figure, axes: Any, cmap: str, norm: Normalize, levels: Sequence[float], label: str
) -> None:
    """Add a colour bar whose ticks are the contour levels, as powers of ten."""
    bar = figure.colorbar(
        ScalarMappable(norm, cmap), ax=axes, location="bottom", shrink=0.6, aspect=40, label=label
    )
    bar.set_ticks(levels, labels=[power_of_ten(level) for level in levels])
    bar.ax.minorticks_off()
