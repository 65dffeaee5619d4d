"""Convergence filter: what the spectra of two meshes agree on."""

import logging

import xarray as xr

from hopper.spectral.matching import unbroken_run
from hopper.stability.convergence_filter import convergence_filter
from hopper.stability.mesh_spectrum import MeshSpectrum
from support import artifacts, fields, jobs, modes


def filter_spectrum(
    fine: str,
    coarse: str,
    artifact: str,
    provenance: str,
    *,
    geometry: str,
    delta_deg: float,
    half_angle_deg: float,
    mu: float,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
) -> None:
    """Judge each eigenvalue of the fine mesh, as the paper words the filter and soundly."""
    hopper = {
        "geometry": geometry,
        "delta_deg": delta_deg,
        "half_angle_deg": half_angle_deg,
        "mu": mu,
    }
    result = convergence_filter(
        _read(fine, hopper, nodes), _read(coarse, hopper, coarse_nodes), tolerance
    )
    run = unbroken_run(result.kept_as_worded)
    logging.info(
        "%s: kept %d, as worded %d, first unbroken run [%d, %d)",
        geometry,
        result.kept.sum(),
        result.kept_as_worded.sum(),
        *run,
    )
    dataset = xr.Dataset(
        {
            **fields.complex_number(
                "mode", "eigenvalue", result.fine.eigenvalues, "eigenvalue of M by modulus"
            ),
            "half": modes.half("mode", result.fine.half),
            "eigenvector_tail": fields.number("mode", result.fine.tail, "tail of the eigenvector"),
            "change": fields.number(
                "mode", result.change, "relative distance to the one-to-one partner, inf without"
            ),
            "change_nearest": fields.number(
                "mode", result.change_nearest, "relative distance to the nearest on the coarse mesh"
            ),
            "kept": fields.flag("mode", result.kept, "kept by the sound filter", _NO_YES),
            "kept_as_worded": fields.flag(
                "mode", result.kept_as_worded, "kept by the filter as the paper words it", _NO_YES
            ),
            "reason": modes.reason("mode", result.reason),
            "run_start": fields.number((), run[0], "start of the unbroken run kept as worded"),
            "run_stop": fields.number((), run[1], "end of the unbroken run kept as worded"),
        }
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title=f"Filtered spectrum of the stability operator, {geometry}",
        equations="(4.2) and the filter of section 4",
        parameters={
            **hopper,
            "nodes": nodes,
            "coarse_nodes": coarse_nodes,
            "tolerance": tolerance,
        },
    )


def _read(path: str, hopper: dict[str, object], nodes: int) -> MeshSpectrum:
    data = artifacts.read(path, parameters={**hopper, "nodes": nodes})
    return MeshSpectrum(
        nodes,
        fields.as_complex(data, "eigenvalue"),
        data.half.to_numpy(),
        data["eigenvector_tail"].to_numpy(),
    )


_NO_YES = ("no", "yes")

if __name__ == "__main__":
    jobs.run(filter_spectrum, snakemake)  # type: ignore[name-defined]  # noqa: F821
