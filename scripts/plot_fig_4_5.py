"""Figure 4.5: the stable domain of cones in the plane of internal and wall friction."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from hopper_workflow import artifacts, domains, jobs, plotting


def draw(
    borders: Sequence[str], *, half_angles_deg: Sequence[float], largest_phi_deg: float
) -> Figure:
    """Draw the domain for each half angle: what is stable, unstable, and not decided."""
    figure, axes = plotting.subplots(1, len(borders), height=3.6, sharey=True, squeeze=False)
    for axis, path, angle in zip(axes.flat, borders, half_angles_deg, strict=True):
        data = artifacts.read(path)
        domains.shade(axis, data)
        domains.draw_borders(axis, data)
        axis.set_ylim(0, largest_phi_deg)
        axis.set_title(rf"cone, $\vartheta_w$ = {angle:g}°")
        axis.set_xlabel(r"angle of internal friction $\delta$ (degrees)")
    axes[0, 0].set_ylabel(r"angle of wall friction $\phi$ (degrees)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
