"""All hoppers of the list `cases` in one table: sentence, verdict, numbers, shares of ranges."""

import csv
from collections.abc import Sequence
from typing import Any

from hopper_workflow import artifacts, jobs, own_hoppers, reading
from hopper_data.hopper_lists import harmless

_NUMBERS = ("abscissa", "abscissa_error", "flow_factor", "flow_factor_error")
_COLUMNS = (
    *("name", "geometry", "model", "delta_deg", "half_angle_deg", "mu", "phi_deg"),
    *("sentence", "verdict", *_NUMBERS, "shares", "reason"),
)


def summarise_cases(paths: Sequence[str], table: str, *, cases: Sequence[dict[str, Any]]) -> None:
    """Write a row for each case, as CSV; ``paths`` are their artifacts, in order."""
    with artifacts.replacing(table) as path, path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, _COLUMNS, lineterminator="\n")
        writer.writeheader()
        for case, artifact in zip(cases, paths, strict=True):
            writer.writerow(_row(case, artifact))


def _row(case: dict[str, Any], artifact: str) -> dict[str, Any]:
    data = reading.read(artifact)
    given = own_hoppers.middle(case) | case
    numbers = {name: float(data[name]) if name in data else "" for name in _NUMBERS}
    words = {
        "sentence": data.attrs["sentence"],
        "verdict": data.outcome.item(),
        "shares": data.attrs.get("shares", ""),
        "reason": data.attrs.get("comment", ""),
    }
    row = {key: given.get(key, "") for key in _COLUMNS} | numbers | words
    return {key: harmless(value) if isinstance(value, str) else value for key, value in row.items()}


if __name__ == "__main__":
    jobs.run(summarise_cases)
