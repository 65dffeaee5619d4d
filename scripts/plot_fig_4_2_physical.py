"""Figure 4.2 in the physical formulation: modes of the flow's parity approach the line."""

import numpy as np
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(wedge: str, cone: str, wedge_line: str, cone_line: str) -> Figure:
    """Plot the kept modes with the line (top), and their distance to it (bottom)."""
    figure, axes = plotting.subplots(2, 2, height=5.2)
    columns = (("wedge", wedge, wedge_line), ("cone", cone, cone_line))
    for column, (geometry, spectrum, stability) in enumerate(columns):
        data, line = reading.read(spectrum), float(reading.read(stability).line)
        kept = (data.kept.to_numpy() == "yes") & (data.half.to_numpy() == "physical")
        modes = data.eigenvalue.to_numpy()[kept]
        upper = modes[modes.imag >= 0]
        color = plotting.GEOMETRY_COLORS[geometry]
        top, bottom = axes[:, column]
        top.axvline(0, color="0.5", linewidth=0.6)
        top.axvline(line, color=plotting.BLACK, linewidth=0.4, linestyle="--")
        top.plot(upper.real, upper.imag, "o", markersize=1.5, mew=0, color=color)
        top.set_title(f"{geometry}, physical formulation: {modes.size} modes")
        top.set_xlabel(r"Re $\lambda$")
        top.set_ylabel(r"Im $\lambda$ (conjugates not drawn)")
        top.margins(x=0.12)
        top.set_ylim(bottom=0)
        upper = upper[upper.imag > 0]
        bottom.axvline(0, color=plotting.BLACK, linewidth=0.8, linestyle="--")
        bottom.plot(upper.real - line, upper.imag, "o-", markersize=2, linewidth=0.5, color=color)
        bottom.set_yscale("log")
        at = plotting.signed(line, ".6f")
        bottom.set_title(rf"{geometry}: approach to the line $\Lambda$ = {at}")
        bottom.set_xlabel(r"Re $\lambda - \Lambda$")
        bottom.set_ylabel(r"Im $\lambda$")
        widest = float(np.abs(upper.real - line).max(initial=np.finfo(float).tiny))
        bottom.set_xlim(-1.15 * widest, 1.15 * widest)
        bottom.ticklabel_format(axis="x", style="sci", scilimits=(-2, 2), useMathText=True)
    plotting.below(figure, _KEYS, 3)
    return figure


_KEYS = (
    plotting.key("mode, wedge", linestyle="", marker="o", color=plotting.BLUE),
    plotting.key("mode, cone", linestyle="", marker="o", color=plotting.ORANGE),
    plotting.key(r"line $\Lambda$", linestyle="--", color=plotting.BLACK),
)

if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
