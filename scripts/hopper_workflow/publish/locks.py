"""The packages of the hashed locks."""

import re
from dataclasses import dataclass
from pathlib import Path

LOCKS = {
    name: f"requirements{suffix}.lock"
    for name, suffix in (
        ("run", ""),
        ("cluster", "-cluster"),
        ("dev", "-dev"),
        ("build", "-build"),
        ("cff", "-cff"),
        ("docs", "-docs"),
    )
}
_PIN = re.compile(r"(?P<name>[a-z0-9][a-z0-9._-]*)==(?P<version>[\w.+!-]+)( ; (?P<marker>.+))?")
_HASH = re.compile(r"--hash=sha256:([0-9a-f]{64})")


class LockError(Exception):
    """A lock is missing, or holds something else than pinned packages with hashes."""


@dataclass(frozen=True)
class Package:
    """A pinned package.

    Attributes
    ----------
    name, version : str
    marker : str
        Where it is needed, "" for everywhere.
    hashes : tuple of str
        SHA-256 of its distributions.
    """

    name: str
    version: str
    marker: str
    hashes: tuple[str, ...]


def read(path: str | Path) -> list[Package]:
    """Return the packages of a lock.

    Raises
    ------
    LockError
        If a line is anything else than a pin with hashes: an address, an option, a range.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise LockError(f"{path} cannot be read: {error.strerror}") from None
    packages = []
    for entry in text.replace(" \\\n", "\n").replace("\n    ", " ").splitlines():
        pin, *hashes = re.split(r" (?=--hash)", entry)
        found = _PIN.fullmatch(pin)
        digests = [_HASH.fullmatch(item) for item in hashes]
        if not found or not digests or not all(digests):
            raise LockError(f"{path.name}: {pin} is not a pin with hashes: run make lock")
        digest = tuple(item[1] for item in digests if item)
        packages.append(Package(found["name"], found["version"], found["marker"] or "", digest))
    return packages
