"""Transient growth on the kept part of the spectrum, with the bounds of (4.11)."""

import logging
from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, kept_modes
from hopper.spectral.transient import abscissa, condition_number, growth_curve
from hopper.stability.transient import NORMS, Norm, modal_basis
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.tables import flag, number, within


def compute_transient(
    spectrum: str,
    *,
    hopper: dict[str, Any],
    nodes: int,
    kept_in: Sequence[str],
    norms: Sequence[Norm],
    psi_scales: Sequence[float],
    elapsed: dict[str, Any],
) -> CfDataset:
    """Compute the norm over -t in [0, elapsed.stop] for every formulation, norm and weight of psi.

    ``elapsed.points`` is the least number of times; each curve has as many as it needs, and is
    missing at those that others need.
    """
    kept, solution = kept_modes.by_half(spectrum), solution_of(**hopper)
    choices = list(product(kept_in, norms, psi_scales))
    cases = [
        [
            modal_basis(solution, nodes, half, values, norm, scale)
            for half, values in kept[formulation].items()
        ]
        for formulation, norm, scale in choices
    ]
    curves = [growth_curve(bases, 0, elapsed["stop"], elapsed["points"]) for bases in cases]
    times = np.unique(np.concatenate([own for own, _ in curves]))
    found: list[dict[str, Any]] = []
    for choice, bases, (own, relative) in zip(choices, cases, curves, strict=True):
        alpha, kappa = abscissa(bases), condition_number(bases)
        logging.info("%s, %s norm, psi scale %g: alpha %.6f, kappa %.4g", *choice, alpha, kappa)
        growth, lower = np.full(times.size, np.nan), np.exp(alpha * times)
        growth[np.searchsorted(times, own)] = relative * np.exp(alpha * own)
        found.append(
            {
                "growth": growth,
                "lower_bound": lower,
                "upper_bound": kappa * lower,
                "abscissa": alpha,
                "condition": kappa,
            }
        )
    rest = iter(found)
    table = [[[next(rest) for _ in psi_scales] for _ in norms] for _ in kept_in]
    axes = {"kept_in": kept_in, "norm": norms, "psi_scale": psi_scales, "elapsed": times}
    return dataset({"cases": table, **axes}, TABLE, AXES, leading="kept_in norm psi_scale")


TABLE = within(
    "cases",
    (
        number("growth", "norm of exp(-t M) on the kept modes, NaN where not sampled", "elapsed"),
        number("lower_bound", "exp(-t alpha)", "elapsed"),
        number("upper_bound", "kappa(V) exp(-t alpha)", "elapsed"),
        number("abscissa", "largest real part of a kept mode"),
        number("condition", "kappa(V) of the kept eigenvectors"),
    ),
)
AXES = (
    flag("kept_in", "formulation in which modes are kept", kept_modes.FORMULATIONS, "kept_in"),
    flag("norm", "vector norm", NORMS, "norm"),
    number("psi_scale", "p in (sigma1, psi1 / p)", "psi_scale"),
    number("elapsed", "-t = -log r, the way down the hopper", "elapsed"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(compute_transient, "Transient growth on the kept modes", "(4.2), (4.11)")
    )
