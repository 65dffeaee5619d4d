"""Figure 3.2: velocity and psi at large wall friction, with the stagnant zone."""

from math import pi

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(artifact: str, *, stagnant_from_deg: float) -> Figure:
    """Plot u and psi of both models; shade the zone the paper calls essentially stagnant."""
    data = artifacts.read(artifact).isel(mu=0)
    half_angle = float(data.theta.max())
    figure, axes = plotting.subplots(1, 2)
    for axis, name in zip(axes, ("u", "psi"), strict=True):
        _shade(axis, stagnant_from_deg, half_angle)
        for model, color in zip(data.model.values, _COLORS, strict=False):
            style = plotting.MODEL_STYLES[model]
            axis.plot(data.theta, data[name].sel(model=model), color=color, **style)
        plotting.degree_ticks(axis, half_angle, 10)
        axis.set_xlabel(r"angle $\vartheta$ (degrees)")
    velocity, angle = axes
    velocity.set_ylim(0, 1.05)
    velocity.set_ylabel(r"velocity $u(\vartheta)/u(0)$")
    velocity.text(0, 0.06, "stagnant zone shaded", ha="center", fontsize=7, color="0.35")
    angle.legend(loc="upper left", bbox_to_anchor=(0.0, 0.86))
    for sign in (-1, 1):
        angle.axhline(sign * pi / 4, color="0.35", linewidth=0.8, linestyle=":")
    angle.set_ylim(-0.95, 0.95)
    angle.set_yticks(np.array([-1, -0.5, 0, 0.5, 1]) * pi / 4)
    angle.set_yticklabels([r"$-\pi/4$", r"$-\pi/8$", "0", r"$\pi/8$", r"$\pi/4$"])
    angle.set_ylabel(r"Sokolovskii angle $\psi$ (radians)")
    plotting.letter(axes)
    return figure


def _shade(axis: Axes, start: float, stop: float) -> None:
    for low, high in ((start, stop), (-stop, -start)):
        axis.axvspan(low, high, color="0.9", linewidth=0)


_COLORS = (plotting.BLUE, plotting.ORANGE)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
