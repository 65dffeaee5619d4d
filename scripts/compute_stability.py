"""Low modes in physical mode, the asymptotic line, and the spectral abscissa they give."""

import logging

import xarray as xr

from hopper.stability.modes import linear_stability
from support import artifacts, fields, hoppers, jobs


def compute_stability(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    mu: float,
) -> None:
    """Compute the verdict of stability that needs no large mesh."""
    result = linear_stability(hoppers.radial_solution(geometry, delta_deg, half_angle_deg, mu))
    logging.info(
        "%s: abscissa %.10f (%s), line %.10f",
        geometry,
        result.abscissa,
        result.governed_by,
        result.line.abscissa,
    )
    dataset = xr.Dataset(
        {
            **fields.complex_number(
                "mode", "eigenvalue", result.eigenvalues, "low mode with Im >= 0, by modulus"
            ),
            "line": fields.number((), result.line.abscissa, "abscissa of the asymptotic line"),
            "line_spacing": fields.number((), result.line.spacing, "spacing of modes in Im"),
            "line_error": fields.number((), result.line.error_estimate, "error of the line"),
            "abscissa": fields.number((), result.abscissa, "supremum of Re(lambda)"),
            "abscissa_error": fields.number((), result.error_estimate, "error of the abscissa"),
            "governed_by": fields.flag(
                (), result.governed_by == "line", "what the abscissa is due to", ("mode", "line")
            ),
        }
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Low modes, asymptotic line and spectral abscissa, {geometry}",
        equations="(4.1), (4.2)",
        parameters={
            "geometry": geometry,
            "delta_deg": delta_deg,
            "half_angle_deg": half_angle_deg,
            "mu": mu,
        },
    )


if __name__ == "__main__":
    jobs.run(compute_stability, snakemake)  # type: ignore[name-defined]  # noqa: F821
