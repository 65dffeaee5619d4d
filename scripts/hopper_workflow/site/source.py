"""The folder of pages that Sphinx reads: written only where it changes, for quick rebuilds."""

import shutil
from pathlib import Path


class SiteError(Exception):
    """The site cannot be built; the one-line message names the place and the remedy."""


class Source:
    """A folder of pages in the making.

    What was written is kept; ``finish`` removes what an earlier build left and this one did not
    write. Files keep their time where their content is the same, which Sphinx goes by.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._written: set[Path] = set()

    def write(self, name: str, text: str) -> None:
        """Write a page."""
        path = self._new(name)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")

    def copy(self, name: str, origin: Path) -> None:
        """Copy a file with its time."""
        path = self._new(name)
        if not path.exists() or _stamp(path) != _stamp(origin):
            shutil.copy2(origin, path)

    def finish(self) -> bool:
        """Remove the files that nobody has written; return whether there were any."""
        removed = False
        for path in sorted(self.folder.rglob("*"), reverse=True):
            if path.is_file() and path not in self._written:
                path.unlink()
                removed = True
            elif path.is_dir() and not any(path.iterdir()):
                path.rmdir()
        return removed

    def _new(self, name: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        self._written.add(path)
        return path


def _stamp(path: Path) -> tuple[int, int]:
    status = path.stat()
    return status.st_mtime_ns, status.st_size


def heading(title: str, mark: str = "=") -> str:
    """Return a heading in reStructuredText."""
    return f"{title}\n{mark * max(len(title), 3)}\n"
