"""One page on a hopper of the list `cases`: verdict, fields, spectrum, and the numbers."""

import textwrap
from typing import Any

import xarray as xr
from matplotlib.axes import Axes

from hopper_workflow import jobs, plotting, reading
from hopper_cli import drawing, text
from hopper_data.tables import Row, number


def plot_case(
    artifact: str, png: str, pdf: str, *, case: dict[str, Any], middle: dict[str, Any]
) -> None:
    """Plot what the artifact holds; of a part that does not exist the numbers tell the reason.

    ``middle`` has the numbers of the hopper in the middle of the ranges.
    """
    data = reading.read(artifact)
    profiles = {key: data[key].to_numpy() for key in _FIELDS if key in data.variables}
    rows = ["fields"] * ("sigma" in profiles) + ["numbers"]
    heights = {"fields": 2.4, "numbers": 2.9}
    figure, place = plotting.subplots(height=0.5 + sum(heights[row] for row in rows))
    place.remove()
    figure.suptitle(_title(data, case, middle), fontsize=8)
    parts = figure.subfigures(len(rows), 1, height_ratios=[heights[row] for row in rows])
    if len(rows) == 1:
        parts = [parts]
    if "sigma" in profiles:
        panels = parts[0].subplots(1, 3 if "u" in profiles else 2)
        drawing.draw_fields(panels, middle["delta_deg"], profiles)
    if "eigenvalue" in data:
        spectrum, numbers = parts[-1].subplots(1, 2, width_ratios=[1, 1.7])
        modes = data.eigenvalue.to_numpy()
        if "line" in data:
            drawing.draw_spectrum(spectrum, modes, float(data.line))
        else:
            strips = data.strips.to_numpy() if "strips" in data else None
            drawing.draw_coupled_spectrum(spectrum, modes, strips)
    else:
        numbers = parts[-1].subplots()
    _write_numbers(numbers, data)
    plotting.save(figure, png, pdf)


def _title(data: xr.Dataset, case: dict[str, Any], middle: dict[str, Any]) -> str:
    given = {key: value for key, value in middle.items() if key != "phi_deg"}
    verdict = data.outcome.item().replace("_", " ")
    words = [case["name"].replace("_", " "), case.get("description", "")]
    title = f"{drawing.title(verdict, **given)}\n{': '.join(filter(None, words))}"
    if "shares" not in data.attrs:
        return title
    shares = textwrap.fill(f"In the middle of the given range, of which: {data.shares}", 110)
    return f"{title}\n{drawing.typeset(shares)}"


def _write_numbers(axis: Axes, data: xr.Dataset) -> None:
    """Write a table of every number that has an error, and the reason for what is missing."""
    axis.axis("off")
    rows = [
        Row(number(str(key), item.long_name, units=item.units), float(item), float(error))
        for key, item in data.items()
        if item.ndim == 0 and (error := data.get(f"{key}_error")) is not None
    ]
    small = {"fontsize": plotting.SMALL, "va": "top"}
    for line, (label, value) in enumerate(text.number_cells(rows)):
        axis.text(0.0, 1 - 0.056 * line, label, **small)
        axis.text(0.66, 1 - 0.056 * line, drawing.typeset(value), **small)
    if reason := data.attrs.get("comment", ""):
        axis.text(0.0, 0.0, textwrap.fill(reason, 70), **{**small, "va": "bottom"})


_FIELDS = ("theta", "sigma", "psi", "u")

if __name__ == "__main__":
    jobs.run(plot_case)
