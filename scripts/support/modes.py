"""Modes in artifacts: their parity, the filter's reasons, and which of them are kept."""

from typing import Any

import numpy as np
import xarray as xr

from hopper.stability.collocation import Half
from hopper.stability.convergence_filter import REASONS
from hopper.stability.mesh_spectrum import HALVES
from support import fields

MODES = ("paper", "physical")


def half(dimension: str, values: Any) -> fields.Variable:
    """Return the parity of modes."""
    return fields.flag(dimension, values, "parity: physical is sigma1 even and psi1 odd", HALVES)


def reason(dimension: str, values: Any) -> fields.Variable:
    """Return the filter's reasons."""
    return fields.flag(dimension, values, "why the filter keeps or rejects the eigenvalue", REASONS)


def kept_by_half(data: xr.Dataset, mode: str) -> dict[Half, np.ndarray]:
    """Return kept eigenvalues by parity.

    ``paper``: the first unbroken run kept as the paper words the filter, both parities;
    ``physical``: those of the flow's parity that the sound filter keeps. A parity of which nothing
    is kept is left out.
    """
    values, half = fields.as_complex(data, "eigenvalue"), data["half"].to_numpy()
    if mode == "physical":
        return {"physical": values[(data["kept"].to_numpy() == 1) & (half == 0)]}
    index = np.arange(values.size)
    run = (index >= int(data["run_start"])) & (index < int(data["run_stop"]))
    parts = {name: values[run & (half == code)] for code, name in enumerate(HALVES)}
    return {name: part for name, part in parts.items() if part.size}
