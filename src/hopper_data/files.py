"""Files that are written whole or not at all, and read where HDF5 has no locks."""

import contextlib
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

_Loaded = TypeVar("_Loaded")


def partial(target: Path) -> Path:
    """Return the path of the temporary file of this process, beside ``target``."""
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
    temporary = partial(target)
    _remove_leftovers(target)
    try:
        yield temporary
        with temporary.open("rb") as file:
            os.fsync(file.fileno())
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


def loaded(load: Callable[[str | Path], _Loaded], path: str | Path) -> _Loaded:
    """Return what a function loads of a netCDF file.

    Raises
    ------
    OSError
        If it is missing or not a netCDF file.
    """
    try:
        return load(path)
    except OSError:
        if not Path(path).is_file():
            raise
        # Not a netCDF file, or one on a file system that has no locks for HDF5.
        with tempfile.TemporaryDirectory() as folder:
            return load(shutil.copy2(path, folder))
