"""Borders of the stable domain: neutral curve, fold, tangency, singular velocity."""

import logging
from math import radians
from typing import Any, get_args

import numpy as np
import xarray as xr

from hopper.domain.borders import borders
from hopper.domain.neutral import ROOT_TOLERANCE, neutral_curve, neutral_delta
from hopper.problem import Hopper, as_geometry
from hopper.radial.friction_limit import End
from hopper.radial.solution import solve_radial
from support import artifacts, fields, jobs, paper_checks


def compute_borders(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    half_angle_deg: float,
    neutral_step_deg: float,
    delta_deg: dict[str, Any],
    check: dict[str, Any],
) -> None:
    """Trace the neutral curve and the borders over delta; each point is a root of an equation.

    A few points of the neutral curve, its end left out, are checked by the paper's algorithm.
    """
    shape, half_angle = as_geometry(geometry), radians(half_angle_deg)
    neutral = neutral_curve(shape, half_angle, radians(neutral_step_deg))
    logging.info(
        "%s, %g deg: neutral delta %.6f deg at phi = 0, curve ends at phi = %.6f deg",
        geometry, half_angle_deg, np.degrees(neutral.delta[0]),
        np.degrees(neutral.friction_angle[-1]),
    )  # fmt: skip
    points, meshes = check["points"], {name: check[name] for name in check if name != "points"}
    # At given frictions, not at points of the curve, whose number depends on rounding.
    frictions = neutral.friction_angle[-1] * np.arange(points) / points
    checked = [
        neutral_delta(shape, half_angle, phi, np.interp(phi, neutral.friction_angle, neutral.delta))
        for phi in frictions
    ]
    solutions = [
        solve_radial(Hopper(shape, delta, half_angle), phi)
        for delta, phi in zip(checked, frictions, strict=True)
    ]
    deltas = fields.axis(**delta_deg)
    found = borders(shape, half_angle, np.radians(deltas))
    ends = (*get_args(End), "none")
    dataset = xr.Dataset(
        {
            "neutral_delta": fields.angle(
                "point", np.degrees(neutral.delta), "internal friction of neutral stability"
            ),
            "neutral_phi": fields.angle(
                "point", np.degrees(neutral.friction_angle), "wall friction of neutral stability"
            ),
            "neutral_error": fields.angle(
                (), np.degrees(ROOT_TOLERANCE), "tolerance of neutral_delta"
            ),
            "check_delta": fields.angle(
                "check", np.degrees(checked), "internal friction of a checked neutral point"
            ),
            "check_phi": fields.angle(
                "check", np.degrees(frictions), "wall friction of a checked neutral point"
            ),
            **paper_checks.check_variables("check", solutions, **meshes),
            "limit_phi": fields.angle(
                "delta", np.degrees(found.limit), "largest wall friction with a radial solution"
            ),
            "limit_error": fields.angle(
                "delta", np.degrees(found.limit_error), "error estimate of limit_phi"
            ),
            "limit_end": fields.flag(
                "delta", [ends.index(end) for end in found.end], "what ends the branch", ends
            ),
            "tangency_phi": fields.angle(
                "delta", np.degrees(found.tangency), "wall friction at which a characteristic is "
                "tangent, NaN where the limit comes first or the smooth wall is beyond it",
            ),
            "singular_velocity_phi": fields.angle(
                "delta", np.degrees(found.singular_velocity), "wall friction at which psi reaches "
                "pi/4, NaN as before",
            ),
        },
        coords={"delta": fields.angle("delta", deltas, "angle of internal friction")},
    )  # fmt: skip
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Borders of the stable domain, {geometry}",
        equations="(3.3), (4.1), (4.2)",
        parameters={
            "geometry": geometry,
            "half_angle_deg": half_angle_deg,
            "neutral_step_deg": neutral_step_deg,
            "delta_deg": delta_deg,
            "check": check,
        },
    )


if __name__ == "__main__":
    jobs.run(compute_borders, snakemake)  # type: ignore[name-defined]  # noqa: F821
