"""Discrete spectrum of M on one mesh."""

import logging
from math import degrees

from hopper_workflow import artifacts, jobs
from hopper.stability.mesh_spectrum import mesh_spectrum
from hopper.stability.tilted import tangency_angle
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.stability import MESH_SPECTRUM
from hopper_data.tables import angle, number, within


def compute_spectrum(
    *, geometry: str, delta_deg: float, half_angle_deg: float, mu: float, nodes: int
) -> CfDataset:
    """Compute all eigenvalues with their parity and the tails of their eigenvectors."""
    solution = solution_of(geometry, delta_deg, half_angle_deg, mu)
    spectrum = mesh_spectrum(solution, nodes)
    logging.info("%s, %d nodes: %d eigenvalues", geometry, nodes, spectrum.eigenvalues.size)
    singular = solution.first_angle_with(tangency_angle(solution.hopper.delta))
    if singular is not None:
        logging.warning("A of (4.1) is singular at theta = %.4f deg", degrees(singular))
    result = {"spectrum": spectrum, "radial": solution, "singular": singular}
    return dataset(result, TABLE)


TABLE = (
    *within("spectrum", MESH_SPECTRUM),
    number("error_radial", "error estimate of the radial solution", source="radial.error_estimate"),
    angle("singular_theta", "least polar angle where A of (4.1) is singular", source="singular"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_spectrum,
            "Spectrum of the stability operator, {geometry}, {nodes} nodes",
            "(4.1), (4.2)",
        )
    )
