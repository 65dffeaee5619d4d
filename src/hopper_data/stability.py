"""Tables of spectra and of what decides stability."""

from collections.abc import Mapping
from dataclasses import replace
from typing import get_args

import numpy as np

from hopper.stability.collocation import PARITIES
from hopper.stability.convergence_filter import REASONS
from hopper.stability.mesh_spectrum import HALVES, MeshSpectrum
from hopper.stability.modes import GOVERNORS
from hopper.von_mises.characteristics import Kind
from hopper.von_mises.growth import Governor
from hopper_data.tables import Table, complex_number, flag, number, within

_NO_YES = ("no", "yes")
HALF = flag("half", "parity: physical is sigma1 even and psi1 odd", HALVES, "mode")

GOVERNED_BY = flag("governed_by", "what the abscissa is due to", GOVERNORS)
PARITY = flag("parity", "parity of the mode that governs", PARITIES)
COUPLED_FLAGS: Table = (
    flag("type", "type of the equations", get_args(Kind)),
    flag("governed_by", "what the abscissa is due to", get_args(Governor)),
    flag("slanted", "data belong on a slanted surface", _NO_YES, source="judged.slanted"),
)


def eigenvalues(which: str, prefix: str = "") -> Table:
    """Return the table of :class:`hopper.stability.low_modes.Modes`, names with a prefix."""
    name, over = f"{prefix}eigenvalue", f"{prefix}mode"
    return (
        complex_number(name, f"{which} mode, Im >= 0", over, "eigenvalues"),
        number(f"{name}_error", f"error of {name}", over, "errors"),
    )


STABILITY: Table = (
    *within("modes.symmetric", eigenvalues("low symmetric")),
    *within("modes.asymmetric", eigenvalues("low asymmetric", "asymmetric_")),
    number("line", "abscissa of the asymptotic line", source="line.abscissa"),
    number("line_spacing", "spacing of modes of one parity in Im", source="line.spacing"),
    number("line_error", "error of the line", source="line.error_estimate"),
    number("abscissa", "supremum of Re(lambda)"),
    number("abscissa_error", "error of the abscissa", source="error_estimate"),
    GOVERNED_BY,
    PARITY,
)
MESH_SPECTRUM: Table = (
    complex_number("eigenvalue", "eigenvalue of M by modulus", "mode", "eigenvalues"),
    HALF,
    number(
        "eigenvector_tail",
        "last tenth of the eigenvector's Chebyshev coefficients over the largest",
        "mode",
        "tail",
    ),
)
FILTERED_SPECTRUM: Table = (
    complex_number("eigenvalue", "eigenvalue of M by modulus", "mode", "fine.eigenvalues"),
    replace(HALF, source="fine.half"),
    number("eigenvector_tail", "tail of the eigenvector", "mode", "fine.tail"),
    number("change", "relative distance to the one-to-one partner, inf without", "mode"),
    number("change_nearest", "relative distance to the nearest on the coarse mesh", "mode"),
    flag("kept", "kept by the sound filter", _NO_YES, "mode"),
    flag("kept_as_worded", "kept by the filter as the paper words it", _NO_YES, "mode"),
    flag("reason", "why the filter keeps or rejects the eigenvalue", REASONS, "mode"),
)
PLANE: Table = (
    number("real", "real part of z", "real"),
    number("imag", "imaginary part of z", "imag"),
)
PSEUDOSPECTRUM: Table = (number("sigma_min", "smallest singular value of z I - M", "imag real"),)


def read_mesh_spectrum(stored: Mapping[str, np.ndarray], n: int) -> MeshSpectrum:
    """Return the spectrum of a mesh of ``n`` nodes from its ``MESH_COLUMNS``, as stored."""
    real, imag, half, tail = (stored[name] for name in MESH_COLUMNS)
    return MeshSpectrum(n, real + 1j * imag, half, tail)


MESH_COLUMNS = ("eigenvalue_real", "eigenvalue_imag", "half", "eigenvector_tail")
