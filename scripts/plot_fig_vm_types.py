"""Types and verdicts of von Mises cones in the plane of internal and wall friction."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading, von_mises_domains


def draw(
    maps: Sequence[str], domains: Sequence[str], *, half_angles_deg: Sequence[float]
) -> Figure:
    """Draw a panel for each half angle."""
    figure, axes = plotting.grid(len(maps), 2, height=2.9, sharex=True, sharey=True)
    for axis, path, domain, angle in zip(axes, maps, domains, half_angles_deg, strict=True):
        cells, data = reading.read(path), reading.read(domain)
        von_mises_domains.shade(axis, data)
        von_mises_domains.draw_borders(axis, data)
        von_mises_domains.mark_unresolved(axis, cells)
        von_mises_domains.name_regions(axis, data)
        axis.set_title(rf"von Mises cone, $\vartheta_w$ = {angle:g}°")
        axis.set_xlabel(r"internal friction $\delta$ (degrees)")
        axis.set_ylabel(r"wall friction $\phi$ (degrees)")
        axis.set_ylim(0, von_mises_domains.top(cells))
    plotting.letter(axes)
    plotting.below(figure, plotting.all_keys(axes), 4)
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
