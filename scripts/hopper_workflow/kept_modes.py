"""Kept modes of filtered spectra."""

import numpy as np
import xarray as xr

from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.paper_matrix import Half

FORMULATIONS = ("paper", "physical")


def by_half(data: xr.Dataset, formulation: str) -> dict[Half, np.ndarray]:
    """Return the eigenvalues kept in a formulation, by parity.

    ``paper``: the first unbroken run kept as the paper words the filter, both parities;
    ``physical``: those of the flow's parity that the sound filter keeps. A parity of which nothing
    is kept is left out.
    """
    values, half = data["eigenvalue"].to_numpy(), data["half"].to_numpy()
    if formulation == "physical":
        return {"physical": values[(data["kept"].to_numpy() == "yes") & (half == "physical")]}
    index = np.arange(values.size)
    run = (index >= int(data["run_start"])) & (index < int(data["run_stop"]))
    parts = {name: values[run & (half == name)] for name in HALVES}
    return {name: part for name, part in parts.items() if part.size}
