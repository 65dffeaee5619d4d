"""Validation figure: published flow-factor points over computed curves."""

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str) -> Figure:
    """Plot flow factor over wall friction, a panel for each geometry, a look for each angle."""
    data = reading.read(artifact)
    figure, axes = plotting.subplots(1, 2, height=3.4, sharey=True)
    angles = np.unique(data.curve_half_angle)
    looks = dict(zip(angles, plotting.series(len(angles)), strict=True))
    for axis, geometry in zip(axes, plotting.GEOMETRIES, strict=True):
        for curve in np.flatnonzero(data.curve_geometry == geometry):
            angle = float(data.curve_half_angle[curve])
            color, marker = looks[angle]["color"], looks[angle]["marker"]
            axis.plot(data.phi, data.curve_flow_factor[curve], color=color)
            here = (data.point_geometry == geometry) & (data.point_half_angle == angle)
            points = data.isel(point=np.flatnonzero(here))
            points_look = {"color": color, "mec": "black", "mew": 0.4, "markersize": 4.5}
            axis.plot(points.point_phi, points.published, marker, **points_look)
        axis.set_title(f"{geometry}, {_agreement(data, geometry)}")
        axis.set_xlabel(r"wall friction angle $\phi$ (degrees)")
        axis.set_xlim(0, float(data.phi.max()))
        axis.set_ylim(1.2, 4.4)
    axes[0].set_ylabel("flow factor $ff$")
    figure.suptitle(
        rf"Jenike's chart of flow factors, $\delta$ = {float(data.delta):g}°: "
        "lines computed, points read off the chart",
        fontsize=8,
    )
    keys = [
        plotting.key(rf"$\vartheta_w$ = {angle:g}°", color=look["color"], marker=look["marker"])
        for angle, look in looks.items()
    ]
    plotting.below(figure, keys, 5)
    return figure


def _agreement(data: xr.Dataset, geometry: str) -> str:
    return f"RMS deviation {100 * float(data.rms.sel(geometry=geometry)):.1f} %"


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
