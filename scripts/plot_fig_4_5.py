"""Figure 4.5: the stable domain of cones in the plane of internal and wall friction."""

from collections.abc import Sequence
from typing import Any

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import domains, jobs, plotting, reading


def draw(
    borders: Sequence[str],
    papers: Sequence[str],
    *,
    half_angles_deg: Sequence[float],
    largest_phi_deg: float,
) -> Figure:
    """Draw the domain for each half angle, then the borders of all over each other."""
    figure, axes = plotting.grid(len(borders) + 1, 3, height=2.9, sharex=True, sharey=True)
    *panels, last = axes
    looks = _outlines(len(borders))
    for axis, path, paper, angle, look in zip(
        panels, borders, papers, half_angles_deg, looks, strict=True
    ):
        data = reading.read(path)
        domains.shade(axis, data)
        domains.draw_borders(axis, data)
        _draw_paper(axis, reading.read(paper))
        domains.name_regions(axis, data)
        axis.set_title(rf"cone, $\vartheta_w$ = {angle:g}°")
        domains.outline(last, data, **look, label=rf"$\vartheta_w$ = {angle:g}°")
    last.set_title("stable below and right of the lines")
    axes[0].set_ylim(0, largest_phi_deg)
    for axis in axes:
        axis.set_xlabel(r"internal friction $\delta$ (degrees)")
        axis.set_ylabel(r"wall friction $\phi$ (degrees)")
    last.legend(loc="best")
    figure.suptitle("Cones: curves in the physical formulation, points in the paper's", fontsize=8)
    plotting.below(figure, plotting.all_keys(panels), 3)
    return figure


def _outlines(count: int) -> list[dict[str, Any]]:
    dashes = ("-", "--", "-.", ":")
    return [
        {"color": color, "linestyle": dashes[index % len(dashes)], "linewidth": 1 + 0.1 * index}
        for index, color in enumerate(plotting.sequence(count))
    ]


def _draw_paper(axis: Axes, data: xr.Dataset) -> None:
    """Mark sign changes of the paper's abscissa, and where it jumps."""
    jump = (data.jump == "yes").values
    for chosen, marker, label in (
        (~jump, "o", "neutral in the paper's formulation"),
        (jump, "x", "its abscissa jumps"),
    ):
        axis.plot(
            data.change_delta[chosen],
            data.change_phi[chosen],
            marker,
            color=plotting.BLACK,
            markersize=3.2,
            mfc="none",
            mew=0.8,
            label=label,
        )


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
