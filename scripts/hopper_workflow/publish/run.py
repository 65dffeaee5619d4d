"""The finished run in the current directory: what the workflow makes, and what its jobs wrote."""

import csv
import os
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from hopper_workflow import effective, logs, surroundings

DATA = {".nc", ".csv"}  # suffixes of inputs that hold data; all other inputs are code
RESULTS = {*DATA, ".json", ".html", ".md", ".png", ".pdf"}
PUBLISHED = ("results/report.html", "results/sbom.cdx.json", "figures/README.md")
BESIDE = {Path("results/figure_checks"), Path("results/site")}  # of which no job knows


class RunError(Exception):
    """There is no finished run to publish; the message names the command that makes one."""


def products(configuration: Path | None) -> dict[Path, list[Path]]:
    """Return every file the workflow makes, sorted, and the files of data it was made from.

    Raises
    ------
    RunError
        If a file is missing, damaged or older than what it depends on, or the configuration is not
        valid.
    """
    summary = snakemake(configuration, "--summary")
    rows = list(csv.DictReader(summary.splitlines(), delimiter="\t"))
    made = sorted(row["output_file"] for row in rows)
    stale = [row["output_file"] for row in rows if row["plan"] != "no update"]
    if stale:
        advice = f"make CONFIG={shlex.quote(str(configuration))}" if configuration else "make"
        raise RunError(
            f"{len(stale)} of {len(rows)} results are missing or out of date, first {stale[0]}: "
            f"build them with: {advice}"
        )
    jobs = records()
    if damaged := damages(made, jobs):
        raise RunError(
            f"{len(damaged)} of {len(rows)} results are damaged, first {next(iter(damaged))}: "
            "list them with: make verify"
        )
    sources = {path: sorted(job.read) for job in jobs for path in job.written}
    return {
        Path(path): [Path(name) for name in sources[path] if Path(name).suffix in DATA]
        for path in made
    }


def existing() -> list[str]:
    """Return the paths, sorted, of what jobs have made here, without what is published of it."""
    found = [path for folder in ("results", "figures") for path in Path(folder).rglob("*.*")]
    return sorted(
        str(path)
        for path in found
        if path.suffix in RESULTS
        and not path.name.startswith(".")
        and str(path) not in PUBLISHED
        and BESIDE.isdisjoint(path.parents)
    )


def records() -> list[logs.Record]:
    """Return what the sound logs tell of their jobs; other logs vouch for nothing."""
    found = []
    for path in sorted(Path("logs").rglob("*.log")):
        try:
            found.append(logs.record(path))
        except logs.LogError:
            continue
    return found


def damages(paths: Iterable[str], jobs: Iterable[logs.Record]) -> dict[str, str]:
    """Return what is wrong with files that exist, by path; nothing for sound ones.

    A file is sound if a log holds its checksum. Where Snakemake keeps its own records does not
    matter: they may be gone.
    """
    written: dict[str, set[str]] = {}
    for job in jobs:
        for path, digest in job.written.items():
            written.setdefault(path, set()).add(digest)
    found = {}
    for path in paths:
        if path not in written:
            found[path] = "not vouched for: no log tells of it, or its log is damaged"
        elif Path(path).exists() and logs.checksum(path) not in written[path]:
            found[path] = "damaged or foreign: not what its job wrote"
    return found


def snakemake(configuration: Path | None, *arguments: str) -> str:
    """Run Snakemake here and return what it prints to standard output.

    Raises
    ------
    RunError
        With Snakemake's own message if it fails.
    """
    command = [sys.executable, "-m", "snakemake", *arguments, *effective.option(configuration)]
    environment = surroundings.settled(os.environ)
    done = subprocess.run(
        command, env=environment, capture_output=True, encoding="utf-8", check=False
    )
    if done.returncode != 0:
        raise RunError(f"snakemake {' '.join(arguments)} failed:\n{done.stderr.strip()}")
    return done.stdout


def configuration() -> Path | None:
    """Return the file the command's argument names, or else that of the last run."""
    return Path(sys.argv[1]) if len(sys.argv) > 1 else effective.of_last_run()


def publish(write: Callable[[Path, Path | None], None], path: str) -> None:
    """Write something about the run to ``path``; end in one line and exit code 1 if it can't be."""
    try:
        write(Path(path), configuration())
    except (RunError, OSError) as error:
        sys.exit(f"{path} not written: {error}")
    print(path)
