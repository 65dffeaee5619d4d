"""Figure 3.2 and others of its kind: velocity and psi, with the stagnant zone if one is given."""

from math import pi

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str, *, stagnant_from_deg: float | None) -> Figure:
    """Plot u and psi of every model and wall friction; shade what the paper calls stagnant."""
    data = reading.read(artifact)
    half_angle = float(data.theta.max())
    figure, axes = plotting.subplots(1, 2, height=3.1)
    looks = plotting.series(data.sizes["mu"])
    for axis, name in zip(axes, ("u", "psi"), strict=True):
        if stagnant_from_deg is not None:
            _shade(axis, stagnant_from_deg, half_angle)
        for model in data.model.values:
            style = plotting.MODEL_STYLES[model]["linestyle"]
            for mu, look in zip(data.mu.values, looks, strict=True):
                axis.plot(data.theta, data[name].sel(model=model, mu=mu), linestyle=style, **look)
        plotting.degree_ticks(axis, half_angle, 10)
        axis.set_xlabel(r"angle $\vartheta$ (degrees)")
    velocity, angle = axes
    velocity.set_ylim(0, 1.05)
    velocity.set_ylabel(r"velocity $u(\vartheta)/u(0)$")
    for sign in (-1, 1):
        angle.axhline(sign * pi / 4, color="0.35", linewidth=0.8, linestyle=":")
    angle.set_ylim(-0.95, 0.95)
    angle.set_yticks(np.array([-1, -0.5, 0, 0.5, 1]) * pi / 4)
    angle.set_yticklabels([r"$-\pi/4$", r"$-\pi/8$", "0", r"$\pi/8$", r"$\pi/4$"])
    angle.set_ylabel(r"Sokolovskii angle $\psi$ (radians)")
    plotting.letter(axes)
    figure.suptitle(plotting.hopper_of(data), fontsize=8)
    models = [plotting.key(**plotting.MODEL_STYLES[model]) for model in data.model.values]
    frictions = [
        plotting.key(rf"$\mu$ = {mu:g}", color=look["color"], marker=look["marker"])
        for mu, look in zip(data.mu.values, looks, strict=True)
    ]
    plotting.below(figure, [*frictions, *models], 5)
    return figure


def _shade(axis: Axes, start: float, stop: float) -> None:
    """Shade the zone at both walls, and say so in it where the curves leave room."""
    for low, high in ((start, stop), (-stop, -start)):
        axis.axvspan(low, high, color="0.88", linewidth=0)
        at = ((low + high) / 2, 0.97 if axis.get_subplotspec().is_first_col() or low < 0 else 0.03)
        axis.text(
            *at,
            "essentially stagnant",
            transform=axis.get_xaxis_transform(),
            rotation=90,
            ha="center",
            va="top" if at[1] > 0.5 else "bottom",
            fontsize=plotting.SMALL,
        )


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
