"""Discrete spectrum of M on one mesh."""

import logging

import xarray as xr

from hopper_workflow import artifacts, jobs
from hopper.stability.mesh_spectrum import mesh_spectrum
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.stability import MESH_SPECTRUM
from hopper_data.tables import number, within


def compute_spectrum(
    *, geometry: str, delta_deg: float, half_angle_deg: float, mu: float, nodes: int
) -> xr.Dataset:
    """Compute all eigenvalues with their parity and the tails of their eigenvectors."""
    solution = solution_of(geometry, delta_deg, half_angle_deg, mu)
    spectrum = mesh_spectrum(solution, nodes)
    logging.info("%s, %d nodes: %d eigenvalues", geometry, nodes, spectrum.eigenvalues.size)
    return dataset({"spectrum": spectrum, "error_radial": solution.error_estimate}, TABLE)


TABLE = (
    *within("spectrum", MESH_SPECTRUM),
    number("error_radial", "error estimate of the radial solution"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_spectrum,
            "Spectrum of the stability operator, {geometry}, {nodes} nodes",
            "(4.1), (4.2)",
        )
    )
