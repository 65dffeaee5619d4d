"""Read and write netCDF artifacts (CF, ACDD), each with a provenance side file."""

import hashlib
import json
import platform
import subprocess
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import xarray as xr

from hopper import __version__
from hopper_cli import cf
from hopper_cli.cf import plain as plain
from hopper_cli.files import replacing as replacing

_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "matplotlib", "snakemake")


class ArtifactError(Exception):
    """An artifact is missing, damaged, or was made from another configuration."""


def write(
    dataset: xr.Dataset,
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
        history=f"written by hopper {__version__}; see the .provenance.json beside this file",
    )
    _write_provenance(Path(path), Path(provenance), title, equations, parameters)


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
        "hopper": __version__,
        "commit": _commit(),
        "python": platform.python_version(),
        "machine": platform.machine(),
        "packages": {name: version(name) for name in _PACKAGES},
    }
    with replacing(provenance) as temporary:
        temporary.write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


def checksum(path: str | Path) -> str:
    """Return the SHA-256 of a file's bytes."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def _commit() -> str | None:
    """Return `git describe` of the code, None outside a repository."""
    command = ["git", "describe", "--always", "--dirty", "--abbrev=12"]
    try:
        done = subprocess.run(
            command, cwd=Path(__file__).parent, capture_output=True, text=True, check=True
        )
    except (OSError, subprocess.CalledProcessError):
        return None
    return done.stdout.strip()


def read(path: str | Path, parameters: Mapping[str, Any] | None = None) -> xr.Dataset:
    """Load an artifact into memory.

    Raises
    ------
    ArtifactError
        If the file is missing or damaged, is not one of ours, or holds other parameters than
        ``parameters``; the message names the command that rebuilds it.
    """
    remedy = f"delete it and rebuild it with: snakemake {path}"
    try:
        with xr.open_dataset(path, engine="netcdf4") as dataset:
            loaded = dataset.load()
    except FileNotFoundError:
        raise ArtifactError(
            f"artifact {path} is missing: build it with: snakemake {path}"
        ) from None
    except (OSError, ValueError, RuntimeError) as error:
        raise ArtifactError(f"artifact {path} is damaged ({error}): {remedy}") from error
    if "parameters" not in loaded.attrs:
        raise ArtifactError(f"artifact {path} was not written by this workflow: {remedy}")
    if parameters is not None and loaded.attrs["parameters"] != plain(parameters):
        raise ArtifactError(f"artifact {path} belongs to another configuration: {remedy}")
    return loaded
