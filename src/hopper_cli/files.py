"""Files that are written whole or not at all, and checked before the work starts."""

import contextlib
import csv
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path


class FileError(Exception):
    """A file cannot be written as asked; the one-line message names the remedy."""


def _partial(target: Path) -> Path:
    # The suffix stays last: writers choose the format by it.
    return target.with_name(f".{target.stem}.{os.getpid()}.partial{target.suffix}")


def _remove_leftovers(target: Path) -> None:
    """Remove the temporary files of writers of ``target`` that were killed."""
    start, end = f".{target.stem}.", f".partial{target.suffix}"
    for path in target.parent.glob(f".*{end}"):
        writer = path.name.removeprefix(start).removesuffix(end)
        if path.name.startswith(start) and writer.isdecimal() and not _is_alive(int(writer)):
            path.unlink(missing_ok=True)


def _is_alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        pass
    return True


@contextlib.contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """Yield a temporary path beside ``path`` and move it there once it is complete."""
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = _partial(target)
    _remove_leftovers(target)
    try:
        yield temporary
        with temporary.open("rb") as file:
            os.fsync(file.fileno())
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


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
        _partial(path).touch()
        _partial(path).unlink()
    except OSError as error:
        raise FileError(f"{path} cannot be written: {error.strerror}") from error
    return path


def write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a table; floats keep all their digits."""
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
