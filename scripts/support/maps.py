"""Stability maps in artifacts."""

from collections.abc import Sequence
from typing import Any

import xarray as xr

from hopper.domain.stability_map import REGIONS, Sweep
from support.fields import Variable, flag, number


def region(dimensions: tuple[str, ...] | str, values: Any) -> Variable:
    """Return what is known at each point of a sweep."""
    return flag(dimensions, values, "verdict, or why there is none", REGIONS)


def map_variables(sweeps: Sequence[Sweep]) -> dict[str, Variable]:
    """Return the variables of a stability map, a row for each sweep of wall friction."""
    over = ("delta", "phi")
    return {
        "abscissa": number(over, [s.abscissa for s in sweeps], "supremum of Re(lambda)"),
        "line": number(over, [s.line for s in sweeps], "abscissa of the asymptotic line"),
        "highest_mode": number(
            over, [s.highest_mode for s in sweeps], "largest real part of a low mode"
        ),
        "abscissa_error": number(
            over, [s.error_estimate for s in sweeps], "error estimate of the abscissa"
        ),
        "region": region(over, [s.region for s in sweeps]),
    }


def thinned(data: xr.Dataset, most: int) -> xr.Dataset:
    """Return every n-th row and column of a map, at most ``most`` of each; all if no more."""
    return data.isel({name: slice(None, None, -(-data.sizes[name] // most)) for name in data.dims})
