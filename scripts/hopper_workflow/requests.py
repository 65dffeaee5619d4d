"""What jobs ask of a cluster, run time and memory, from the measured costs of their rules."""

import csv
from math import ceil
from pathlib import Path
from typing import NamedTuple

# Beside the job runs Snakemake, twice; files of a cluster are slow; other processors are slower.
_START_MINUTES, _SNAKEMAKE_MEGABYTES = 5, 500
_SLOWER, _LARGER = 3, 1.5
_MEGABYTES_STEP = 100


class Cost(NamedTuple):
    """Cost of a rule: a row of benchmarks.tsv.

    ``seconds`` and ``mebibytes`` are those of its slowest and largest job, which had ``points``
    points of a stability map; where maps cost nothing the last three are 0. ``microseconds`` and
    ``bytes`` are for each further point.
    """

    rule: str
    seconds: float
    mebibytes: float
    points: int = 0
    microseconds: float = 0
    bytes: float = 0

    def at(self, points: int) -> tuple[float, float]:
        """Return seconds and mebibytes of a job with this many points of a map."""
        more = max(0, points - self.points)
        return (
            self.seconds + self.microseconds * more / 1e6,
            self.mebibytes + self.bytes * more / 2**20,
        )


def read_costs(path: str | Path) -> dict[str, Cost]:
    """Read a table of costs, by rule."""
    with Path(path).open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    return {
        row["rule"]: Cost(
            row["rule"],
            float(row["seconds"]),
            float(row["mebibytes"]),
            int(row["points"]),
            float(row["microseconds"]),
            float(row["bytes"]),
        )
        for row in rows
    }


def of_job(cost: Cost, points: int = 0) -> dict[str, int]:
    """Return minutes and megabytes to ask for, as Snakemake names them."""
    seconds, mebibytes = cost.at(points)
    megabytes = _SNAKEMAKE_MEGABYTES + _LARGER * mebibytes * 2**20 / 1e6
    return {
        "runtime": ceil(_START_MINUTES + _SLOWER * seconds / 60),
        "mem_mb": _MEGABYTES_STEP * ceil(megabytes / _MEGABYTES_STEP),
    }
