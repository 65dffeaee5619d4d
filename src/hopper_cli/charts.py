"""What ``hopper chart`` answers: the design chart of a material, in a file."""

import os
from argparse import Namespace
from math import radians

os.environ["MPLBACKEND"] = "Agg"  # with one that it does not know Matplotlib does not load

import numpy as np
from matplotlib import style
from matplotlib.figure import Figure

from hopper.design.charts import Chart, chart
from hopper.problem import as_geometry
from hopper_cli import chart_drawing, drawing
from hopper_cli.errors import UsageError
from hopper_cli.figures import METADATA
from hopper_data.files import replacing

# Half angles, degrees, and wall frictions at each.
_FIRST, _LAST, _POINTS, _FRICTIONS = 1.0, 50.0, 25, 20


def answer(options: Namespace) -> str:
    """Draw the chart, and return where it is.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    angles = np.radians(np.linspace(_FIRST, _LAST, _POINTS))
    found = chart(as_geometry(options.geometry), radians(options.delta), angles, _FRICTIONS)
    with style.context(["default", drawing.STYLE]):
        figure = _figure(options.geometry, options.delta, found)
        try:
            with replacing(options.out) as temporary:
                figure.savefig(temporary, metadata=METADATA[options.out.suffix.lower()])
        except OSError as error:
            raise UsageError(f"argument --out: {options.out} cannot be written: {error}") from error
    return f"The design chart of a {options.geometry}, delta {options.delta:g} deg: {options.out}."


def _figure(geometry: str, delta_deg: float, found: Chart) -> Figure:
    figure = Figure(figsize=(7.1, 3.9))
    axes = figure.subplots(1, 2, sharey=True)
    half_angle = np.degrees(found.half_angle)
    lines = {name: np.degrees(getattr(found, name).friction_angle) for name in chart_drawing.LINES}
    chart_drawing.draw_limits(axes[0], geometry, half_angle, lines)
    chart_drawing.draw_flow_factors(
        axes[1],
        half_angle,
        np.degrees(found.friction_angle),
        found.flow_factor,
        chart_drawing.FLOW_FACTORS,
    )
    for axis in axes:
        axis.set_xlim(0, _LAST)
    axes[0].set_ylim(0, 1.02 * float(np.nanmax(lines["limit"])))
    axes[0].set_title(rf"{geometry}, $\delta$ = {delta_deg:g}°: limits")
    axes[1].set_title("flow factor")
    chart_drawing.label(axes, left=True)
    figure.legend(handles=chart_drawing.keys(geometry), loc="outside lower center", ncols=2)
    return figure
