"""Exact smooth-wall eigenvalues of a hopper, the crosses of Figure 4.2."""

from math import radians

import numpy as np
import xarray as xr

from hopper.stability import smooth_wall
from support import artifacts, fields, jobs


def compute_exact_spectrum(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    modes: int,
) -> None:
    """Evaluate (4.7) for a wedge, (4.9) with Bessel and exact wavenumbers for a cone."""
    delta, half_angle = radians(delta_deg), radians(half_angle_deg)
    if geometry == "wedge":
        parts = dict(
            zip(
                ("sine", "cosine"),
                smooth_wall.wedge_eigenvalues(delta, half_angle, modes),
                strict=True,
            )
        )
    else:
        parts = {
            variant: smooth_wall.cone_eigenvalues(
                delta, smooth_wall.cone_wavenumbers(half_angle, modes, variant)
            )
            for variant in ("bessel", "legendre")
        }
    kinds = tuple(parts)
    values = np.concatenate(list(parts.values()))
    code = np.repeat(np.arange(len(kinds)), [part.size for part in parts.values()])
    dataset = xr.Dataset(
        {
            **fields.complex_number("mode", "eigenvalue", values, "smooth-wall eigenvalue"),
            "kind": fields.flag("mode", code, "family or equation", kinds),
        }
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Exact smooth-wall eigenvalues, {geometry}",
        equations="(4.7), (4.8), (4.9)",
        parameters={
            "geometry": geometry,
            "delta_deg": delta_deg,
            "half_angle_deg": half_angle_deg,
            "modes": modes,
        },
    )


if __name__ == "__main__":
    jobs.run(compute_exact_spectrum, snakemake)  # type: ignore[name-defined]  # noqa: F821
