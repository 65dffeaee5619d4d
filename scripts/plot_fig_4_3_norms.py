"""Figure 4.3 in other norms: which part of the oscillation belongs to the norm."""

from matplotlib.figure import Figure

from hopper_workflow import artifacts, jobs, plotting


def draw(wedge: str, cone: str) -> Figure:
    """Plot the growth relative to exp(-t alpha), a row for each set of kept modes."""
    panels = [artifacts.read(path) for path in (wedge, cone)]
    figure, axes = plotting.subplots(2, 2, height=4.6, sharex=True)
    for column, (data, title) in enumerate(zip(panels, ("wedge", "cone"), strict=True)):
        for row, mode in enumerate(data["kept_in"].values):
            axis = axes[row, column]
            case = data.isel(kept_in=row)
            relative = case.growth / case.lower_bound
            for i, (norm, color) in enumerate(_NORMS):
                for j, style in enumerate(("-", ":")):
                    scale = float(data.psi_scale[j])
                    axis.semilogy(
                        data.elapsed,
                        relative.isel(norm=i, psi_scale=j),
                        color=color,
                        linestyle=style,
                        linewidth=0.9,
                        label=rf"{norm}, $\psi$ scale {scale:g}",
                    )
            axis.set_title(f"{title}, {mode} modes")
            axis.set_xlim(0, float(data.elapsed.max()))
            axis.set_ylim(bottom=0.9)
        axes[1, column].set_xlabel(r"$-t = -\log r$")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"$\|\exp(-t M)\|\, e^{t\alpha}$")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


_NORMS = (("discrete", plotting.BLUE), ("$L_2$", plotting.ORANGE))

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
