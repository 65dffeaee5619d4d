"""How the stable domain of cones shrinks with the half opening angle."""

import numpy as np
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(artifact: str) -> Figure:
    """Plot the area of the domain and the neutral delta at several wall frictions."""
    data = artifacts.read(artifact)
    figure, (left, right) = plotting.subplots(1, 2, height=2.8)
    left.plot(data.half_angle, data.area, "o-", color=plotting.BLUE, label="stable")
    left.plot(
        data.half_angle,
        data.area_reached,
        "s--",
        color=plotting.ORANGE,
        label=r"the same with $\psi < \pi/4$",
    )
    left.set_ylim(bottom=0)
    left.legend()
    left.set_ylabel("area of the stable domain (square degrees)")
    for index, color in enumerate(plotting.sequence(data.sizes["phi"])):
        curve = data.neutral_delta.isel(phi=index)
        if np.isfinite(curve).any():
            right.plot(
                data.half_angle,
                curve,
                "o-",
                color=color,
                label=rf"$\phi$ = {float(data.phi[index]):g}°",
            )
    right.set_ylabel(r"neutral $\delta$ (degrees)")
    right.legend(ncols=2)
    for axis in (left, right):
        axis.set_xlabel(r"half opening angle $\vartheta_w$ (degrees)")
        axis.set_xlim(0, float(data.half_angle.max()) * 1.03)
    plotting.letter((left, right))
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
