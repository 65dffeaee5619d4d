"""How the stable domain, its borders and its maps are drawn."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from hopper_workflow import plotting

# Three luminances, told apart in grey.
_NO_SOLUTION, _UNSTABLE, _STABLE = "0.80", "#D98A1F", "#E3F3FB"


def shade(axis: Axes, data: xr.Dataset) -> None:
    """Fill the regions; each lies on the one before it."""
    delta, limit = data.delta.values, np.nan_to_num(data.limit_phi.values)
    axis.fill_between(delta, 0, delta, color=_NO_SOLUTION, linewidth=0, label="no radial solution")
    axis.fill_between(delta, 0, limit, color=_UNSTABLE, linewidth=0, label="unstable")
    axis.fill(*domain(data), color=_STABLE, linewidth=0, label="stable")
    hatch_unreached(axis, data)


def name_regions(axis: Axes, data: xr.Dataset) -> None:
    """Write into the regions what they are, where they are widest."""
    box = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 1}
    look = {"ha": "center", "va": "center", "fontsize": plotting.SMALL, "bbox": box}
    delta, phi = domain(data)
    row = 0.25 * phi.max()
    left = np.interp(row, data.neutral_phi, data.neutral_delta)
    axis.text((left + delta.max()) / 2, row, "stable", **look)
    first, limit = data.delta.values, np.nan_to_num(data.limit_phi.values)
    begin = first[limit > row].min(initial=first.max())
    if left - begin > 0.08 * np.ptp(first):
        axis.text((left + begin) / 2, row, "unstable", **look)


def outline(axis: Axes, data: xr.Dataset, **style: Any) -> None:
    """Draw the border of the stable domain, without its right edge."""
    delta, phi = domain(data)
    axis.plot(delta[:-1], phi[:-1], **style)


def domain(data: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Return the neutral curve, the limit from its end on, and the right lower corner."""
    delta, limit = data.delta.values, np.nan_to_num(data.limit_phi.values)
    beyond = (delta > data.neutral_delta.values[-1]) & (limit > 0)
    return (
        np.concatenate([data.neutral_delta, delta[beyond], delta[beyond][-1:]]),
        np.concatenate([data.neutral_phi, limit[beyond], [0.0]]),
    )


def hatch_unreached(axis: Axes, data: xr.Dataset) -> None:
    """Hatch where psi exceeds pi/4: stress and its stability are regular, the velocity is not."""
    lower = data.singular_velocity_phi.values
    axis.fill_between(
        data.delta.values,
        lower,
        data.limit_phi.values,
        where=np.isfinite(lower),
        facecolor="none",
        edgecolor="0.35",
        hatch="////",
        linewidth=0,
        label=r"hatched: $\psi > \pi/4$, no radial flow at the wall",
    )


def draw_borders(axis: Axes, data: xr.Dataset) -> None:
    """Draw the neutral curve, the limit of friction, and levels of psi that bound nothing."""
    delta = data.delta.values
    axis.plot(delta, delta, color="0.35", linewidth=0.6, label=r"$\phi = \delta$")
    axis.plot(
        delta,
        data.limit_phi,
        color=plotting.PURPLE,
        linestyle="-.",
        label="largest friction with a solution",
    )
    axis.plot(
        delta,
        data.tangency_phi,
        color="0.35",
        linestyle=":",
        linewidth=0.8,
        label=r"$r$ = const is characteristic, $\psi = \pi/4 - \delta/2$",
    )
    axis.plot(
        data.neutral_delta,
        data.neutral_phi,
        color=plotting.BLACK,
        linewidth=1.6,
        label="neutral stability",
    )
    if "symmetric_delta" in data:
        axis.plot(
            data.symmetric_delta,
            data.symmetric_phi,
            color=plotting.BLACK,
            linewidth=1.2,
            linestyle=(0, (4, 1.5)),
            label="the same, symmetric only",
        )
    axis.set_xlim(delta.min(), delta.max())


def thinned(data: xr.Dataset, most: int) -> xr.Dataset:
    """Return every n-th row and column of a map, at most ``most`` of each; all if no more."""
    return data.isel({name: slice(None, None, -(-data.sizes[name] // most)) for name in data.dims})
