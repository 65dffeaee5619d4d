"""The claims ledger: every claim of the paper with its verdict, from artifacts."""

import csv
import logging
from collections import Counter
from collections.abc import Sequence

from hopper_workflow import artifacts, jobs, reading
from hopper_workflow.claims.ledger import COLUMNS, rows
from hopper_workflow.claims.words import paths_of, read_claims


def judge_claims(claims: str, schema: str, paths: Sequence[str], table: str) -> None:
    """Judge the claims and write a row for each, as CSV.

    ``paths`` are those of :func:`hopper_workflow.claims.words.paths_of`, in that order.
    """
    words = read_claims(claims, schema)
    data = {name: reading.read(path) for name, path in zip(paths_of(words), paths, strict=True)}
    ledger = rows(words, data)
    for verdict, count in Counter(row["verdict"] for row in ledger).most_common():
        logging.info("%s: %d", verdict, count)
    with artifacts.replacing(table) as path, path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(ledger)


if __name__ == "__main__":
    jobs.run(judge_claims)
