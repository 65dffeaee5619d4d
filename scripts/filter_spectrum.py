"""Convergence filter: what the spectra of two meshes agree on."""

import logging
from typing import Any

from hopper_workflow import artifacts, columns, jobs
from hopper.spectral.matching import unbroken_run
from hopper.stability.convergence_filter import convergence_filter
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.stability import FILTERED_SPECTRUM, MESH_COLUMNS, read_mesh_spectrum
from hopper_data.tables import number, within


def filter_spectrum(
    fine: str,
    coarse: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    mu: float,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
) -> CfDataset:
    """Judge each eigenvalue of the fine mesh, as the paper words the filter and soundly."""
    hopper: dict[str, Any] = {
        "geometry": geometry,
        "delta_deg": delta_deg,
        "half_angle_deg": half_angle_deg,
        "mu": mu,
    }
    on_fine, on_coarse = (
        read_mesh_spectrum(columns.read(path, MESH_COLUMNS, {**hopper, "nodes": n}), n)
        for path, n in ((fine, nodes), (coarse, coarse_nodes))
    )
    filtered = convergence_filter(on_fine, on_coarse, tolerance)
    run = unbroken_run(filtered.kept_as_worded)
    logging.info(
        "%s: kept %d, as worded %d, first unbroken run [%d, %d)",
        geometry,
        filtered.kept.sum(),
        filtered.kept_as_worded.sum(),
        *run,
    )
    return dataset({"filtered": filtered, "run_start": run[0], "run_stop": run[1]}, TABLE)


TABLE = (
    *within("filtered", FILTERED_SPECTRUM),
    number("run_start", "start of the unbroken run kept as worded"),
    number("run_stop", "end of the unbroken run kept as worded"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            filter_spectrum,
            "Filtered spectrum of the stability operator, {geometry}",
            "(4.2) and the filter of section 4",
        )
    )
