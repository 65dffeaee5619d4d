"""Return of the stress to the radial field, beside what the linearised equations make of it."""

import logging
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, marches
from hopper.arrays import Array
from hopper.march.outcome import march
from hopper.march.result import March
from hopper.stability.modes import linear_stability
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import Table, number, text
from hopper_data.tops import named_top


def compute_march_decay(
    *,
    hoppers: Sequence[Mapping[str, Any]],
    top: str,
    eps: Sequence[float],
    depth: float,
    points: int,
    linear_eps: float,
    cells: int,
) -> CfDataset:
    """March tops of several amplitudes down several hoppers."""
    report = jobs.progress(logging.getLogger(), "hoppers")
    tau = np.linspace(0, depth, points)
    found: list[dict[str, Any]] = []
    for hopper in hoppers:
        base = marches.base(hopper)
        marched = [
            march(base, named_top(top, size), depth, cells=cells) for size in (*eps, linear_eps)
        ]
        distance = [_distance(each, tau) for each in marched]
        stability = linear_stability(base.solution, "symmetric")
        found.append(
            {
                "name": marches.name_of_hopper(**hopper),
                "distance": distance[:-1],
                "end": [each.trusted_tau for each in marched[:-1]],
                "error": [each.error_estimate for each in marched[:-1]],
                "linear": distance[-1] / linear_eps,
                "abscissa": stability.abscissa,
                "line": stability.line.abscissa,
            }
        )
        report(len(found), len(hoppers))
    return dataset({"hoppers": found, "eps": eps, "tau": tau}, TABLE, AXES)


def _distance(marched: March, tau: Array) -> Array:
    """Return the distance from the radial field at times, NaN behind the end of the march."""
    found = np.full(tau.size, np.nan)
    inside = tau <= marched.trusted_tau
    found[inside] = marched.distance(tau[inside])
    return found


TABLE: Table = (
    number(
        "distance",
        "largest difference from the radial stress",
        "hopper eps tau",
        "hoppers.distance",
        scale="sigma",
    ),
    number("end", "tau at which the march ends", "hopper eps", "hoppers.end"),
    number("error", "error of log(sigma) and psi up to there", "hopper eps", "hoppers.error"),
    number(
        "linear", "the distance of an infinitesimal bump over eps", "hopper tau", "hoppers.linear"
    ),
    number("abscissa", "supremum of Re(lambda)", "hopper", "hoppers.abscissa"),
    number("line", "asymptotic line of Re(lambda)", "hopper", "hoppers.line"),
)
AXES: Table = (
    text("hopper", "hopper: delta, half angle (degrees), mu", "hopper", "hoppers.name"),
    number("eps", "amplitude of the top", "eps"),
    number("tau", "log(r_top / r)", "tau"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_march_decay, "Return of the stress to the radial field", "(2.8)-(2.11), (4.2)"
        )
    )
