"""Figure 1.1: the wedge-shaped and the conical hopper with their coordinates."""

from math import cos, radians, sin

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, FancyArrowPatch

from hopper_workflow import jobs, plotting

_DEPTH = (0.85, 0.42)  # offset of the wedge's rear edge, in units of the slant height
_FLATTENING = 0.22  # of the cone's circles as seen from the side


def draw(*, half_angle_deg: float, theta_deg: float) -> Figure:
    """Draw both geometries for a half opening angle, with a particle at polar angle theta."""
    figure, (wedge, cone) = plotting.subplots(1, 2, height=2.9)
    half_angle, theta = radians(half_angle_deg), radians(theta_deg)
    for axis in (wedge, cone):
        axis.set_aspect("equal")
        axis.axis("off")
    _draw_wedge(wedge, half_angle)
    _draw_cone(cone, half_angle)
    for axis in (wedge, cone):
        _draw_coordinates(axis, half_angle, theta)
    wedge.text(0, -0.28, "wedge-shaped hopper", ha="center")
    cone.text(0, -0.28, "conical hopper", ha="center")
    wedge.set_xlim(-0.75, 1.5)
    cone.set_xlim(-1.0, 1.25)
    for axis in (wedge, cone):
        axis.set_ylim(-0.34, 1.46)
    return figure


def _draw_wedge(axis: Axes, half_angle: float) -> None:
    x, y = sin(half_angle), cos(half_angle)
    dx, dy = _DEPTH
    wall = {"color": plotting.BLACK, "linewidth": 1.2, "solid_joinstyle": "round"}
    hidden = {"color": "0.6", "linewidth": 0.8, "linestyle": (0, (4, 3))}
    axis.fill([0, x, x + dx, dx], [0, y, y + dy, dy], color=plotting.SKY, alpha=0.18, lw=0)
    axis.plot([-x, 0, x], [y, 0, y], **wall)
    axis.plot([-x, -x + dx, x + dx, x, -x], [y, y + dy, y + dy, y, y], **wall)
    axis.plot([0, dx, x + dx], [0, dy, y + dy], **wall)
    axis.plot([dx, -x + dx], [dy, y + dy], **hidden)


def _draw_cone(axis: Axes, half_angle: float) -> None:
    x, y = sin(half_angle), cos(half_angle)
    angle = np.linspace(0, 2 * np.pi, 241)
    wall = {"color": plotting.BLACK, "linewidth": 1.2}
    axis.fill(
        np.concatenate([[0], x * np.cos(angle[:121])]),
        np.concatenate([[0], y + _FLATTENING * x * np.sin(-angle[:121])]),
        color=plotting.SKY,
        alpha=0.18,
        lw=0,
    )
    axis.plot(x * np.cos(angle), y + _FLATTENING * x * np.sin(angle), **wall)
    axis.plot([-x, 0, x], [y, 0, y], **wall)
    # The azimuth phi, on a circle above the rim.
    axis.add_patch(
        FancyArrowPatch(
            (-0.16, y + 0.28),
            (0.16, y + 0.28),
            connectionstyle="arc3,rad=0.5",
            arrowstyle="->",
            mutation_scale=7,
            linewidth=0.8,
        )
    )
    axis.text(0.19, y + 0.29, r"$\varphi$", ha="left", va="center")


def _draw_coordinates(axis: Axes, half_angle: float, theta: float) -> None:
    """Axis of symmetry, polar angle, radius, unit vectors and gravity."""
    axis.plot([0, 0], [0, 1.38], color="0.4", linewidth=0.7, linestyle=(0, (6, 2, 1, 2)))
    radius = 0.5
    tip = np.array([-radius * sin(theta), radius * cos(theta)])
    along = np.array([-sin(theta), cos(theta)])
    across = np.array([-cos(theta), -sin(theta)])
    axis.plot([0, tip[0]], [0, tip[1]], color=plotting.BLUE)
    axis.plot(*tip, "o", color=plotting.BLUE)
    axis.text(tip[0] * 0.72 - 0.02, tip[1] * 0.72 - 0.02, "$r$", color=plotting.BLUE, ha="right")
    for vector, length, name in ((along, 0.19, r"$e_r$"), (across, 0.1, r"$e_\vartheta$")):
        _arrow(axis, tip, tip + length * vector, plotting.BLUE)
        axis.text(
            *(tip + (length + 0.05) * vector), name, color=plotting.BLUE, ha="center", va="center"
        )
    axis.add_patch(
        Arc((0, 0), 0.62, 0.62, theta1=90, theta2=90 + np.degrees(theta), color=plotting.BLUE)
    )
    middle = theta / 2
    axis.text(
        -0.37 * sin(middle),
        0.37 * cos(middle),
        r"$\vartheta$",
        color=plotting.BLUE,
        ha="center",
        va="center",
    )
    axis.add_patch(
        Arc((0, 0), 0.5, 0.5, theta1=90 - np.degrees(half_angle), theta2=90, color=plotting.ORANGE)
    )
    middle = half_angle / 2
    axis.text(
        0.34 * sin(middle),
        0.34 * cos(middle),
        r"$\vartheta_w$",
        color=plotting.ORANGE,
        ha="center",
        va="center",
    )
    _arrow(axis, np.array([0.72, 0.3]), np.array([0.72, 0.02]), plotting.BLACK)
    axis.text(0.77, 0.14, "$g$", va="center")


def _arrow(axis: Axes, start: np.ndarray, end: np.ndarray, color: str) -> None:
    axis.add_patch(
        FancyArrowPatch(
            start,
            end,
            arrowstyle="-|>",
            mutation_scale=7,
            shrinkA=0,
            shrinkB=0,
            color=color,
            linewidth=0.9,
        )
    )


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
