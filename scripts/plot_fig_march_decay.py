"""Return of the stress to the radial field, beside the linear prediction."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from hopper_workflow import jobs, plotting, reading


def draw(artifact: str) -> Figure:
    """Plot the distance from the radial field over the depth, a panel for each hopper."""
    data = reading.read(artifact)
    figure, axes = plotting.grid(data.sizes["hopper"], 2, height=2.9, sharey=True)
    for index, axis in enumerate(axes):
        _draw_hopper(axis, data.isel(hopper=index))
    for axis in axes[::2]:
        axis.set_ylabel(r"distance from the radial field (% of $\sigma$)")
    plotting.below(figure, plotting.all_keys(axes), 3)
    return figure


def _draw_hopper(axis: Axes, data: xr.Dataset) -> None:
    tau, linear = data.tau.to_numpy(), 100 * data.linear.to_numpy()
    for eps, look in zip(data.eps.to_numpy(), plotting.series(data.sizes["eps"]), strict=True):
        axis.semilogy(tau, eps * linear, color="0.6", linewidth=2.4, label="linearised equations")
        axis.semilogy(
            tau, 100 * data.distance.sel(eps=eps), label=rf"march, $\epsilon$ = {eps:g}", **look
        )
    # Through the last part of the smallest curve, shifted down where it hides nothing.
    anchor = 0.3 * float(data.eps[0]) * float(np.nanmax(linear[tau > 0.7 * tau[-1]]))
    for rate, size, style, name in (
        (float(data.abscissa), anchor, "-.", r"$e^{\tau\,\mathrm{max\,Re}\,\lambda}$"),
        (float(data.line), anchor / 2, ":", r"$e^{\tau\Lambda}$ (line)"),
    ):
        decay = size * np.exp(rate * (tau - 0.85 * tau[-1]))
        axis.semilogy(tau, decay, color="black", linestyle=style, linewidth=0.9, label=name)
    for level in (5, 1):
        axis.axhline(level, color="0.4", linewidth=0.8, linestyle="--")
    axis.set_xlim(0, tau[-1])
    axis.set_title(str(data.hopper.item()))
    axis.set_xlabel(r"depth $\tau = \log(r_\mathrm{top}/r)$")


if __name__ == "__main__":
    jobs.run(plotting.saving(draw))
