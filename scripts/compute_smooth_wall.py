"""Smooth-wall theory: abscissae over delta, neutral angles, and cone eigenvalues three ways."""

from math import degrees, radians

import numpy as np
import xarray as xr

from hopper.problem import Geometry
from hopper.stability import smooth_wall
from support import artifacts, fields, jobs


def compute_smooth_wall(
    artifact: str,
    provenance: str,
    *,
    delta_deg: dict[str, float],
    half_angles_deg: dict[str, float],
    modes: int,
) -> None:
    """Tabulate the theory over delta (Figure 4.1) and over the half angle (cone variants)."""
    delta = fields.steps(**delta_deg)
    angles = fields.steps(**half_angles_deg)
    variants = smooth_wall.CONE_VARIANTS
    wavenumbers = np.array(
        [
            [smooth_wall.cone_wavenumbers(radians(angle), modes, variant) for angle in angles]
            for variant in variants
        ]
    )
    crossing = smooth_wall.crossing_delta()
    dataset = xr.Dataset(
        {
            "abscissa": fields.number(
                ("geometry", "delta"),
                [smooth_wall.abscissa(g, np.radians(delta)) for g in _GEOMETRIES],
                "abscissa of the line of eigenvalues",
            ),
            "neutral_delta": fields.angle(
                "geometry",
                [degrees(smooth_wall.neutral_delta(g)) for g in _GEOMETRIES],
                "angle of internal friction of neutral stability",
            ),
            "crossing_delta": fields.angle((), degrees(crossing), "delta of equal abscissae"),
            "crossing_abscissa": fields.number(
                (), float(smooth_wall.abscissa("wedge", crossing)), "abscissa at the crossing"
            ),
            "wavenumber": fields.number(
                ("variant", "half_angle", "n"), wavenumbers, "mu_n of the cone"
            ),
            "threshold": fields.number(
                "half_angle",
                smooth_wall.oscillation_threshold(np.radians(angles)),
                "f(theta_w), the least sin(delta) with a real eigenvalue",
            ),
            "largest_half_angle": fields.angle(
                (),
                degrees(smooth_wall.largest_distinct_half_angle()),
                "half angle below which mu_1 > 2",
            ),
        },
        coords={
            "geometry": ("geometry", list(_GEOMETRIES), {"long_name": "shape of the hopper"}),
            "variant": ("variant", list(variants), {"long_name": "equation for mu_n"}),
            "delta": fields.angle("delta", delta, "angle of internal friction"),
            "half_angle": fields.angle("half_angle", angles, "half opening angle"),
            "n": ("n", np.arange(1, modes + 1), {"long_name": "number of the mode", "units": "1"}),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Smooth-wall theory",
        equations="(4.3)-(4.10)",
        parameters={"delta_deg": delta_deg, "half_angles_deg": half_angles_deg, "modes": modes},
    )


_GEOMETRIES: tuple[Geometry, ...] = ("wedge", "cone")

if __name__ == "__main__":
    jobs.run(compute_smooth_wall, snakemake)  # type: ignore[name-defined]  # noqa: F821
