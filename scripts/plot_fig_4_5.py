"""Figure 4.5: the stable domain of cones in the plane of internal and wall friction."""

from collections.abc import Sequence

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import artifacts, domains, jobs, plotting


def draw(
    borders: Sequence[str],
    papers: Sequence[str],
    *,
    half_angles_deg: Sequence[float],
    largest_phi_deg: float,
) -> Figure:
    """Draw the domain for each half angle, then the borders of all over each other."""
    figure, axes = plotting.subplots(
        1, len(borders) + 1, height=3.4, sharex=True, sharey=True, squeeze=False
    )
    *panels, last = axes.flat
    for index, (axis, path, paper, angle) in enumerate(
        zip(panels, borders, papers, half_angles_deg, strict=True)
    ):
        data = artifacts.read(path)
        domains.shade(axis, data)
        domains.draw_borders(axis, data)
        _draw_paper(axis, artifacts.read(paper))
        axis.set_title(rf"cone, $\vartheta_w$ = {angle:g}°")
        domains.outline(last, data, **_OUTLINES[index % len(_OUTLINES)], label=f"{angle:g}°")
    last.set_title("both" if len(borders) == 2 else "all")
    last.legend(title=r"stable inside, $\vartheta_w$", loc="lower right")
    axes[0, 0].set_ylim(0, largest_phi_deg)
    for axis in axes.flat:
        axis.set_xlabel(r"internal friction $\delta$ (degrees)")
    axes[0, 0].set_ylabel(r"wall friction $\phi$ (degrees)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _draw_paper(axis: Axes, data: xr.Dataset) -> None:
    """Mark sign changes of the paper's abscissa, and where it jumps."""
    jump = (data.jump == "yes").values
    for chosen, marker, label in (
        (~jump, "o", "neutral by the paper's algorithm"),
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


_OUTLINES = (
    {"color": plotting.BLACK, "linestyle": "-"},
    {"color": plotting.ORANGE, "linestyle": "--"},
    {"color": plotting.BLUE, "linestyle": "-."},
    {"color": plotting.GREEN, "linestyle": ":"},
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
