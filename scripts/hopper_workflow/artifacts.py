"""Write and verify netCDF artifacts (CF, ACDD), each with a provenance side file."""

import json
import platform
from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from importlib.metadata import version
from inspect import Parameter, signature
from pathlib import Path
from typing import Any

import hopper
from hopper_data import cf
from hopper_data.cf import plain
from hopper_data.contents import CfDataset
from hopper_data.files import replacing as replacing
from hopper_workflow.commit import commit
from hopper_workflow.logs import checksum as checksum

_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "matplotlib", "snakemake")


class ArtifactError(Exception):
    """An artifact is missing, damaged, or was made from another configuration."""


def write(
    dataset: CfDataset,
    path: str | Path,
    provenance: str | Path,
    *,
    title: str,
    equations: str,
    parameters: Mapping[str, Any],
) -> None:
    """Write a dataset and its provenance; the netCDF file holds nothing that varies between runs.

    ``equations`` names the equations or sections of the paper the data come from, ``parameters``
    the part of the configuration they depend on.
    """
    cf.write(
        dataset,
        path,
        title=title,
        equations=equations,
        parameters=parameters,
        history=f"{cf.WRITTEN_BY}; see the .provenance.json beside this file",
    )
    _write_provenance(Path(path), Path(provenance), title, equations, parameters)


def writing(compute: Callable[..., CfDataset], title: str, equations: str) -> Callable[..., None]:
    """Return the function of a computing rule: it writes the dataset that ``compute`` returns.

    ``compute`` takes the job's inputs, and its params as keywords only; these are the artifact's
    parameters, and ``title`` may name them in braces.
    """

    def write_artifact(*, artifact: str, provenance: str, **arguments: Any) -> None:
        kinds = signature(compute).parameters
        parameters = {
            name: value
            for name, value in arguments.items()
            if name not in kinds or kinds[name].kind is Parameter.KEYWORD_ONLY
        }
        write(
            compute(**arguments),
            artifact,
            provenance,
            title=title.format(**parameters),
            equations=equations,
            parameters=parameters,
        )

    return write_artifact


def _write_provenance(
    path: Path, provenance: Path, title: str, equations: str, parameters: Mapping[str, Any]
) -> None:
    record = {
        "artifact": path.name,
        "title": title,
        "equations": equations,
        "sha256": checksum(path),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "parameters": json.loads(plain(parameters)),
        "hopper": hopper.__version__,
        "commit": commit(),
        "python": platform.python_version(),
        "machine": platform.machine(),
        "packages": {name: version(name) for name in _PACKAGES},
    }
    with replacing(provenance) as temporary:
        temporary.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


def verify(path: str | Path) -> None:
    """Check that an artifact has, byte for byte, the content its provenance tells of.

    Raises
    ------
    ArtifactError
        If it is missing, damaged or not one of ours; the message names the command that rebuilds
        it.
    """
    remedy = f"rebuild it with: snakemake --force {path}"
    provenance = Path(path).with_suffix(".provenance.json")
    try:
        found = checksum(path)
    except FileNotFoundError:
        raise ArtifactError(
            f"artifact {path} is missing: build it with: snakemake {path}"
        ) from None
    except OSError as error:
        raise ArtifactError(f"artifact {path} cannot be read ({error.strerror})") from error
    try:
        recorded = json.loads(provenance.read_text(encoding="utf-8"))["sha256"]
    except (OSError, ValueError, LookupError, TypeError):
        raise ArtifactError(
            f"artifact {path} has no readable {provenance.name} beside it: {remedy}"
        ) from None
    if found != recorded:
        raise ArtifactError(
            f"artifact {path} is damaged or foreign: its checksum is not that of "
            f"{provenance.name}; {remedy}"
        )


def require_parameters(
    path: str | Path, attributes: Mapping[str, Any], parameters: Mapping[str, Any] | None
) -> None:
    """Check that an artifact with these attributes holds the parameters, if any are given.

    Raises
    ------
    ArtifactError
        If it was made with others.
    """
    if parameters is not None and attributes["parameters"] != plain(parameters):
        raise ArtifactError(
            f"artifact {path} belongs to another configuration: "
            f"rebuild it with: snakemake --force {path}"
        )
