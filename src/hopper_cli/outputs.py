"""Files that the command is asked to write, checked before the work starts."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

from hopper_data.files import partial, replacing


class FileError(Exception):
    """A file cannot be written as asked; the one-line message names the remedy."""


def checked(path: Path, suffixes: Sequence[str], *, overwrite: bool) -> Path:
    """Return ``path`` if a file of one of the ``suffixes`` can be written there.

    Raises
    ------
    FileError
        If the suffix is another, the file exists and must not be overwritten, or its folder does
        not exist or cannot be written to.
    """
    if path.suffix.lower() not in suffixes:
        raise FileError(f"{path} has no known suffix: use {' or '.join(suffixes)}")
    try:
        if path.is_dir():
            raise FileError(f"{path} is a folder: give the name of a file")
        if path.exists() and not overwrite:
            raise FileError(f"{path} exists: give another name, or --force to overwrite it")
        if not path.parent.is_dir():
            raise FileError(f"the folder {path.parent} does not exist: create it first")
        partial(path).touch()
        partial(path).unlink()
    except OSError as error:
        raise FileError(f"{path} cannot be written: {error.strerror}") from error
    return path


def write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table; floats keep all their digits."""
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
