"""Validation figure: published flow-factor points over computed curves."""

import numpy as np
from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(artifact: str) -> Figure:
    """Plot flow factor over wall friction, a panel for each geometry, a colour for each angle."""
    data = artifacts.read(artifact)
    figure, axes = plotting.subplots(1, 2, height=3.0, sharey=True)
    angles = np.unique(data.curve_half_angle)
    colors = dict(zip(angles, plotting.sequence(len(angles)), strict=True))
    for axis, geometry in zip(axes, ("wedge", "cone"), strict=True):
        for curve in np.flatnonzero(data.curve_geometry == geometry):
            angle = float(data.curve_half_angle[curve])
            axis.plot(data.phi, data.curve_flow_factor[curve], color=colors[angle])
            points = data.isel(
                point=np.flatnonzero(
                    (data.point_geometry == geometry) & (data.point_half_angle == angle)
                )
            )
            axis.plot(
                points.point_phi,
                points.published,
                "o",
                color=colors[angle],
                markeredgecolor="black",
                markeredgewidth=0.4,
                label=f"{angle:g}°",
            )
        axis.set_title(geometry)
        axis.set_xlabel(r"wall friction angle $\phi$ (degrees)")
        axis.set_xlim(0, float(data.phi.max()))
        axis.set_ylim(1.2, 4.4)
        axis.legend(title=r"half angle $\vartheta_w$", title_fontsize=7, ncols=2)
    axes[0].set_ylabel("flow factor $ff$")
    rms = 100 * float(data.rms_deviation)
    note = f"lines: computed\npoints: published chart\nRMS {rms:.1f} %"
    axes[0].text(0.97, 0.45, note, transform=axes[0].transAxes, ha="right", fontsize=7)
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
