"""How the stable domain of cones shrinks with the half opening angle."""

import numpy as np
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str) -> Figure:
    """Plot the area of the domain and the neutral delta at several wall frictions."""
    data = reading.read(artifact)
    figure, (left, right) = plotting.subplots(1, 2, height=3.2)
    angles = data.half_angle
    left.plot(angles, data.area, "o-", color=plotting.BLUE, label="stable")
    reached = {"color": plotting.ORANGE, "label": r"the same with $\psi < \pi/4$"}
    left.plot(angles, data.area_reached, "s--", **reached)
    left.set_ylim(0, 1.25 * float(data.area.max()))
    left.legend(loc="upper right")
    left.set_ylabel("area of the stable domain (square degrees)")
    for phi, look in zip(data.phi.values, plotting.series(data.sizes["phi"]), strict=True):
        curve = data.neutral_delta.sel(phi=phi)
        if np.isfinite(curve).any():
            marks = {"linestyle": "none", "marker": look.pop("marker")}
            label = rf"$\phi$ = {phi:g}°"
            (line,) = right.plot(data.curve_half_angle, data.curve_delta.sel(phi=phi), **look)
            right.plot(angles, curve, color=line.get_color(), label=label, **marks)
    right.set_ylabel(r"neutral $\delta$ (degrees)")
    bottom, top = right.get_ylim()
    right.set_ylim(bottom, top + 0.35 * (top - bottom))
    right.legend(ncols=3, loc="upper left")
    for axis in (left, right):
        axis.set_xlabel(r"half opening angle $\vartheta_w$ (degrees)")
        axis.set_xlim(0, float(angles.max()) * 1.03)
        axis.set_title("cone, physical formulation")
    plotting.letter((left, right))
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
