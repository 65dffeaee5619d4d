"""Files that the command is asked to write, checked before the work starts."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

from hopper_cli.errors import UsageError
from hopper_data.files import partial, replacing


def require_writable(option: str, path: Path, suffixes: Sequence[str], *, overwrite: bool) -> None:
    """Check that the file of an option, of one of the ``suffixes``, can be written.

    Raises
    ------
    UsageError
        If the suffix is another, the file exists and must not be overwritten, or its folder does
        not exist or cannot be written to; the message names the option and the remedy.
    """
    if problem := _problem(path, suffixes, overwrite):
        raise UsageError(f"argument {option}: {problem}")


def _problem(path: Path, suffixes: Sequence[str], overwrite: bool) -> str:
    if path.suffix.lower() not in suffixes:
        return f"{path} has no known suffix: use {' or '.join(suffixes)}"
    try:
        if path.is_dir():
            return f"{path} is a folder: give the name of a file"
        if path.exists() and not overwrite:
            return f"{path} exists: give another name, or --force to overwrite it"
        if not path.parent.is_dir():
            return f"the folder {path.parent} does not exist: create it first"
        partial(path).touch()
        partial(path).unlink()
    except OSError as error:
        return f"{path} cannot be written: {error.strerror}"
    return ""


def write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table; floats keep all their digits."""
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
