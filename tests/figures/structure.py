"""Layer 2: what is drawn in a figure (axes, curves, limits, labels), as a readable description."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import Collection, QuadMesh
from matplotlib.colors import to_hex
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Patch
from matplotlib.text import Annotation, Text

STORED = Path(__file__).with_name("structure")
# Of the largest number in a row, so that a limit of zero may be -1e-17. Rounding in artifacts moves
# numbers by 1e-8 at most; a change of 1e-3 is hardly seen.
TOLERANCE = 1e-3
# The ends of adaptive curves and the edges of contours have points that depend on rounding.
POINTS_TOLERANCE = 0.02


class _Row(dict[str, Any]):
    """A mapping that YAML writes on one line."""


class _Dumper(yaml.SafeDumper):
    """Writes rows, and lists of plain values, on one line."""


def _write_row(dumper: yaml.SafeDumper, row: _Row) -> yaml.Node:
    return dumper.represent_mapping("tag:yaml.org,2002:map", row, flow_style=True)


def _write_list(dumper: yaml.SafeDumper, items: list[Any]) -> yaml.Node:
    plain = not any(isinstance(item, list | dict) for item in items)
    return dumper.represent_sequence("tag:yaml.org,2002:seq", items, flow_style=plain)


_Dumper.add_representer(_Row, _write_row)
_Dumper.add_representer(list, _write_list)


def describe(figure: Figure) -> dict[str, Any]:
    """Return a description of a figure in plain values, lengths in inches or points."""
    return _without_blanks(
        {
            "size": _numbers(figure.get_size_inches()),
            "legends": [_legend(legend) for legend in figure.legends],
            "axes": [_axes(axes) for axes in figure.axes],
        }
    )


def store(description: dict[str, Any], path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    text = yaml.dump(description, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=98)
    path.write_text(text, encoding="utf-8")


def load(path: Path) -> Any:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def differences(drawn: Any, stored: Any, place: str = "figure") -> list[str]:
    """Return, a line each, where a description leaves the stored one; an empty list if nowhere."""
    return list(_differences(drawn, stored, place))


def _differences(drawn: Any, stored: Any, place: str) -> Iterator[str]:
    numbers, wanted = _as_numbers(drawn), _as_numbers(stored)
    if isinstance(drawn, dict) and isinstance(stored, dict):
        for key in {**stored, **drawn}:
            yield from _differences(drawn.get(key), stored.get(key), f"{place}.{key}")
    elif numbers and wanted and len(numbers) == len(wanted):
        relative = POINTS_TOLERANCE if place.endswith(".points") else TOLERANCE
        if not np.allclose(numbers, wanted, rtol=0, atol=relative * np.max(np.abs(wanted))):
            yield f"{place}: {drawn}, stored {stored}"
    elif isinstance(drawn, list) and isinstance(stored, list) and not numbers and not wanted:
        if len(drawn) != len(stored):
            yield f"{place}: {len(drawn)} drawn, {len(stored)} stored"
        for index, pair in enumerate(zip(drawn, stored, strict=False)):
            yield from _differences(*pair, f"{place}[{index}]")
    elif drawn != stored:
        yield f"{place}: {drawn!r}, stored {stored!r}"


def _as_numbers(value: Any) -> list[float]:
    """Return a number or a list of numbers as a list, empty for anything else."""
    items = value if isinstance(value, list) else [value]
    return items if all(isinstance(item, int | float) for item in items) else []


def _axes(axes: Axes) -> dict[str, Any]:
    title = {place: axes.get_title(loc=place) for place in ("left", "center", "right")}
    described = {
        "title": _Row(_without_blanks(title)),
        "x": _Row(
            label=axes.get_xlabel(), scale=axes.get_xscale(), limits=_numbers(axes.get_xlim())
        ),
        "y": _Row(
            label=axes.get_ylabel(), scale=axes.get_yscale(), limits=_numbers(axes.get_ylim())
        ),
        "legend": _legend(axes.get_legend()),
        "artists": [
            _Row(_without_blanks(_artist(artist)))
            for artist in axes.get_children()
            if isinstance(artist, Line2D | Collection | Patch | Text)
            and artist is not axes.patch
            and artist not in (axes.title, axes._left_title, axes._right_title)  # no public names
            and artist not in axes.spines.values()
        ],
    }
    return _without_blanks(described)


def _legend(legend: Legend | None) -> list[str]:
    if legend is None:
        return []
    title = legend.get_title().get_text()
    return [*([title] if title else []), *(text.get_text() for text in legend.get_texts())]


def _artist(artist: Artist) -> dict[str, Any]:
    """Return kind, look and extent of whatever is drawn."""
    label = artist.get_label() or ""
    found = {"kind": type(artist).__name__, "label": "" if label.startswith("_") else label}
    if isinstance(artist, Line2D):
        found |= {
            "color": to_hex(artist.get_color()),
            "style": artist.get_linestyle(),
            "width": _number(artist.get_linewidth()),
            **_extent(artist.get_xydata()),
        }
        if artist.get_marker() not in ("", "None", None):
            found |= {
                "marker": artist.get_marker(),
                "marker_size": _number(artist.get_markersize()),
                "face": _color(artist.get_markerfacecolor()),
            }
    elif isinstance(artist, Text):
        place = artist.xy if isinstance(artist, Annotation) else artist.get_position()
        found |= {
            "text": artist.get_text(),
            "color": to_hex(artist.get_color()),
            "at": _numbers(place),
        }
    elif isinstance(artist, ContourSet):
        found |= {
            "map": artist.cmap.name,
            "filled": artist.filled,
            "levels": _numbers(artist.levels),
        }
    elif isinstance(artist, QuadMesh):
        found |= {
            "map": artist.cmap.name,
            "colors": [to_hex(color) for color in artist.cmap([0.0, 1.0])],
            "norm": type(artist.norm).__name__,
            "range": _numbers(artist.get_clim()),
            "points": int(np.isfinite(np.ma.filled(artist.get_array(), np.nan)).sum()),
        }
    elif isinstance(artist, Collection):
        corners = [np.empty((0, 2)), *(path.vertices for path in artist.get_paths())]
        found |= {
            "faces": [_color(color) for color in artist.get_facecolor()],
            "edges": [_color(color) for color in artist.get_edgecolor()],
            **_extent(np.concatenate(corners)),
        }
    elif isinstance(artist, Patch):
        found |= {
            "face": _color(artist.get_facecolor()),
            "edge": _color(artist.get_edgecolor()),
            "style": artist.get_linestyle(),
            "width": _number(artist.get_linewidth()),
        }
        if not isinstance(artist, FancyArrowPatch):  # whose path depends on the size in pixels
            found |= _extent(artist.get_patch_transform().transform(artist.get_path().vertices))
    return found


def _extent(points: Any) -> dict[str, Any]:
    """Return how many points there are, gaps left out, and the box they fill."""
    finite = points[np.isfinite(points).all(axis=1)]
    if not finite.size:
        return {"points": 0}
    box = np.column_stack([finite.min(axis=0), finite.max(axis=0)])
    return {"points": len(finite), "x": _numbers(box[0]), "y": _numbers(box[1])}


def _color(color: Any) -> str:
    return "none" if isinstance(color, str) and color == "none" else to_hex(color, keep_alpha=True)


def _number(value: float) -> float:
    return float(f"{value:.6g}") if abs(value) > 1e-12 else 0.0


def _numbers(values: Any) -> list[float]:
    return [_number(value) for value in values]


def _without_blanks(values: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value not in ("", [], {})}
