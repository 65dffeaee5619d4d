"""How the stable domain, its borders and its maps are drawn."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from hopper_workflow import plotting

_SHADES = {
    "no radial solution": "0.93",
    "beyond the tangency": "0.8",
    "unstable": plotting.AMBER,
    "stable": plotting.SKY,
}


def shade(axis: Axes, data: xr.Dataset) -> None:
    """Fill the regions; each lies on the one before it."""
    delta, limit = data.delta.values, np.nan_to_num(data.limit_phi.values)
    tangency = np.nan_to_num(data.tangency_phi.values)
    tops = {
        "no radial solution": delta,
        "beyond the tangency": np.minimum(limit, delta),
        "unstable": np.minimum(tangency, delta),
    }
    for kind, top in tops.items():
        axis.fill_between(delta, 0, top, color=_SHADES[kind], linewidth=0, label=kind)
    beyond = (delta > data.neutral_delta.values[-1]) & (tangency > 0)
    right = delta[beyond]
    closing = right[-1:] if beyond[-1] else data.delta.values[np.append(False, beyond[:-1])][-1:]
    axis.fill(
        np.concatenate([data.neutral_delta, right, closing]),
        np.concatenate([data.neutral_phi, tangency[beyond], np.zeros(closing.size)]),
        color=_SHADES["stable"],
        linewidth=0,
        label="stable",
    )


def draw_borders(axis: Axes, data: xr.Dataset) -> None:
    """Draw the neutral curve and the borders the paper leaves out."""
    delta = data.delta.values
    axis.plot(delta, delta, color=plotting.BLACK, linewidth=0.8, label=r"$\phi = \delta$")
    axis.plot(
        delta,
        data.limit_phi,
        color=plotting.PURPLE,
        linestyle="-.",
        label="largest friction with a solution",
    )
    axis.plot(
        delta,
        data.singular_velocity_phi,
        color=plotting.GREEN,
        linestyle=":",
        label=r"$\psi = \pi/4$",
    )
    axis.plot(
        delta,
        data.tangency_phi,
        color=plotting.ORANGE,
        linestyle="--",
        label=r"tangency, $\psi = \pi/4 - \delta/2$",
    )
    axis.plot(
        data.neutral_delta,
        data.neutral_phi,
        color=plotting.BLUE,
        linewidth=1.6,
        label="neutral stability",
    )
    axis.set_xlim(delta.min(), delta.max())


def thinned(data: xr.Dataset, most: int) -> xr.Dataset:
    """Return every n-th row and column of a map, at most ``most`` of each; all if no more."""
    return data.isel({name: slice(None, None, -(-data.sizes[name] // most)) for name in data.dims})
