"""Design charts on given axes; the look of pages is the caller's."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import scipy
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from hopper_cli.drawing import Array

FLOW_FACTORS = (1.1, 1.2, 1.4, 1.6, 1.8, 2.0, 3.0, 5.0)
# Style and words of each limit; they differ without colour.
_LOOKS: dict[str, tuple[dict[str, Any], str]] = {
    "classical": ({"color": "black", "linewidth": 1.6}, r"$\sigma_0 = 0$ (a)"),
    "limit": ({"color": "0.45", "linestyle": "--"}, "a radial solution exists (b)"),
    "velocity": ({"color": "#0072B2", "linestyle": "-."}, r"$\psi < \pi/4$ (c)"),
    "stability": ({"color": "#D55E00", "linestyle": (0, (1, 1))}, "stable (d)"),
    "stable_from": ({"color": "#D55E00", "linestyle": (0, (1, 1))}, ""),
}
LINES = tuple(_LOOKS)
# Of labels to the frame and to the limit of mass flow, relative to the axes.
_MARGIN = 0.07
# Distance of the ends of a contour without a label, relative to the axes.
_SHORT = 0.05
_FLOWS = {"cone": "classical", "wedge": "velocity"}


def draw_limits(axis: Axes, geometry: str, half_angle: Array, phi: Mapping[str, Array]) -> None:
    """Draw limits of wall friction by name, degrees, and grey where there is mass flow."""
    flows = phi[_FLOWS[geometry]]
    flows = np.where(np.isnan(flows) & (geometry == "wedge"), phi["limit"], flows)
    axis.fill_between(half_angle, 0, flows, color="0.9", linewidth=0)
    for name, (look, _) in _LOOKS.items():
        axis.plot(half_angle, phi[name], **look)
    # Where the stable interval ends its two sides meet.
    inside = np.isfinite(phi["stability"]) & np.isfinite(phi["stable_from"])
    for end in np.flatnonzero(inside[:-1] & np.isnan(phi["stability"][1:])):
        ends = phi["stable_from"][end], phi["stability"][end]
        axis.plot([half_angle[end]] * 2, ends, **_LOOKS["stability"][0])


def keys(geometry: str) -> list[Line2D]:
    """Return the legend's handles, the limit of mass flow in words."""
    found = []
    for name, (look, words) in _LOOKS.items():
        if words and (name != "classical" or geometry == "cone"):
            flows = ": mass flow (grey)" if name == _FLOWS[geometry] else ""
            found.append(Line2D([], [], label=f"{words}{flows}", **look))
    return found


def draw_flow_factors(
    axis: Axes, half_angle: Array, phi: Array, factors: Array, levels: Sequence[float]
) -> None:
    """Draw contours of the flow factor up to the limit of mass flow.

    ``half_angle`` is of shape (n,), ``phi`` and ``factors`` of shape (n, m), degrees. Rows of the
    grid end on the limit, so that contours do as well.
    """
    known = np.isfinite(factors).all(axis=1)
    angle, top = half_angle[known], phi[known, -1]
    axis.plot(angle, top, color="black", linewidth=1.6)
    share = np.linspace(0, 1, factors.shape[1])
    kx, ky = min(3, angle.size - 1), min(3, share.size - 1)
    spline = scipy.interpolate.RectBivariateSpline(
        angle, share, np.log(factors[known]), kx=kx, ky=ky
    )
    angle_between, share_between = _between(angle), _between(share)
    lines = axis.contour(
        np.broadcast_to(angle_between[:, None], (angle_between.size, share_between.size)),
        np.outer(np.interp(angle_between, angle, top), share_between),
        np.exp(spline(angle_between, share_between)),
        levels,
        colors="black",
        linewidths=0.7,
    )
    frame = np.array([half_angle[-1], top.max()])
    # Labels of neighbours stand apart.
    places = [
        place
        for number, parts in enumerate(lines.allsegs)
        for part in parts
        for place in _label_place(part, (angle, top), frame, (0.3, 0.6)[number % 2])
    ]
    if places:
        axis.clabel(lines, fontsize=7, fmt="%g", inline_spacing=2, manual=places)


def _label_place(
    part: Array, limit: tuple[Array, Array], frame: Array, share: float
) -> list[tuple[float, float]]:
    """Return where on a part of a contour its label stands, none if that is short."""
    x, y = part.T
    margin = _MARGIN * frame
    free = (x > margin[0]) & (x < frame[0] - margin[0]) & (y > margin[1])
    inside = part[free & (y < np.interp(x, *limit) - margin[1])]
    if len(inside) < 2 or np.hypot(*((inside[-1] - inside[0]) / frame)) < _SHORT:
        return []
    found: tuple[float, float] = tuple(inside[int(share * len(inside))])
    return [found]


def _between(points: Array) -> Array:
    """Return points with three more in each interval: contours between samples are curves."""
    steps = np.arange(4 * (points.size - 1) + 1) / 4
    return np.interp(steps, np.arange(points.size), points)


def label(axes: Sequence[Axes], *, left: bool) -> None:
    """Label axes of half angle and wall friction."""
    for axis in axes:
        axis.set_xlabel(r"half angle $\vartheta_w$ (degrees)")
    if left:
        axes[0].set_ylabel(r"wall friction $\phi$ (degrees)")
