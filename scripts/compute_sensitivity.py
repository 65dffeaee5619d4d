"""Sensitivity of the kept spectrum: condition numbers, distance to instability, resolvent."""

import logging
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, kept_modes
from hopper.spectral.schur import schur_form
from hopper.spectral.sensitivity import (
    kept_condition_numbers,
    kept_form,
    kept_sensitivity,
    resolvent_curves,
)
from hopper.spectral.transient import condition_number, growth_curve
from hopper.stability.paper_matrix import half_matrix
from hopper.stability.transient import Norm, half_weights, modal_basis
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.stability import HALF
from hopper_data.tables import complex_number, number


def compute_sensitivity(
    spectrum: str,
    *,
    hopper: dict[str, Any],
    nodes: int,
    formulation: str,
    norm: Norm,
    psi_scale: float,
    frequencies: dict[str, Any],
    elapsed: dict[str, Any],
) -> CfDataset:
    """Measure the non-normality of M on the kept modes and of the full matrix."""
    solution = solution_of(**hopper)
    kept = kept_modes.by_half(spectrum)[formulation]
    weight = half_weights(solution.hopper, nodes // 2, norm)
    forms = {
        half: schur_form(half_matrix(solution, nodes // 2, half, psi_scale), weight)
        for half in kept
    }
    bases = [modal_basis(solution, nodes, h, values, norm, psi_scale) for h, values in kept.items()]
    measures = kept_sensitivity(bases)
    times, growth = growth_curve(bases, 0, elapsed["stop"], elapsed["points"])
    y, (resolvent_kept, resolvent) = resolvent_curves(
        [[kept_form(bases)], list(forms.values())], frequencies["stop"], frequencies["points"]
    )
    result: dict[str, Any] = {
        "eigenvalue": np.concatenate(list(kept.values())),
        "half": np.repeat(list(kept), [values.size for values in kept.values()]),
        "condition": np.concatenate(
            [kept_condition_numbers(forms[half], values) for half, values in kept.items()]
        ),
        "basis_condition": condition_number(bases),
        "measures": measures,
        "relative_growth": growth,
        "resolvent_kept": resolvent_kept,
        "resolvent": resolvent,
        "frequency": y,
        "elapsed": times,
    }
    logging.info("%s, %s: %s", hopper["geometry"], formulation, measures)
    return dataset(result, TABLE, AXES)


TABLE = (
    complex_number("eigenvalue", "kept eigenvalue", "mode"),
    HALF,
    number("condition", "condition number of the eigenvalue", "mode"),
    number("basis_condition", "kappa(V) of the kept eigenvectors"),
    number(
        "distance",
        "smallest perturbation that puts an eigenvalue on the axis",
        source="measures.distance",
    ),
    number("distance_frequency", "Im(z) of the distance", source="measures.frequency"),
    number("kreiss_bound", "Kreiss bound of the growth", source="measures.kreiss"),
    number("relative_growth", "norm of exp(-t M) over exp(-t alpha)", "elapsed"),
    number("resolvent_kept", "resolvent on the kept modes", "frequency"),
    number("resolvent", "resolvent of the full matrix", "frequency"),
)
AXES = (
    number("frequency", "y at z = i y", "frequency"),
    number("elapsed", "-t = -log r, the way down the hopper", "elapsed"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_sensitivity,
            "Sensitivity of the spectrum, {formulation} formulation, {norm} norm",
            "(4.2), (4.11); Trefethen and Embree (2005)",
        )
    )
