"""Logs of jobs: each ends with the checksums of what the job read and wrote, and of itself."""

import hashlib
import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

_SEAL = "sha256 of the lines above: "
_FILE = re.compile(r"^(read |)sha256 ([0-9a-f]{64})  (.+)$", re.MULTILINE)


class LogError(Exception):
    """A log is missing, damaged, or that of a job that did not end well."""


class Record(NamedTuple):
    """Checksums by path of the files that a job read, code excepted, and of those it wrote."""

    read: dict[str, str]
    written: dict[str, str]


def checksum(path: str | Path) -> str:
    """Return the SHA-256 of a file's bytes."""
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def seal(log: str | Path, outputs: Iterable[str], inputs: Iterable[str] = ()) -> None:
    """End the log of a job that is done, so that any later change of it or of an output shows."""
    path = Path(log)
    with path.open("a", encoding="utf-8", newline="\n") as file:
        file.writelines(f"read sha256 {checksum(one)}  {one}\n" for one in inputs)
        file.writelines(f"sha256 {checksum(one)}  {one}\n" for one in outputs)
    digest = checksum(path)
    with path.open("a", encoding="utf-8", newline="\n") as file:
        file.write(f"{_SEAL}{digest}\n")


def record(log: str | Path) -> Record:
    """Return what a sealed log tells of its job.

    Raises
    ------
    LogError
        If the log is missing or is not, byte for byte, one that was sealed.
    """
    path = Path(log)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise LogError(f"cannot be read ({error.strerror})") from None
    body, _, rest = content.rpartition(_SEAL.encode())
    if not body or rest != hashlib.sha256(body).hexdigest().encode() + b"\n":
        raise LogError("is not as the job left it")
    found = Record({}, {})
    for kind, digest, file in _FILE.findall(body.decode("utf-8")):
        (found.read if kind else found.written)[file] = digest
    return found
