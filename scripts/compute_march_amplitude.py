"""Where stresses of several amplitudes break down, beside geometric optics."""

import logging
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, marches
from hopper.arrays import Array
from hopper.march.base import Base
from hopper.march.optics import estimated_breakdown, threshold_factor
from hopper.march.outcome import first_crossing
from hopper.stability.asymptotic_line import asymptotic_line
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import Table, flag, number, text
from hopper_data.tops import named_top

_NONE = float("nan")


def compute_march_amplitude(
    *,
    hoppers: Sequence[Mapping[str, Any]],
    top: str,
    eps: Sequence[float],
    estimates: int,
    depth: float,
    cells: int,
    tolerance: float,
) -> CfDataset:
    """Find the first crossing of each amplitude in each hopper."""
    report = jobs.progress(logging.getLogger(), "hoppers")
    estimated = np.geomspace(min(eps), max(eps), estimates)
    found: list[dict[str, Any]] = []
    for hopper in hoppers:
        base = marches.base(hopper)
        verdicts = [first_crossing(base, named_top(top, e), depth, tolerance, cells) for e in eps]
        crossings = [verdict.crossing for verdict in verdicts]
        found.append(
            {
                "name": marches.name_of_hopper(**hopper),
                "tau": [_NONE if each is None else each.tau for each in crossings],
                "error": [_NONE if each is None else each.error for each in crossings],
                "kind": [
                    "crossing" if v.crossing else "none" if v.converging else "not_placed"
                    for v in verdicts
                ],
                "line": asymptotic_line(base.solution).abscissa,
                **_optics(base, top, estimated),
            }
        )
        report(len(found), len(hoppers))
    return dataset({"hoppers": found, "eps": eps, "estimated": estimated}, TABLE, AXES)


def _optics(base: Base, top: str, eps: Array) -> dict[str, Any]:
    """Return the estimates of geometric optics, NaN for cones."""
    if base.hopper.curvature:
        return {"estimate": np.full(eps.size, np.nan), "threshold": _NONE}
    estimates = [estimated_breakdown(base, named_top(top, size)) for size in eps]
    return {
        "estimate": [_NONE if each is None else each for each in estimates],
        # Linear in the amplitude.
        "threshold": threshold_factor(base, named_top(top, eps[0])) * eps[0],
    }


TABLE: Table = (
    number("breakdown_tau", "tau of the first crossing", "hopper eps", "hoppers.tau"),
    number("breakdown_error", "error estimate of breakdown_tau", "hopper eps", "hoppers.error"),
    flag(
        "breakdown_kind",
        "what nets show",
        ("none", "crossing", "not_placed"),
        "hopper eps",
        "hoppers.kind",
    ),
    number(
        "estimate", "geometric optics: tau of breakdown", "hopper estimate_eps", "hoppers.estimate"
    ),
    number("threshold", "geometric optics: largest eps that decays", "hopper", "hoppers.threshold"),
    number("line", "asymptotic line of Re(lambda)", "hopper", "hoppers.line"),
)
AXES: Table = (
    text("hopper", "hopper: delta, half angle (degrees), mu", "hopper", "hoppers.name"),
    number("eps", "amplitude of the top", "eps"),
    number("estimate_eps", "amplitude of the estimate", "estimate_eps", "estimated"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_march_amplitude, "Breakdown over the amplitude of the top", "(2.8)-(2.11)"
        )
    )
