"""Profiles and plots that an answer is asked to write."""

from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hopper_cli.errors import UsageError
from hopper_cli.outputs import write_csv
from hopper_data import assessments, tables
from hopper_data.assessments import Part
from hopper_data.inputs import Case


def write(options: Namespace, case: Case, found: Part, more: dict[str, Any] | None = None) -> None:
    """Write the profile and the plot where they are asked for; ``more`` is what else was given."""
    if options.profile:
        _guarded("--profile", options.profile, lambda path: _write_profile(path, case, found, more))
    if options.plot:
        from hopper_cli import figures

        _guarded("--plot", options.plot, lambda path: figures.write(path, case, found))


def _guarded(option: str, path: Path, write: Callable[[Path], None]) -> None:
    try:
        write(path)
    except (OSError, RuntimeError) as error:  # netCDF4 raises the latter where the disk is full
        raise UsageError(f"argument {option}: {path} cannot be written: {error}") from error


def _write_profile(path: Path, case: Case, found: Part, more: dict[str, Any] | None) -> None:
    if path.suffix.lower() == ".nc":
        from hopper_data import results

        results.write_part(path, case, found, more)
        return
    result, table = assessments.arrays(found)
    columns = [part for variable in table for part in tables.parts(variable, variable.of(result))]
    known = [(variable, values) for variable, values in columns if values is not None]
    header = [f"{variable.name} [{variable.scale or variable.units}]" for variable, _ in known]
    write_csv(path, header, zip(*(values.tolist() for _, values in known), strict=True))
