"""Design charts of one geometry: a column for each internal friction."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading
from hopper_cli import chart_drawing


def draw(artifact: str, *, flow_factors: Sequence[float]) -> Figure:
    """Plot limits of wall friction over the half angle, and contours of the flow factor below."""
    data = reading.read(artifact)
    geometry = plotting.parameters_of(data)["geometry"]
    count = data.sizes["delta"]
    figure, axes = plotting.subplots(2, count, height=4.7, sharex=True, sharey=True, squeeze=False)
    for column, delta in zip(axes.T, data.delta.values, strict=True):
        one = data.sel(delta=delta)
        one = one.isel(point=one.half_angle.notnull().values)
        half_angle = one.half_angle.values
        lines = {name: one[f"{name}_phi"].values for name in chart_drawing.LINES}
        chart_drawing.draw_limits(column[0], geometry, half_angle, lines)
        shown = one.phi.values, one.flow_factor.values
        chart_drawing.draw_flow_factors(column[1], half_angle, *shown, sorted(flow_factors))
        column[0].set_title(rf"{geometry}, $\delta$ = {delta:g}°")
        column[1].set_title("flow factor")
        column[0].set_xlim(0, float(data.half_angle.max()))
    axes[0, 0].set_ylim(0, 1.02 * float(data.limit_phi.max()))
    chart_drawing.label(axes[1], left=True)
    axes[0, 0].set_ylabel(axes[1, 0].get_ylabel())
    plotting.letter(axes.ravel())
    plotting.below(figure, chart_drawing.keys(geometry), 4)
    return figure


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
