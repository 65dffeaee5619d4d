"""The finished run in the current directory, as Snakemake knows it."""

import csv
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

DATA = {".nc", ".csv"}  # suffixes of inputs that hold data; all other inputs are code


class RunError(Exception):
    """There is no finished run to publish; the message names the command that makes one."""


@dataclass(frozen=True)
class Product:
    """A file the workflow made, and the data it was made from."""

    path: Path
    rule: str
    sources: tuple[Path, ...]


def products() -> list[Product]:
    """Return every file the workflow makes, sorted by path.

    Raises
    ------
    RunError
        If a file is missing or older than what it depends on, or the configuration is not valid.
    """
    listing = snakemake("--detailed-summary")
    rows = list(csv.DictReader(listing.splitlines(), delimiter="\t"))
    stale = [row["output_file"] for row in rows if row["plan"] != "no update"]
    if stale or not rows:
        first = stale[0] if stale else "all"
        raise RunError(
            f"{len(stale)} of {len(rows)} results are missing or out of date, first {first}: "
            "build them with: make"
        )
    return sorted(
        (
            Product(
                Path(row["output_file"]),
                row["rule"],
                tuple(
                    Path(name)
                    for name in row["input-file(s)"].split(",")
                    if Path(name).suffix in DATA
                ),
            )
            for row in rows
        ),
        key=lambda product: product.path,
    )


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
