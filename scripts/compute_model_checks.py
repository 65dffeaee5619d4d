"""Sections 2 and 3: what the paper states of its two models, checked on fields and over delta."""

import logging
from collections.abc import Sequence
from dataclasses import asdict
from math import atan, degrees, radians, sin, tan
from typing import Any

import numpy as np
import xarray as xr

from hopper.evidence import printed
from hopper.evidence.characteristics import real_characteristics
from hopper.evidence.motion import check_field, levy_factor
from hopper.problem import Hopper, as_geometry
from hopper.radial.friction_limit import FrictionLimit, friction_limit
from hopper.radial.solution import radial_solutions
from hopper.radial.velocity import solve_velocity
from hopper.stability.linearisation import tangency_angle
from hopper.yield_conditions import VON_MISES, YieldCondition, yield_condition
from support import artifacts, fields, jobs


def compute_model_checks(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    models: Sequence[str],
    mu: Sequence[float],
    deltas_deg: dict[str, float],
    psi_points: int,
) -> None:
    """Check the radial fields of one hopper, and what is said of any delta."""
    laws = [yield_condition(model) for model in models]
    shape, delta, half_angle = as_geometry(geometry), radians(delta_deg), radians(half_angle_deg)
    hoppers = [Hopper(shape, delta, half_angle, law) for law in laws]
    deltas = fields.steps(**deltas_deg)
    dataset = xr.Dataset(
        {
            **_fields([[_check(hopper, friction) for friction in mu] for hopper in hoppers]),
            **_limits([friction_limit(hopper) for hopper in hoppers]),
            **_over_delta(laws, np.radians(deltas), psi_points),
            "tangency_psi": fields.angle(
                (), degrees(tangency_angle(delta)), "psi at the tangency of a characteristic"
            ),
        },
        coords={
            "model": ("model", list(models), {"long_name": "yield condition"}),
            "mu": fields.number("mu", list(mu), "coefficient of wall friction"),
            "delta": fields.angle("delta", deltas, "angle of internal friction"),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Checks of the two models and their radial fields",
        equations="(2.4)-(2.15), (3.1)-(3.5)",
        parameters={
            "geometry": geometry,
            "delta_deg": delta_deg,
            "half_angle_deg": half_angle_deg,
            "models": list(models),
            "mu": list(mu),
            "deltas_deg": deltas_deg,
            "psi_points": psi_points,
        },
    )


def _check(hopper: Hopper, mu: float) -> dict[str, float]:
    """Check the field of the physical branch, and count the solutions."""
    found = radial_solutions(hopper, atan(mu))
    first = found[0]
    logging.info("%s, mu = %g: %d solutions", hopper.material.name, mu, len(found))
    checks = asdict(check_field(first))
    checks["psi_max"] = degrees(checks["psi_max"])
    levy = {"levy_least": np.nan, "levy_defect": np.nan}
    if hopper.material == VON_MISES:
        factor = levy_factor(first, solve_velocity(first))
        levy = {"levy_least": factor.least, "levy_defect": factor.defect}
    second = degrees(found[1].psi_maximum()[1]) if len(found) > 1 else np.nan
    return {
        **checks,
        **levy,
        "solutions": len(found),
        "psi_max_second": second,
        "error_radial": first.error_estimate,
    }


def _fields(rows: list[list[dict[str, float]]]) -> dict[str, fields.Variable]:
    table = {
        name: fields.number(("model", "mu"), [[check[name] for check in row] for row in rows], text)
        for name, text in _CHECKS.items()
    }
    for name in ("psi_max", "psi_max_second"):
        table[name][2]["units"] = "degree"
    return table


def _limits(limits: list[FrictionLimit]) -> dict[str, fields.Variable]:
    return {
        "limit_mu": fields.number(
            "model", [tan(limit.friction_angle) for limit in limits],
            "largest wall friction with a radial solution",
        ),
        "limit_error": fields.number(
            "model", [limit.error_estimate for limit in limits], "error of atan(limit_mu), radians"
        ),
    }  # fmt: skip


def _over_delta(
    laws: list[YieldCondition], deltas: np.ndarray, psi_points: int
) -> dict[str, fields.Variable]:
    over = ("model", "delta")
    sines = [sin(delta) for delta in deltas]

    def angles(function: Any) -> list[list[float]]:
        return [[degrees(function(law, s)) for s in sines] for law in laws]

    counts = [
        [
            [real_characteristics(law, s, psi) for psi in np.linspace(0, np.pi / 4, psi_points)]
            for s in sines
        ]
        for law in laws
    ]
    return {
        "singular_psi": fields.angle(
            over, angles(printed.first_singular_angle), "least psi at which A of (3.3) is singular"
        ),
        "printed_limit": fields.angle(
            over, angles(printed.nonsingular_below), "psi below which the paper says it is not"
        ),
        "real_characteristics": fields.number(
            (*over, "psi"), counts, "number of real characteristics of the steady equations"
        ),
        "psi": fields.angle("psi", np.linspace(0, 45, psi_points), "Sokolovskii angle"),
    }


_CHECKS = {
    "yield_residual": "residual of the yield condition",
    "ratio_residual": "residual of the ratio of extreme principal stresses, NaN for von Mises",
    "hoop_residual": "residual of the law for the hoop stress",
    "wall_mu": "tangential over normal stress at the wall",
    "exponent": "c in u' = -c u tan(2 psi) from the flow rule",
    "exponent_spread": "range of c over the hopper",
    "coupling_radial": "reaction of the hoop stress to radial perturbations of the velocity",
    "coupling": "reaction of the hoop stress to any perturbation of the velocity",
    "psi_max": "largest Sokolovskii angle",
    "levy_least": "least factor of Levy's flow rule, NaN for Mohr-Coulomb",
    "levy_defect": "residual of Levy's flow rule, NaN for Mohr-Coulomb",
    "solutions": "number of radial solutions",
    "psi_max_second": "largest Sokolovskii angle of the second solution, NaN without",
    "error_radial": "error estimate of log(sigma) and psi",
}

if __name__ == "__main__":
    jobs.run(compute_model_checks, snakemake)  # type: ignore[name-defined]  # noqa: F821
