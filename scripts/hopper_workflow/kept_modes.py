"""Kept modes of filtered spectra."""

import numpy as np

from hopper_workflow import columns
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.paper_matrix import Half

FORMULATIONS = ("paper", "physical")
_COLUMNS = ("eigenvalue_real", "eigenvalue_imag", "half", "kept", "run_start", "run_stop")


def by_half(spectrum: str) -> dict[str, dict[Half, np.ndarray]]:
    """Return the eigenvalues of an artifact that are kept in each formulation, by parity.

    ``paper``: the first unbroken run kept as the paper words the filter, both parities, but for one
    of which nothing is kept; ``physical``: those of the flow's parity that the sound filter keeps.
    """
    real, imag, half, kept, start, stop = columns.read(spectrum, _COLUMNS).values()
    values, index = real + 1j * imag, np.arange(real.size)
    run = (start <= index) & (index < stop)
    parts = {name: values[run & (half == code)] for code, name in enumerate(HALVES)}
    return {
        "paper": {name: part for name, part in parts.items() if part.size},
        "physical": {"physical": values[(kept != 0) & (half == HALVES.index("physical"))]},
    }
