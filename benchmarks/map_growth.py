"""One rule that reads or writes stability maps, on a made-up map of SIDE x SIDE points.

`python -m benchmarks.map_growth RULE SIDE RUN FOLDER` prints its processor seconds and its peak of
memory in MiB. RUN is the directory of a finished run, for what else the rule reads; the made-up
files go to FOLDER. A real map of a size that shows the memory of a point would take hours.
"""

import resource
import sys
import time
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).parents[1] / "scripts"))

import compute_map_chunk
import judge_claims
import plot_fig_4_5_map
from hopper_workflow import artifacts, merging, plotting
from hopper.domain.stability_map import Sweep
from hopper_workflow.claims.words import paths_of, read_claims

MAP = {
    "geometry": "cone",
    "half_angle_deg": 10.0,
    "delta_deg": {"start": 12, "stop": 60},
    "phi_deg": {"start": 0, "stop": 30},
}
CHUNKS = 2


def made_up(_hopper: object, phis: np.ndarray) -> Sweep:
    numbers = [np.random.default_rng(0).normal(size=phis.size) for _ in range(6)]
    codes = np.zeros(phis.size, dtype=np.int8)
    a, b, c, d, e, f = numbers
    return Sweep(phis, codes, a, b, c, d, e, f, codes, codes)


def write_chunk(path: Path, side: int, chunk: int, chunks: int) -> None:
    with patch("compute_map_chunk.sweep_friction", made_up):
        write_artifact(
            compute_map_chunk.compute_map_chunk,
            path,
            **with_points(side),
            chunk=chunk,
            chunks=chunks,
        )


def write_artifact(compute: Any, path: Path, **arguments: Any) -> None:
    provenance = path.with_suffix(".provenance.json")
    artifacts.writing(compute, "Map", "none")(
        artifact=str(path), provenance=str(provenance), **arguments
    )


def with_points(side: int) -> dict[str, Any]:
    return {
        name: {**value, "points": side} if isinstance(value, dict) else value
        for name, value in MAP.items()
    }


def measure(rule: str, side: int, run: Path, folder: Path) -> None:
    chunks = [folder / f"{chunk}.nc" for chunk in range(CHUNKS)]
    if rule == "compute_map_chunk":
        write_chunk(folder / "map.nc", side, 0, 1)
    elif rule == "write chunks":
        for chunk, path in enumerate(chunks):
            write_chunk(path, side, chunk, CHUNKS)
    elif rule == "merge_map":
        paths = [str(path) for path in chunks]
        write_artifact(merging.merged, folder / "map.nc", chunks=paths, **with_points(side))
    elif rule == "judge_claims":
        claims, schema = run / "resources/claims.yaml", run / "workflow/schemas/claims.schema.yaml"
        paths = [
            str(folder / "map.nc") if Path(path).parent.name == "map" else str(run / path)
            for path in paths_of(read_claims(claims, schema))
        ]
        judge_claims.judge_claims(str(claims), str(schema), paths, str(folder / "claims.csv"))
    else:
        config = yaml.safe_load((run / "config.yaml").read_text(encoding="utf-8"))
        plotting.saving(plot_fig_4_5_map.draw)(
            maps=4 * [str(folder / "map.nc")],
            borders=4 * [str(run / "results/borders/cone_10.nc")],
            panels=list("abcd"),
            color_range=config["fig_4_5_map"]["color_range"],
            png=str(folder / "map.png"),
            pdf=str(folder / "map.pdf"),
        )


def main() -> None:
    rule, side, run, folder = sys.argv[1], int(sys.argv[2]), Path(sys.argv[3]), Path(sys.argv[4])
    start = time.process_time()
    measure(rule, side, run, folder)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**10
    print(time.process_time() - start, peak)


if __name__ == "__main__":
    main()
