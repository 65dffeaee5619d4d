"""Low modes in the physical formulation, the line, and the spectral abscissa they give."""

import logging

from hopper_workflow import artifacts, jobs
from hopper.stability.modes import linear_stability
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import solution_of
from hopper_data.stability import STABILITY


def compute_stability(
    *, geometry: str, delta_deg: float, half_angle_deg: float, mu: float
) -> CfDataset:
    """Compute the verdict of stability that needs no large mesh."""
    result = linear_stability(solution_of(geometry, delta_deg, half_angle_deg, mu))
    logging.info(
        "%s: abscissa %.10f (%s), line %.10f",
        geometry,
        result.abscissa,
        result.governed_by,
        result.line.abscissa,
    )
    return dataset(result, STABILITY)


if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_stability,
            "Low modes, asymptotic line and spectral abscissa, {geometry}",
            "(4.1), (4.2)",
        )
    )
