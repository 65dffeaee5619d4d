"""Layer 4: what a reader of the printed page needs of a figure, as a list of what is wrong."""

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection, QuadMesh
from matplotlib.colors import to_rgb
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.patches import Polygon
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from hopper_workflow import plotting

# Least difference of two regions' luminance, on a scale of 1, and of a drawn extremum when every
# second sample is left out, as a share of the axis.
LUMINANCE, EXTREMUM = 0.1, 0.01
_FEWEST = 30
_INK = 0.5  # points that a frame or a line is wider than its box


def faults(figure: Figure) -> list[str]:
    """Return a line for everything that is wrong with a figure at its printed size."""
    figure.draw_without_rendering()
    return [
        *_widths(figure),
        *_texts(figure),
        *_legends(figure),
        *(line for axis in figure.axes for line in _regions(axis)),
        *(line for axis in figure.axes for line in _samples(axis)),
    ]


def luminance(color: Any) -> float:
    """Return how light a colour is in grey, from 0 to 1 (Rec. 709, as image viewers do it)."""
    return float(np.dot(to_rgb(color), (0.2126, 0.7152, 0.0722)))


def _widths(figure: Figure) -> Iterator[str]:
    width = figure.get_size_inches()[0]
    if not np.isclose([plotting.COLUMN_WIDTH, plotting.PAGE_WIDTH], width).any():
        yield f"width {width:g} in is neither one column nor two"


def _texts(figure: Figure) -> Iterator[str]:
    page = figure.bbox.expanded(1 + 2e-3, 1 + 2e-3)
    hidden = _hidden_ticks(figure)
    for text in figure.findobj(Text):
        if text in hidden or not _shown(text):
            continue
        label, size = text.get_text(), text.get_fontsize()
        if size < plotting.SMALL:
            yield f"text {label!r} has {size:g} pt, less than {plotting.SMALL}"
        box = text.get_window_extent()
        if not (page.contains(box.x0, box.y0) and page.contains(box.x1, box.y1)):
            yield f"text {label!r} is cut by the edge of the figure"
        outside_mathematics = "".join(label.split("$")[::2])
        if any(f" -{digit}" in f" {outside_mathematics}" for digit in "0123456789"):
            yield f"text {label!r} has a hyphen for a minus sign"


def _shown(text: Text) -> bool:
    return bool(text.get_visible() and text.get_text().strip())


def _hidden_ticks(figure: Figure) -> set[Text]:
    """Return the labels of ticks that are not in the range of their axis."""
    hidden = set()
    for axis in figure.axes:
        for one, ends in ((axis.xaxis, axis.get_xlim()), (axis.yaxis, axis.get_ylim())):
            margin = 1e-9 * (max(ends) - min(ends))
            for tick in [*one.get_major_ticks(), *one.get_minor_ticks()]:
                if not min(ends) - margin <= tick.get_loc() <= max(ends) + margin:
                    hidden |= {tick.label1, tick.label2}
    return hidden


def _legends(figure: Figure) -> Iterator[str]:
    for legend in figure.findobj(Legend):
        box = legend.get_window_extent()
        for axis in figure.axes:
            for name, points in _points(axis):
                visible = points[_inside(axis.bbox, points)]
                if _inside(box, visible).any():
                    yield f"a legend covers {name}"
            if axis is not legend.axes:
                continue
            for text in axis.texts:
                if _shown(text) and Bbox.intersection(box, text.get_window_extent()):
                    yield f"a legend covers {text.get_text()!r}"


def _points(axis: Axes) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the points of what is drawn, in pixels: curves with points between their samples."""
    for line in axis.lines:
        path = line.get_transform().transform_path(line.get_path()).vertices
        path = path[np.isfinite(path).all(axis=1)]
        if len(path) and line.get_visible():
            yield (
                f"curve {line.get_label()!r}",
                _dense(path) if line.get_linestyle() != "None" else path,
            )
    for collection in axis.collections:
        if isinstance(collection, PathCollection):
            yield "points", collection.get_offset_transform().transform(collection.get_offsets())


def _dense(path: np.ndarray) -> np.ndarray:
    start, step = path[:-1], np.diff(path, axis=0)
    parts = np.linspace(0, 1, 33)[:, None, None]
    return np.vstack([path, (start + parts * step).reshape(-1, 2)])


def _inside(box: Bbox, points: np.ndarray) -> np.ndarray:
    x, y = points.T
    return (x > box.x0 + _INK) & (x < box.x1 - _INK) & (y > box.y0 + _INK) & (y < box.y1 - _INK)


def _regions(axis: Axes) -> Iterator[str]:
    """Compare the filled regions of a panel: in grey they differ, or a hatch tells them."""
    filled = [
        (str(region.get_label()), color)
        for region in [*axis.collections, *axis.patches]
        if isinstance(region, PolyCollection | Polygon)
        and not isinstance(region, LineCollection | QuadMesh | ContourSet)
        and not region.get_hatch()
        and not str(region.get_label()).startswith("_")
        for color in np.atleast_2d(region.get_facecolor())[:1]
        if color[-1] > 0
    ]
    for (one, first), (other, second) in combinations(filled, 2):
        difference = abs(luminance(first[:3]) - luminance(second[:3]))
        if difference < LUMINANCE:
            yield f"{one!r} and {other!r} differ by {difference:.2f} in luminance: alike in grey"


def _samples(axis: Axes) -> Iterator[str]:
    """Compare curves with every second sample of them: extrema as drawn must not move."""
    for line in axis.lines:
        scale = axis.yaxis.get_transform().transform
        y = np.asarray(line.get_ydata(), dtype=float)
        if line.get_linestyle() == "None" or y.size < _FEWEST:
            continue
        low, high = scale(np.array(axis.get_ylim()))
        with np.errstate(invalid="ignore", divide="ignore"):
            whole = scale(y)
        whole = whole[np.isfinite(whole)]
        if not whole.size:
            continue
        for name, extremum in (("largest", np.max), ("least", np.min)):
            value = extremum(whole)
            change = abs(value - extremum(whole[::2])) / abs(high - low)
            if change > EXTREMUM and value not in (whole[0], whole[-1]):
                yield f"the {name} value of curve {line.get_label()!r} moves by {change:.1%}"
