"""Pseudospectrum of the full matrix M: sigma_min(z I - M) on a grid."""

import logging
from typing import Any

import numpy as np
import xarray as xr

from hopper.spectral.pseudospectrum import pseudospectrum
from hopper.spectral.schur import schur_form
from hopper.stability.collocation import Half, half_matrix
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.transient import Norm, half_weights
from support import artifacts, fields, hoppers, jobs


def compute_pseudospectrum(
    artifact: str,
    provenance: str,
    *,
    hopper: dict[str, Any],
    nodes: int,
    mode: str,
    norm: Norm,
    psi_scale: float,
    real: dict[str, Any],
    imag: dict[str, Any],
) -> None:
    """Compute the grid for the full interval (paper mode) or for the flow's parity (physical)."""
    solution = hoppers.radial_solution(**hopper)
    x, y = fields.axis(**real), fields.axis(**imag)
    halves: tuple[Half, ...] = HALVES if mode == "paper" else ("physical",)
    grids, eigenvalues = [], []
    for half in halves:
        matrix = half_matrix(solution, nodes // 2, half, psi_scale)
        form = schur_form(matrix, half_weights(nodes // 2, norm))
        grids.append(pseudospectrum(form, x, y, progress=_report(half)).sigma_min)
        eigenvalues.append(form.eigenvalues)
    spectrum = np.concatenate(eigenvalues)
    spectrum = spectrum[np.argsort(np.abs(spectrum), kind="stable")]
    dataset = xr.Dataset(
        {
            # The parities are orthogonal in both norms: the smaller of the two is that of M.
            "sigma_min": fields.number(
                ("imag", "real"), np.min(grids, axis=0), "smallest singular value of z I - M"
            ),
            **fields.complex_number("mode", "eigenvalue", spectrum, "eigenvalue of M"),
        },
        coords={
            "real": fields.number("real", x, "real part of z"),
            "imag": fields.number("imag", y, "imaginary part of z"),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Pseudospectrum of the stability operator, {mode} mode, {norm} norm",
        equations="(4.2); Trefethen and Embree (2005)",
        parameters={
            "hopper": hopper,
            "nodes": nodes,
            "mode": mode,
            "norm": norm,
            "psi_scale": psi_scale,
            "real": real,
            "imag": imag,
        },
    )


def _report(half: str) -> jobs.Progress:
    return jobs.progress(logging.getLogger(), f"{half} half, grid points")


if __name__ == "__main__":
    jobs.run(compute_pseudospectrum, snakemake)  # type: ignore[name-defined]  # noqa: F821
