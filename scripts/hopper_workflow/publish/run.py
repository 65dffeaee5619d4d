"""The finished run in the current directory, as Snakemake knows it."""

import csv
import subprocess
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from hopper_workflow import logs

DATA = {".nc", ".csv"}  # suffixes of inputs that hold data; all other inputs are code


class RunError(Exception):
    """There is no finished run to publish; the message names the command that makes one."""


def products() -> dict[Path, list[Path]]:
    """Return every file the workflow makes, sorted, and the files of data it was made from.

    Raises
    ------
    RunError
        If a file is missing, damaged or older than what it depends on, or the configuration is not
        valid.
    """
    rows = summary()
    stale = [row["output_file"] for row in rows if row["plan"] != "no update"]
    if stale:
        raise RunError(
            f"{len(stale)} of {len(rows)} results are missing or out of date, first {stale[0]}: "
            "build them with: make"
        )
    damaged = damages(rows)
    if damaged:
        raise RunError(
            f"{len(damaged)} of {len(rows)} results are damaged, first {next(iter(damaged))}: "
            "list them with: make verify"
        )
    return {
        Path(row["output_file"]): [
            Path(name) for name in row["input-file(s)"].split(",") if Path(name).suffix in DATA
        ]
        for row in sorted(rows, key=lambda row: row["output_file"])
    }


def summary() -> list[dict[str, str]]:
    """Return Snakemake's detailed summary, a row for every file the workflow makes.

    Raises
    ------
    RunError
        If the configuration is not valid.
    """
    return list(csv.DictReader(snakemake("--detailed-summary").splitlines(), delimiter="\t"))


def damages(rows: Iterable[Mapping[str, str]]) -> dict[str, str]:
    """Return what is wrong with files of the summary that exist, by path; nothing for sound ones.

    A file is sound if the log of its job is, and holds its checksum.
    """
    found = {}
    for row in rows:
        path, log = row["output_file"], row["log-file(s)"]
        if not Path(path).exists():
            continue
        try:
            written = logs.checksums(log).get(path)
        except logs.LogError as error:
            found[path] = f"not vouched for: its log {log} {error}"
        else:
            if logs.checksum(path) != written:
                found[path] = "damaged or foreign: not what its job wrote"
    return found


def snakemake(*arguments: str) -> str:
    """Run Snakemake here and return what it prints to standard output.

    Raises
    ------
    RunError
        With Snakemake's own message if it fails.
    """
    command = [sys.executable, "-m", "snakemake", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RunError(f"snakemake {' '.join(arguments)} failed:\n{done.stderr.strip()}")
    return done.stdout


def publish(write: Callable[[Path], None], path: str) -> None:
    """Write something about the run to ``path``; end in one line and exit code 1 if it can't be."""
    try:
        write(Path(path))
    except (RunError, OSError) as error:
        sys.exit(f"{path} not written: {error}")
    print(path)
