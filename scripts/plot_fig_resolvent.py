"""Resolvent norm along the imaginary axis, and the Kreiss bound against the measured growth."""

from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(wedge_paper: str, cone_paper: str, wedge_physical: str, cone_physical: str) -> Figure:
    """Plot the resolvent (top) and the relative growth with its Kreiss bound (bottom)."""
    figure, axes = plotting.subplots(2, 2, height=5.0)
    paths = (("wedge", wedge_paper, wedge_physical), ("cone", cone_paper, cone_physical))
    for column, (geometry, paper, physical) in enumerate(paths):
        top, bottom = axes[:, column]
        for mode, path, color in (
            ("paper", paper, plotting.BLUE),
            ("physical", physical, plotting.ORANGE),
        ):
            data = artifacts.read(path)
            top.semilogy(data.frequency, data.resolvent, color=color, linewidth=0.9,
                         label=f"{mode}, full matrix")  # fmt: skip
            top.semilogy(data.frequency, data.resolvent_kept, color=color, linewidth=0.9,
                         linestyle="--", label=f"{mode}, kept modes")  # fmt: skip
            bottom.semilogy(data.elapsed, data.relative_growth, color=color, linewidth=0.9,
                            label=f"{mode}")  # fmt: skip
            bottom.axhline(float(data.kreiss_bound), color=color, linestyle="--", linewidth=0.9,
                           label=f"{mode}, Kreiss bound")  # fmt: skip
        near = [float(artifacts.read(path).distance) for path in (paper, physical)]
        top.set_title(f"{geometry}: distance {near[0]:.2g} (paper), {near[1]:.2g} (physical)")
        top.set_xlabel(r"$y$")
        top.set_ylabel(r"$\|(iy - M)^{-1}\|$")
        top.set_xlim(0, float(data.frequency.max()))
        bottom.set_title(f"{geometry}: growth")
        bottom.set_xlabel(r"$-t = -\log r$")
        bottom.set_ylabel(r"$\|\exp(-t M)\|\, e^{t\alpha}$")
        bottom.set_xlim(0, float(data.elapsed.max()))
    for row, place in ((1, "outside lower center"), (0, "outside upper center")):
        figure.legend(*axes[row, 0].get_legend_handles_labels(), loc=place, ncols=4)
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
