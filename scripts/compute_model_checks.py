"""Sections 2 and 3: what the paper states of its two models, checked on fields and over delta."""

import logging
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import atan, radians, sin, tan
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, ranges
from hopper.evidence import printed
from hopper.evidence.characteristics import real_characteristics
from hopper.evidence.motion import check_field, levy_factor
from hopper.problem import Hopper
from hopper.radial.friction_limit import friction_limit
from hopper.radial.solution import radial_solutions
from hopper.radial.velocity import solve_velocity
from hopper.stability.tilted import tangency_angle
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES, YieldCondition, yield_condition
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import hopper_of
from hopper_data.tables import Table, angle, in_degrees, number, text, within


def compute_model_checks(
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    models: Sequence[str],
    mu: Sequence[float],
    deltas_deg: dict[str, float],
    psi_points: int,
) -> CfDataset:
    """Check the radial fields of one hopper, and what is said of any delta."""
    hoppers = [hopper_of(geometry, delta_deg, half_angle_deg, model) for model in models]
    deltas = ranges.steps(**deltas_deg)
    limits = [friction_limit(hopper) for hopper in hoppers]
    result = {
        "fields": [[_check(hopper, friction) for friction in mu] for hopper in hoppers],
        "limits": {
            "mu": [tan(limit.friction_angle) for limit in limits],
            "error": [limit.error_estimate for limit in limits],
        },
        "over_delta": _over_delta([yield_condition(model) for model in models], deltas, psi_points),
        "tangency_psi": tangency_angle(radians(delta_deg)),
        "singular_psi": MOHR_COULOMB.singular_angle(radians(delta_deg)),
        "model": models,
        "mu": mu,
        "delta": deltas,
    }
    return dataset(result, TABLE, AXES)


def _check(hopper: Hopper, mu: float) -> dict[str, Any]:
    """Check the field of the physical branch, and count the solutions."""
    found = radial_solutions(hopper, atan(mu))
    first = found[0]
    logging.info("%s, mu = %g: %d solutions", hopper.material.name, mu, len(found))
    levy = {"least": np.nan, "defect": np.nan}
    if hopper.material == VON_MISES:
        levy = vars(levy_factor(first, solve_velocity(first)))
    return {
        **vars(check_field(first)),
        "levy": levy,
        "solutions": len(found),
        "psi_max_second": found[1].psi_maximum()[1] if len(found) > 1 else np.nan,
        "error_radial": first.error_estimate,
    }


def _over_delta(laws: list[YieldCondition], deltas: np.ndarray, psi_points: int) -> dict[str, Any]:
    sines = [sin(delta) for delta in np.radians(deltas)]
    psi = np.linspace(0, np.pi / 4, psi_points)

    def of_all(function: Callable[[YieldCondition, float], Any]) -> list[list[Any]]:
        return [[function(law, s) for s in sines] for law in laws]

    return {
        "singular_psi": of_all(printed.first_singular_angle),
        "printed_limit": of_all(printed.nonsingular_below),
        "real_characteristics": of_all(
            lambda law, s: [real_characteristics(law, s, angle) for angle in psi]
        ),
        "psi": np.linspace(0, 45, psi_points),
    }


_FIELD: Table = (
    number("yield_residual", "residual of the yield condition"),
    number(
        "ratio_residual", "residual of the ratio of extreme principal stresses, NaN for von Mises"
    ),
    number("hoop_residual", "residual of the law for the hoop stress"),
    number("wall_mu", "tangential over normal stress at the wall"),
    number("exponent", "c in u' = -c u tan(2 psi) from the flow rule"),
    number("exponent_spread", "range of c over the hopper"),
    number(
        "coupling_radial", "reaction of the hoop stress to radial perturbations of the velocity"
    ),
    number("coupling", "reaction of the hoop stress to any perturbation of the velocity"),
    angle("psi_max", "largest Sokolovskii angle"),
    number(
        "levy_least", "least factor of Levy's flow rule, NaN for Mohr-Coulomb", "", "levy.least"
    ),
    number("levy_defect", "residual of Levy's flow rule, NaN for Mohr-Coulomb", "", "levy.defect"),
    number("solutions", "number of radial solutions"),
    angle("psi_max_second", "largest Sokolovskii angle of the second solution, NaN without"),
    number("error_radial", "error estimate of log(sigma) and psi"),
)
TABLE: Table = (
    *(replace(variable, over="model mu") for variable in within("fields", _FIELD)),
    number("limit_mu", "largest wall friction with a radial solution", "model", "limits.mu"),
    number("limit_error", "error of atan(limit_mu), radians", "model", "limits.error"),
    *within(
        "over_delta",
        (
            angle("singular_psi", "least psi at which A of (3.3) is singular", "model delta"),
            angle("printed_limit", "psi below which the paper says it is not", "model delta"),
            number(
                "real_characteristics",
                "number of real characteristics of the steady equations",
                "model delta psi",
            ),
            in_degrees("psi", "Sokolovskii angle", "psi"),
        ),
    ),
    angle("tangency_psi", "psi at which a characteristic is tangent to r = const"),
    angle("mohr_coulomb_singular_psi", "psi at which (3.3) is singular", source="singular_psi"),
)
AXES: Table = (
    text("model", "yield condition", "model"),
    number("mu", "coefficient of wall friction", "mu"),
    in_degrees("delta", "angle of internal friction", "delta"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_model_checks,
            "Checks of the two models and their radial fields",
            "(2.4)-(2.15), (3.1)-(3.5)",
        )
    )
