"""Figure 4.1: abscissa of the line of eigenvalues over delta, smooth walls."""

from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str) -> Figure:
    """Plot both abscissae with the thresholds the paper marks."""
    data = reading.read(artifact)
    figure, axis = plotting.subplots(width=plotting.COLUMN_WIDTH, height=2.7)
    axis.axhline(0, color="0.5", linewidth=0.6)
    for geometry, label, style in (("wedge", "2-d (wedge)", "-"), ("cone", "3-d (cone)", "--")):
        curve = data.abscissa.sel(geometry=geometry)
        color = plotting.GEOMETRY_COLORS[geometry]
        axis.plot(data.delta, curve, linestyle=style, color=color, label=label)
        neutral = float(data.neutral_delta.sel(geometry=geometry))
        axis.plot(neutral, 0, "o", color=color)
        shift, side = ((4, 4), "left") if geometry == "wedge" else ((-5, -10), "right")
        axis.annotate(
            f"{neutral:.2f}°",
            (neutral, 0),
            shift,
            textcoords="offset points",
            color=color,
            fontsize=7,
            ha=side,
        )
    crossing = float(data.crossing_delta), float(data.crossing_abscissa)
    axis.plot(*crossing, "o", color=plotting.BLACK)
    axis.annotate(f"{crossing[0]:.2f}°", crossing, (5, 4), textcoords="offset points", fontsize=7)
    axis.text(2, 0.2, "unstable", fontsize=7, color="0.35")
    axis.text(2, -0.45, "stable", fontsize=7, color="0.35")
    axis.set_xlim(float(data.delta.min()), float(data.delta.max()))
    axis.set_ylim(-4, 3)
    axis.set_xlabel(r"internal angle of friction $\delta$ (degrees)")
    axis.set_ylabel("abscissa of the line of eigenvalues")
    axis.legend(loc="upper right")
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
