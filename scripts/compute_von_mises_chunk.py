"""Some rows of a map of von Mises cones: every n-th delta, all wall friction angles."""

from typing import Any

from hopper_workflow import artifacts, jobs, maps
from hopper.domain.coupled import sweep_coupled
from hopper_data.contents import CfDataset
from hopper_data.domain import COUPLED_SWEEP


def compute_von_mises_chunk(*, geometry: str, half_angle_deg: float, **grid: Any) -> CfDataset:
    """Judge cones of von Mises material."""
    return maps.swept(sweep_coupled, COUPLED_SWEEP, (geometry, half_angle_deg, "von-mises"), **grid)


if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_von_mises_chunk,
            "Rows of the map of verdicts, von Mises {geometry}",
            "(2.8)-(2.15), linearised",
        )
    )
