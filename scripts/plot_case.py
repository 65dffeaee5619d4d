"""One page on a hopper of the list `cases`: fields, spectrum, and the numbers."""

import textwrap

import xarray as xr
from matplotlib.axes import Axes

from hopper_workflow import artifacts, jobs, plotting
from hopper_cli import drawing, text
from hopper_data.tables import Row, number


def plot_case(artifact: str, png: str, pdf: str, *, description: str, delta_deg: float) -> None:
    """Plot what the artifact holds; where a part does not exist, say why."""
    data = artifacts.read(artifact)
    figure, axes = plotting.subplots(2, 3, height=5.2)
    figure.suptitle("\n".join(filter(None, [data.attrs["title"], description])), fontsize=8)
    if "sigma" in data:
        profiles = {key: data[key].to_numpy() for key in _FIELDS if key in data.variables}
        drawing.draw_fields(axes[0], delta_deg, profiles)
    else:
        for axis in axes[0]:
            drawing.say(axis, "no radial solution")
    spectrum, *rest = axes[1]
    if "line" in data:
        drawing.draw_spectrum(spectrum, data.eigenvalue.to_numpy(), float(data.line))
    else:
        drawing.say(spectrum, "no spectrum")
    for axis in rest:
        axis.remove()
    _write_numbers(figure.add_subplot(spectrum.get_gridspec()[1, 1:]), data)
    plotting.save(figure, png, pdf)


def _write_numbers(axis: Axes, data: xr.Dataset) -> None:
    """Write the outcome, a table of every number that has an error, and the reason, if any."""
    axis.axis("off")
    outcome = data.outcome.item().replace("_", " ")
    axis.set_title(f"outcome: {outcome}", fontweight="bold")
    rows = [
        Row(number(str(key), item.long_name, units=item.units), float(item), float(error))
        for key, item in data.items()
        if item.ndim == 0 and (error := data.get(f"{key}_error")) is not None
    ]
    for line, cells in enumerate(text.number_cells(rows)):
        for x, words in zip((0.04, 0.62), cells, strict=True):
            axis.text(x, 0.97 - 0.06 * line, words, fontsize=6.5, va="top")
    reason = textwrap.fill(data.attrs.get("comment", ""), 90)
    axis.text(0.04, 0, reason, fontsize=6.5, va="bottom")


_FIELDS = ("theta", "sigma", "psi", "u")

if __name__ == "__main__":
    jobs.run(plot_case)
