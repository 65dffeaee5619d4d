"""The workflow in units of the paper's algorithm: one hopper's two full eigenproblems, in one run.

Wall times of builds from nothing on two cores over that of the unit, measured before and after
each, as other load and the clock of these machines drift. Below them what a job spends before its
own work, and what figures cost, in processor time over that of the unit.
"""

import csv
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from math import radians
from pathlib import Path
from statistics import mean, median

from benchmarks.bench_domain import POINT, row
from benchmarks.paper import by_the_paper
from hopper import Hopper, solve_radial

ROOT = Path(__file__).parents[1]
# A build, its targets, and the most units it may take.
BUILDS = (("the paper's figures", "paper", 160), ("everything", "all", 420))
MOST_NOTHING = 8
# Seconds where the unit took .31 s: what may be spent before a job's own work, and on a figure.
UNIT = 0.31
SCRIPTS = {"plot_fig_4_4": 0.90, "compute_transient": 0.48, "compute_spectrum": 0.30}
FIGURE = 1.9


def elapsed(call: Callable[[], object]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def unit() -> float:
    """Return the seconds of the paper's algorithm for a hopper."""
    delta, phi = map(radians, POINT)
    solution = solve_radial(Hopper("cone", delta, radians(10)), phi)
    by_the_paper(solution)
    return median(elapsed(lambda: by_the_paper(solution)) for _ in range(5))


def built(clone: Path, target: str) -> float:
    """Build a target in a clone; return its time in units, those before and after."""
    command = [sys.executable, "-m", "snakemake", "--cores", "2", "--quiet", "all", "--", target]
    before = unit()
    seconds = elapsed(lambda: subprocess.run(command, cwd=clone, check=True, capture_output=True))
    return seconds / mean([before, unit()])


def cpu_of(code: str) -> float:
    """Return the least processor seconds of a Python that runs some code."""
    found = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([sys.executable, "-c", code], check=True, cwd=ROOT / "scripts")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        found.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(found)


def costs_of_figures(clone: Path) -> list[float]:
    """Return the processor seconds of every plot of a finished run."""
    logs = clone / "logs"
    return [
        float(line["cpu_time"])
        for path in sorted(logs.rglob("*.benchmark.tsv"))
        if path.relative_to(logs).parts[0].startswith("plot_")
        for line in csv.DictReader(path.read_text(encoding="utf-8").splitlines(), delimiter="\t")
    ]


def main() -> None:
    """Build in clones of the repository, and print ratios."""
    row("the unit, s", unit())
    with tempfile.TemporaryDirectory() as folder:
        for label, target, most in BUILDS:
            clone = Path(folder) / target
            subprocess.run(["git", "clone", "-q", str(ROOT), str(clone)], check=True)
            row(f"{label}, from nothing: units", built(clone, target), f"<= {most}")
        row("nothing to do: units", built(clone, target), f"<= {MOST_NOTHING}")
        figures = costs_of_figures(clone)
        name = f"a figure, mean of {len(figures)}: units"
        row(name, mean(figures) / unit(), f"<= {FIGURE / UNIT:.2g}")
    for script, limit in SCRIPTS.items():
        # As Snakemake begins a job.
        seconds = cpu_of(f"from snakemake import script; import {script}")
        row(f"{script} before its own work: units", seconds / unit(), f"<= {limit / UNIT:.2g}")


if __name__ == "__main__":
    main()
