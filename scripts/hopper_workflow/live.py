"""Runs that are at work in a directory, and the locks of those that are dead.

Snakemake's locks do not tell whose they are. A run leaves beside them its host and process; they
vanish with the locks. ``python -m hopper_workflow.live`` removes the locks of a run that was
killed, and refuses where one may be at work.
"""

import json
import os
import shutil
import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import psutil

LOCKS = Path(".snakemake/locks")


class LiveRunError(Exception):
    """A run is, or may be, at work here; the one-line message says what to do."""


def leave_record() -> None:
    """Note, beside the locks this process has taken in the current directory, whose they are."""
    process = psutil.Process()
    record = {"host": socket.gethostname(), "process": process.pid, "began": process.create_time()}
    LOCKS.mkdir(parents=True, exist_ok=True)
    (LOCKS / f"{process.pid}.run.json").write_text(json.dumps(record), encoding="utf-8")


def unlock() -> None:
    """Remove the locks in the current directory if those who took them are dead.

    Raises
    ------
    LiveRunError
        If a process on this host is at work here, or if it cannot be known.
    """
    for process in _at_work():
        raise LiveRunError(
            f"process {process.pid} of a run is at work here: wait for it, or end it with: "
            f"kill {process.pid}"
        )
    if not any(LOCKS.glob("*.lock")):
        return
    by_hand = "if it is dead remove its locks with: snakemake --unlock"
    records = [json.loads(path.read_text("utf-8")) for path in LOCKS.glob("*.run.json")]
    if not records:
        raise LiveRunError(f"{LOCKS} does not tell which run left its locks: {by_hand}")
    for record in records:
        if record["host"] != socket.gethostname():
            raise LiveRunError(
                f"process {record['process']} of host {record['host']} has a run here: {by_hand}"
            )
        if _is_alive(**record):
            raise LiveRunError(
                f"the run of process {record['process']} is at work: wait for it, or end it"
            )
    shutil.rmtree(LOCKS)


def _is_alive(process: int, began: float, **_: object) -> bool:
    """Whether a process of this host lives; another of its number began at another time."""
    try:
        return abs(psutil.Process(process).create_time() - began) < 1
    except psutil.NoSuchProcess:
        return False


def _at_work() -> Iterator[psutil.Process]:
    """Yield processes of Snakemake, and jobs it has left behind, in the current directory."""
    here, own = os.getcwd(), {os.getpid(), *(each.pid for each in psutil.Process().parents())}
    for process in psutil.process_iter():
        try:
            if process.pid not in own and process.cwd() == here and _is_snakemake(process):
                yield process
        except psutil.Error:
            continue


def _is_snakemake(process: psutil.Process) -> bool:
    words = process.cmdline()[:3]
    return any(Path(word).name == "snakemake" or "/.snakemake/scripts/" in word for word in words)


if __name__ == "__main__":
    try:
        unlock()
    except LiveRunError as error:
        sys.exit(f"not resumed: {error}")
