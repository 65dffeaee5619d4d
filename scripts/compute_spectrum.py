"""Discrete spectrum of M on one mesh."""

import logging

import xarray as xr

from hopper.stability.mesh_spectrum import mesh_spectrum
from support import artifacts, fields, hoppers, jobs, modes


def compute_spectrum(
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    mu: float,
    nodes: int,
) -> None:
    """Compute all eigenvalues with their parity and the tails of their eigenvectors."""
    solution = hoppers.radial_solution(geometry, delta_deg, half_angle_deg, mu)
    spectrum = mesh_spectrum(solution, nodes)
    logging.info("%s, %d nodes: %d eigenvalues", geometry, nodes, spectrum.eigenvalues.size)
    dataset = xr.Dataset(
        {
            **fields.complex_number(
                "mode", "eigenvalue", spectrum.eigenvalues, "eigenvalue of M by modulus"
            ),
            "half": modes.half("mode", spectrum.half),
            "eigenvector_tail": fields.number("mode", spectrum.tail, _TAIL),
            "error_radial": fields.number(
                (), solution.error_estimate, "error estimate of the radial solution"
            ),
        }
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Spectrum of the stability operator, {geometry}, {nodes} nodes",
        equations="(4.1), (4.2)",
        parameters={
            "geometry": geometry,
            "delta_deg": delta_deg,
            "half_angle_deg": half_angle_deg,
            "mu": mu,
            "nodes": nodes,
        },
    )


_TAIL = "last tenth of the eigenvector's Chebyshev coefficients over the largest"

if __name__ == "__main__":
    jobs.run(compute_spectrum, snakemake)  # type: ignore[name-defined]  # noqa: F821
