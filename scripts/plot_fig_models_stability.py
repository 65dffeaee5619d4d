"""What Mohr-Coulomb and von Mises say of the stability of the same cones."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from hopper_workflow import domains as mohr_coulomb
from hopper_workflow import jobs, plotting, reading, von_mises_domains


def draw(
    borders: Sequence[str],
    domains: Sequence[str],
    maps: Sequence[str],
    *,
    half_angles_deg: Sequence[float],
) -> Figure:
    """Draw a row for each half angle: left Mohr-Coulomb, right von Mises."""
    rows = len(borders)
    figure, axes = plotting.subplots(
        rows, 2, height=2.6 * rows + 0.8, squeeze=False, sharex=True, sharey=True
    )
    for row, border, domain, cells, angle in zip(
        axes, borders, domains, maps, half_angles_deg, strict=True
    ):
        known, data, verdicts = map(reading.read, (border, domain, cells))
        mohr_coulomb.shade(row[0], known)
        mohr_coulomb.draw_borders(row[0], known)
        mohr_coulomb.name_regions(row[0], known)
        von_mises_domains.shade(row[1], data)
        von_mises_domains.draw_borders(row[1], data)
        von_mises_domains.mark_unresolved(row[1], verdicts)
        von_mises_domains.name_regions(row[1], data)
        for axis, model in zip(row, ("Mohr-Coulomb", "von Mises"), strict=True):
            axis.set_title(rf"{model}, cone, $\vartheta_w$ = {angle:g}°")
            axis.set_xlim(float(verdicts.delta.min()), float(data.tension))
            axis.set_ylim(0, von_mises_domains.top(verdicts))
        row[0].set_ylabel(r"wall friction $\phi$ (degrees)")
    for axis in axes[-1]:
        axis.set_xlabel(r"internal friction $\delta$ (degrees)")
    plotting.letter(axes.flat)
    plotting.below(figure, plotting.all_keys(axes.flat), 3)
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
