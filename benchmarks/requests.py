"""Measured costs of all rules, and what follows from them: `make requests`.

`python -m benchmarks.requests [RUN]` reads the benchmark files of the finished run in RUN, by
default this directory, measures what a point of a stability map costs the rules that read or
write maps, and writes resources/benchmarks.tsv, the requests in profiles/slurm/config.yaml and the
costs in docs/cluster.md.
"""

import csv
import subprocess
import sys
import tempfile
from math import ceil
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "scripts"))

from hopper_workflow.requests import Cost, of_job, read_costs  # noqa: E402

TABLE = ROOT / "resources/benchmarks.tsv"
PROFILE = ROOT / "profiles/slurm/config.yaml"
DOCUMENT = ROOT / "docs/cluster.md"
MARKS = {PROFILE: ("# Below: ", None), DOCUMENT: ("<!-- Below: ", "<!-- Above")}
# Their jobs ask by the size of the map, in workflow/rules.
OF_MAPS = ("compute_map_chunk", "merge_map", "plot_fig_4_5_map", "judge_claims")
# Large enough to outweigh what else the rules need.
SIDE = 4000
LARGE = {"side": 10_000, "chunks": 400, "jobs": 100}
MAPS = 4
BYTES_STORED = 33  # of a point: four numbers of 8 bytes and a flag


def measured(run: Path) -> dict[str, Cost]:
    """Return seconds and mebibytes of the slowest and the largest job of each rule of a run."""
    costs: dict[str, Cost] = {}
    for path in sorted((run / "logs").rglob("*.benchmark.tsv")):
        rule = path.relative_to(run / "logs").parts[0].removesuffix(".benchmark.tsv")
        with path.open(encoding="utf-8", newline="") as file:
            row = next(csv.DictReader(file, delimiter="\t"))
        last = costs.get(rule, Cost(rule, 0, 0))
        costs[rule] = Cost(
            rule, max(last.seconds, float(row["s"])), max(last.mebibytes, float(row["max_rss"]))
        )
    if not costs:
        sys.exit(f"no benchmark files in {run / 'logs'}: make a full run first")
    return dict(sorted(costs.items()))


def grown(costs: dict[str, Cost], run: Path) -> dict[str, Cost]:
    """Add what a further point costs, from one made-up map; time of a chunk from the run."""
    sizes = yaml.safe_load((run / "config.yaml").read_text(encoding="utf-8"))["stability_map"]
    rows, columns = sizes["delta_deg"]["points"], sizes["phi_deg"]["points"]
    points = dict.fromkeys(OF_MAPS, rows * columns)
    points["compute_map_chunk"] = ceil(rows / sizes["chunks"]) * columns
    result = dict(costs)
    with tempfile.TemporaryDirectory() as folder:
        for rule in ("compute_map_chunk", "write chunks", *OF_MAPS[1:]):
            command = ["benchmarks.map_growth", rule, str(SIDE), str(run.resolve()), folder]
            done = subprocess.run(
                [sys.executable, "-m", *command],
                cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True,
            )  # fmt: skip
            if rule not in costs:
                continue
            seconds, mebibytes = map(float, done.stdout.split())
            cost, further = costs[rule], SIDE**2 - points[rule]
            microseconds = 1e6 * max(0, seconds - cost.seconds) / further
            if rule == "compute_map_chunk":
                microseconds = 1e6 * cost.seconds / points[rule]
            growth = max(0, mebibytes - cost.mebibytes) * 2**20 / further
            result[rule] = cost._replace(
                points=points[rule], microseconds=microseconds, bytes=growth
            )
    return result


def table(costs: dict[str, Cost]) -> str:
    """Return the table of costs as text."""
    lines = ["\t".join(Cost._fields)]
    for cost in costs.values():
        numbers = (cost.seconds, cost.mebibytes, cost.points, cost.microseconds, cost.bytes)
        lines.append("\t".join([cost.rule, *(f"{number:.6g}" for number in numbers)]))
    return "\n".join(lines) + "\n"


def requests(costs: dict[str, Cost]) -> str:
    """Return the requests of all rules but those of maps, as YAML for the profile."""
    lines = ["set-resources:"]
    for rule, cost in costs.items():
        if rule not in OF_MAPS:
            asked = of_job(cost)
            lines += [f"  {rule}:", *(f"    {name}: attempt * {n}" for name, n in asked.items())]
    return "\n".join(lines) + "\n"


def large_map(costs: dict[str, Cost]) -> str:
    """Return what a large map costs, as Markdown for the document."""
    side, points, chunk = LARGE["side"], LARGE["side"] ** 2, costs["compute_map_chunk"]
    of_chunk = ceil(side / LARGE["chunks"]) * side
    jobs_of = {"compute_map_chunk": MAPS * LARGE["chunks"], "merge_map": MAPS}
    hours = points * chunk.microseconds / 3.6e9
    alone, large = chunk.at(points // 2)
    lines = [
        f"- A point: {chunk.microseconds / 1e3:.2f} ms, as in the slowest chunk of the paper's "
        f"maps, {chunk.seconds:g} s for {chunk.points} points.",
        f"- {side} by {side} points: {hours:.1f} core hours for a map, {MAPS * hours:.0f} for the "
        f"{MAPS} of Figure 4.5; with {LARGE['jobs']} jobs at a time "
        f"{MAPS * hours / LARGE['jobs']:.1f} hours.",
        f"- On disk: {BYTES_STORED * points / 1e9:.1f} GB for a map, and the same for its chunks.",
        f"- With `chunks: 2` a chunk would take {alone / 3600:.0f} hours and "
        f"{large / 1024:.1f} GiB; with `chunks: {LARGE['chunks']}`:",
        "",
        "| Rule | Points | Jobs | Minutes | MiB | Asks for minutes | Asks for MB |",
        "|---|---|---|---|---|---|---|",
    ]
    for rule in OF_MAPS:
        size = of_chunk if rule == "compute_map_chunk" else points
        seconds, mebibytes = costs[rule].at(size)
        asked = of_job(costs[rule], size)
        lines.append(
            f"| `{rule}` | {size:.3g} | {jobs_of.get(rule, 1)} | {seconds / 60:.1f} | "
            f"{mebibytes:.0f} | {asked['runtime']} | {asked['mem_mb']} |"
        )
    return "\n".join(lines) + "\n"


def replaced(path: Path, part: str) -> str:
    """Return the text of a file with the part between its marks replaced."""
    start, stop = MARKS[path]
    text = path.read_text(encoding="utf-8")
    begin = text.index("\n", text.index(start)) + 1
    end = text.index(stop) if stop else len(text)
    return text[:begin] + part + text[end:]


def rendered(costs: dict[str, Cost]) -> dict[Path, str]:
    """Return the texts of profile and document."""
    return {
        PROFILE: replaced(PROFILE, requests(costs)),
        DOCUMENT: replaced(DOCUMENT, "\n" + large_map(costs) + "\n"),
    }


def main() -> None:
    """Measure and write."""
    run = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT
    costs = grown(measured(run), run)
    TABLE.write_text(table(costs), encoding="utf-8")
    for path, text in rendered(read_costs(TABLE)).items():
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
