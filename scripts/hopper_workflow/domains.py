"""How the stable domain, its borders and its maps are drawn."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

from hopper_workflow import plotting

_NO_SOLUTION, _UNSTABLE, _STABLE = "0.96", plotting.AMBER, "#BFE3F5"


def shade(axis: Axes, data: xr.Dataset) -> None:
    """Fill the regions; each lies on the one before it."""
    delta, limit = data.delta.values, np.nan_to_num(data.limit_phi.values)
    axis.fill_between(delta, 0, delta, color=_NO_SOLUTION, linewidth=0, label="no radial solution")
    axis.fill_between(delta, 0, limit, color=_UNSTABLE, linewidth=0, label="unstable")
    axis.fill(*_domain(data), color=_STABLE, linewidth=0, label="stable")
    hatch_unreached(axis, data)


def outline(axis: Axes, data: xr.Dataset, **style: Any) -> None:
    """Draw the border of the stable domain, without its right edge."""
    delta, phi = _domain(data)
    axis.plot(delta[:-1], phi[:-1], **style)


def _domain(data: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
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
        label=r"$\psi > \pi/4$: no radial flow at the wall",
    )


def draw_borders(axis: Axes, data: xr.Dataset) -> None:
    """Draw the neutral curve, the limit of friction, and levels of psi that bound nothing."""
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
        data.tangency_phi,
        color="0.35",
        linestyle=":",
        linewidth=0.8,
        label=r"$r$ = const is characteristic, $\psi = \pi/4 - \delta/2$",
    )
    axis.plot(
        data.neutral_delta,
        data.neutral_phi,
        color=plotting.BLUE,
        linewidth=1.6,
        label="neutral stability",
    )
    if "symmetric_delta" in data:
        axis.plot(
            data.symmetric_delta,
            data.symmetric_phi,
            color=plotting.BLUE,
            linewidth=1.2,
            linestyle="--",
            label="the same, symmetric disturbances only",
        )
    axis.set_xlim(delta.min(), delta.max())


def thinned(data: xr.Dataset, most: int) -> xr.Dataset:
    """Return every n-th row and column of a map, at most ``most`` of each; all if no more."""
    return data.isel({name: slice(None, None, -(-data.sizes[name] // most)) for name in data.dims})
