"""Sensitivity of the kept spectrum: condition numbers, distance to instability, resolvent."""

import logging
from typing import Any

import numpy as np
import xarray as xr

from hopper.spectral.schur import schur_form
from hopper.spectral.sensitivity import (
    kept_condition_numbers,
    kept_form,
    kept_sensitivity,
    resolvent_norm,
)
from hopper.spectral.transient import abscissa, condition_number, propagator_norm
from hopper.stability.collocation import half_matrix
from hopper.stability.mesh_spectrum import HALVES
from hopper.stability.transient import Norm, half_weights, modal_basis
from support import artifacts, fields, hoppers, jobs, modes


def compute_sensitivity(
    spectrum: str,
    artifact: str,
    provenance: str,
    *,
    hopper: dict[str, Any],
    nodes: int,
    mode: str,
    norm: Norm,
    psi_scale: float,
    frequencies: dict[str, Any],
    elapsed: dict[str, Any],
) -> None:
    """Measure the non-normality of M on the kept modes and of the full matrix."""
    solution = hoppers.radial_solution(**hopper)
    kept = modes.kept_by_half(artifacts.read(spectrum), mode)
    forms = {
        half: schur_form(
            half_matrix(solution, nodes // 2, half, psi_scale), half_weights(nodes // 2, norm)
        )
        for half in kept
    }
    bases = [modal_basis(solution, nodes, h, values, norm, psi_scale) for h, values in kept.items()]
    conditions = np.concatenate(
        [kept_condition_numbers(forms[half], values) for half, values in kept.items()]
    )
    measures = kept_sensitivity(bases)
    y = fields.axis(0, **frequencies)
    times = fields.axis(0, **elapsed)
    relative = propagator_norm(bases, times) * np.exp(-abscissa(bases) * times)
    logging.info(
        "%s, %s: distance to instability %.4g, largest condition %.4g, Kreiss bound %.4g <= %.4g",
        hopper["geometry"], mode, measures.distance, conditions.max(), measures.kreiss,
        relative.max(),
    )  # fmt: skip
    codes = np.repeat([HALVES.index(half) for half in kept], [v.size for v in kept.values()])
    dataset = xr.Dataset(
        {
            **fields.complex_number(
                "mode", "eigenvalue", np.concatenate(list(kept.values())), "kept eigenvalue"
            ),
            "half": modes.half("mode", codes),
            "condition": fields.number("mode", conditions, "condition number of the eigenvalue"),
            "basis_condition": fields.number(
                (), condition_number(bases), "kappa(V) of the kept eigenvectors"
            ),
            "distance": fields.number(
                (), measures.distance, "smallest perturbation that puts an eigenvalue on the axis"
            ),
            "distance_frequency": fields.number((), measures.frequency, "Im(z) of the distance"),
            "kreiss_bound": fields.number((), measures.kreiss, "Kreiss bound of the growth"),
            "relative_growth": fields.number(
                "elapsed", relative, "norm of exp(-t M) over exp(-t alpha)"
            ),
            "resolvent_kept": fields.number(
                "frequency", resolvent_norm([kept_form(bases)], y), "resolvent on the kept modes"
            ),
            "resolvent": fields.number(
                "frequency", resolvent_norm(list(forms.values()), y), "resolvent of the full matrix"
            ),
        },
        coords={
            "frequency": fields.number("frequency", y, "y at z = i y"),
            "elapsed": fields.number("elapsed", times, "-t = -log r, the way down the hopper"),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Sensitivity of the spectrum, {mode} mode, {norm} norm",
        equations="(4.2), (4.11); Trefethen and Embree (2005)",
        parameters={
            "hopper": hopper,
            "nodes": nodes,
            "mode": mode,
            "norm": norm,
            "psi_scale": psi_scale,
            "frequencies": frequencies,
            "elapsed": elapsed,
        },
    )


if __name__ == "__main__":
    jobs.run(compute_sensitivity, snakemake)  # type: ignore[name-defined]  # noqa: F821
