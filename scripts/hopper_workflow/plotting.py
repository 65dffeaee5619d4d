"""One look for all figures: sizes, colours, line styles, reproducible files."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from hopper_workflow.artifacts import replacing

COLUMN_WIDTH, PAGE_WIDTH = 3.5, 7.1  # inches
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
STYLE = Path(__file__).with_name("paper.mplstyle")


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
    for axis, name in zip(axes, "abcdefgh", strict=False):
        axis.set_title(f"({name})", loc="left")


def save(figure: Figure, png: str | Path, pdf: str | Path) -> None:
    """Write PNG and PDF without time stamps and close the figure."""
    with replacing(png) as path:
        figure.savefig(path, metadata={"Software": None})
    with replacing(pdf) as path:
        figure.savefig(path, metadata={"CreationDate": None, "Producer": None, "Creator": None})
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
    return [matplotlib.colormaps["viridis"](x) for x in np.linspace(0, 0.88, count)]


def level_norm(levels: Sequence[float]) -> Normalize:
    """Return the colour scale of contours at the given levels."""
    margin = 0.5 * (levels[-1] - levels[0]) / max(1, len(levels) - 1)
    return Normalize(levels[0] - margin, levels[-1] + margin)


def level_bar(
    figure: Figure, axes: Any, cmap: str, norm: Normalize, levels: Sequence[float], label: str
) -> None:
    """Add a colour bar whose ticks are the contour levels, as powers of ten."""
    bar = figure.colorbar(
        ScalarMappable(norm, cmap), ax=axes, location="bottom", shrink=0.6, aspect=40, label=label
    )
    bar.set_ticks(levels, labels=[rf"$10^{{{level:g}}}$" for level in levels])
    bar.ax.minorticks_off()
