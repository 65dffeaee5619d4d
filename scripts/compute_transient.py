"""Transient growth on the kept part of the spectrum, with the bounds of (4.11)."""

import logging
from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np
import xarray as xr

from hopper.spectral.transient import abscissa, condition_number, propagator_norm
from hopper.stability.transient import NORMS, Norm, modal_basis
from support import artifacts, fields, hoppers, jobs, modes


def compute_transient(
    spectrum: str,
    artifact: str,
    provenance: str,
    *,
    hopper: dict[str, Any],
    nodes: int,
    kept_in: Sequence[str],
    norms: Sequence[Norm],
    psi_scales: Sequence[float],
    elapsed: dict[str, Any],
) -> None:
    """Compute the norm over -t in [0, elapsed.stop] for every mode, norm and weight of psi."""
    data = artifacts.read(spectrum)
    solution = hoppers.radial_solution(**hopper)
    times = fields.axis(0, **elapsed)
    shape = (len(kept_in), len(norms), len(psi_scales))
    growth = np.empty((*shape, times.size))
    alpha, kappa = np.empty(shape), np.empty(shape)
    for index in product(*map(range, shape)):
        mode, norm, scale = kept_in[index[0]], norms[index[1]], psi_scales[index[2]]
        bases = [
            modal_basis(solution, nodes, half, kept, norm, scale)
            for half, kept in modes.kept_by_half(data, mode).items()
        ]
        growth[index] = propagator_norm(bases, times)
        alpha[index], kappa[index] = abscissa(bases), condition_number(bases)
        logging.info(
            "%s, %s norm, psi scale %g: alpha %.6f, kappa %.4g",
            mode, norm, scale, alpha[index], kappa[index],
        )  # fmt: skip
    lower = np.exp(alpha[..., None] * times)
    over_time, over_case = ("kept_in", "norm", "psi_scale", "elapsed"), _CASE
    dataset = xr.Dataset(
        {
            "growth": fields.number(over_time, growth, "norm of exp(-t M) on the kept modes"),
            "lower_bound": fields.number(over_time, lower, "exp(-t alpha)"),
            "upper_bound": fields.number(
                over_time, kappa[..., None] * lower, "kappa(V) exp(-t alpha)"
            ),
            "abscissa": fields.number(over_case, alpha, "largest real part of a kept mode"),
            "condition": fields.number(over_case, kappa, "kappa(V) of the kept eigenvectors"),
        },
        coords={
            "kept_in": fields.flag(
                "kept_in", [modes.MODES.index(m) for m in kept_in], "kept modes", modes.MODES
            ),
            "norm": fields.flag("norm", [NORMS.index(n) for n in norms], "vector norm", NORMS),
            "psi_scale": fields.number("psi_scale", list(psi_scales), "p in (sigma1, psi1 / p)"),
            "elapsed": fields.number("elapsed", times, "-t = -log r, the way down the hopper"),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Transient growth on the kept modes",
        equations="(4.2), (4.11)",
        parameters={
            "hopper": hopper,
            "nodes": nodes,
            "kept_in": list(kept_in),
            "norms": list(norms),
            "psi_scales": list(psi_scales),
            "elapsed": elapsed,
        },
    )


_CASE = ("kept_in", "norm", "psi_scale")

if __name__ == "__main__":
    jobs.run(compute_transient, snakemake)  # type: ignore[name-defined]  # noqa: F821
