"""How the plane of internal and wall friction is drawn for von Mises cones."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from hopper_workflow import plotting

# Lightness tells them apart in grey: no solution 0.80, unstable 0.58, stable 0.95, elliptic 0.43,
# mixed 0.30.
_COLORS = {
    "no radial solution": "0.80",
    "mixed type": "#5B4A78",
    "elliptic": "#41779A",
    "unstable": "#D98A1F",
    "stable": "#E3F3FB",
}


def shade(axis: Axes, data: xr.Dataset) -> None:
    """Fill the regions, bounded by roots; each lies on the one before it."""
    delta, limit = data.delta.values, data.limit_phi.values
    below = delta < float(data.axis_hyperbolic)
    filled: dict[str, tuple[np.ndarray, np.ndarray | float]] = {
        "no radial solution": (delta, 90.0),
        "mixed type": (delta[below], limit[below]),
        "elliptic": (delta[below], np.nan_to_num(data.sonic_phi.values[below])),
        "unstable": (delta[~below], limit[~below]),
    }
    for name, (x, top) in filled.items():
        axis.fill_between(x, 0, top, color=_COLORS[name], linewidth=0, label=name)
    axis.fill(*_stable(data), color=_COLORS["stable"], linewidth=0, label="stable")
    axis.fill(*_unresolved(data), facecolor=_COLORS["stable"], edgecolor="black", hatch=7 * "x",
              linewidth=0, label="not resolved")  # fmt: skip
    axis.set_xlim(delta[0], float(data.tension))


def _stable(data: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Return the outline of stable cones: neutral curve, resolved edge, corner at tension."""
    edge_delta, edge_phi = _edge(data)
    return (
        np.concatenate([data.neutral_delta, edge_delta, [float(data.tension)]]),
        np.concatenate([data.neutral_phi, edge_phi, [0.0]]),
    )


def _unresolved(data: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Return the outline of what lies between the neutral curve's end, the edge and the limit."""
    edge_delta, edge_phi = _edge(data)
    if not edge_delta.size:
        return edge_delta, edge_phi
    end = float(data.neutral_delta[-1])
    limit = np.linspace(float(data.tension), end, 100)
    return (
        np.concatenate([[end], edge_delta, [float(data.tension)], limit]),
        np.concatenate([data.neutral_phi[-1:], edge_phi, [0.0],
                        np.interp(limit, data.delta, data.limit_phi)]),
    )  # fmt: skip


def _edge(data: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    known = np.isfinite(data.edge_phi.values)
    return data.edge_delta.values[known], data.edge_phi.values[known]


def draw_borders(axis: Axes, data: xr.Dataset) -> None:
    """Draw neutral curve, limit of flow, and where the type or the surface for data changes."""
    delta = data.delta.values
    axis.axvline(
        float(data.axis_hyperbolic), color="black", linewidth=0.8, label=r"$\delta$ = 35.26°"
    )
    axis.plot(delta, data.sonic_phi, color="black", linestyle="--", linewidth=0.8,
              label=r"type changes at the largest $\psi$")  # fmt: skip
    axis.plot(delta, data.tangency_phi, color="0.25", linestyle=":", linewidth=0.9,
              label="above: data on slanted surfaces")  # fmt: skip
    axis.plot(delta, data.limit_phi, color=plotting.PURPLE, linestyle="-.",
              label=r"$\psi$ = 45°: flow ends")  # fmt: skip
    settled = (data.neutral_settled == "yes").to_numpy()
    axis.plot(data.neutral_delta, data.neutral_phi, color="black", linewidth=0.7,
              label="neutral, not settled")  # fmt: skip
    # A line between two settled points.
    for part in np.split(np.arange(settled.size), np.flatnonzero(np.diff(settled)) + 1):
        if settled[part[0]]:
            axis.plot(data.neutral_delta[part], data.neutral_phi[part], color="black",
                      linewidth=1.6, label="neutral stability")  # fmt: skip


def mark_unresolved(axis: Axes, cells: xr.Dataset) -> None:
    """Mark the points of a map that have no verdict because their modes are not resolved."""
    rows, columns = np.nonzero((cells.region == "not_converged").to_numpy())
    axis.plot(cells.delta.values[rows], cells.phi.values[columns], "x", color="black",
              markersize=3, mew=0.7, label="point of the map without a verdict")  # fmt: skip


def top(cells: xr.Dataset) -> float:
    """Return where panels end: half a cell above the last row of a map."""
    return float(1.5 * cells.phi[-1] - 0.5 * cells.phi[-2])


def name_regions(axis: Axes, data: xr.Dataset) -> None:
    """Write into the regions what they are."""
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 1}
    look = {"ha": "center", "va": "center", "fontsize": plotting.SMALL, "bbox": box}
    delta, border = data.delta.values, np.nan_to_num(data.sonic_phi.values)
    axis.text(23, 0.5 * border.max(), "elliptic", **look)
    at = np.interp(29, delta, border), np.interp(29, delta, data.limit_phi)
    axis.text(29, sum(at) / 2, "mixed", **look)
    x, y = _stable(data)
    row = 0.3 * y.max()
    left = np.interp(row, data.neutral_phi, data.neutral_delta)
    if y.max() > 10:
        axis.text((left + x.max()) / 2, row, "stable", **look)
        axis.text(38.2, 11, "unstable", rotation=90, **look)
    else:
        axis.text(46, 8, "unstable", **look)
        axis.annotate("stable", (56, 0.5), (54, 4), arrowprops={"arrowstyle": "-"}, **look)
