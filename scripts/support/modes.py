"""Which eigenvalues of a filtered spectrum enter what is computed from kept modes."""

import numpy as np
import xarray as xr

from hopper.collocation import Half
from hopper.spectrum import HALVES
from support import fields

MODES = ("paper", "physical")


def kept_by_half(data: xr.Dataset, mode: str) -> dict[Half, np.ndarray]:
    """Return kept eigenvalues by parity.

    ``paper``: the first unbroken run kept as the paper words the filter, both parities;
    ``physical``: those of the flow's parity that the sound filter keeps.
    """
    values, half = fields.as_complex(data, "eigenvalue"), data["half"].to_numpy()
    if mode == "physical":
        return {"physical": values[(data["kept"].to_numpy() == 1) & (half == 0)]}
    index = np.arange(values.size)
    run = (index >= int(data["run_start"])) & (index < int(data["run_stop"]))
    return {name: values[run & (half == code)] for code, name in enumerate(HALVES)}
