"""Pseudospectrum of the full matrix M: sigma_min(z I - M) on a grid."""

import logging
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, ranges
from hopper.spectral.matching import by_modulus
from hopper.spectral.pseudospectrum import plane_of, pseudospectrum
from hopper.spectral.schur import schur_form
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.paper_matrix import Half, half_matrix
from hopper.stability.transient import Norm, half_weights
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.stability import PLANE, PSEUDOSPECTRUM
from hopper_data.tables import complex_number


def compute_pseudospectrum(
    *,
    hopper: dict[str, Any],
    nodes: int,
    formulation: str,
    norm: Norm,
    psi_scale: float,
    real: dict[str, Any],
    imag: dict[str, Any],
) -> CfDataset:
    """Compute the grid in the paper's formulation, both parities, or the physical, the flow's."""
    solution = solution_of(**hopper)
    halves: tuple[Half, ...] = HALVES if formulation == "paper" else ("physical",)
    weight = half_weights(solution.hopper, nodes // 2, norm)
    forms = [
        schur_form(half_matrix(solution, nodes // 2, half, psi_scale), weight) for half in halves
    ]
    values = by_modulus(np.concatenate([form.eigenvalues for form in forms]))
    x, y = plane_of(values, ranges.spaced(**real), ranges.spaced(**imag))
    grids = []
    for half, form in zip(halves, forms, strict=True):
        report = jobs.progress(logging.getLogger(), f"{half} half, grid points")
        grids.append(pseudospectrum(form, x, y, progress=report).sigma_min)
    result = {
        # The parities are orthogonal in both norms: the smaller of the two is that of M.
        "sigma_min": np.min(grids, axis=0),
        "eigenvalue": values,
        "real": x,
        "imag": y,
    }
    return dataset(result, TABLE, PLANE)


TABLE = (*PSEUDOSPECTRUM, complex_number("eigenvalue", "eigenvalue of M", "mode"))

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_pseudospectrum,
            "Pseudospectrum of the stability operator, {formulation} formulation, {norm} norm",
            "(4.2); Trefethen and Embree (2005)",
        )
    )
