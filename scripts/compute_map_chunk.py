"""Some rows of a stability map: every n-th delta, all wall friction angles."""

from typing import Any

from hopper_workflow import artifacts, jobs, maps
from hopper.domain.stability_map import sweep_friction
from hopper_data.contents import CfDataset
from hopper_data.domain import SWEEP


def compute_map_chunk(*, geometry: str, half_angle_deg: float, **grid: Any) -> CfDataset:
    """Judge hoppers of Mohr-Coulomb material."""
    hopper = geometry, half_angle_deg, "mohr-coulomb"
    return maps.swept(sweep_friction, SWEEP, hopper, **grid)


if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_map_chunk, "Rows of the stability map, {geometry}", "(4.1), (4.2)"
        )
    )
