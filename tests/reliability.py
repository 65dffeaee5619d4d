"""Figures of the tests of reliability, from which `make reliability` writes docs/reliability.md.

A test calls :func:`record` once all its assertions hold. ``python -m tests.reliability`` renders
what was recorded.
"""

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

RECORDS = Path(__file__).parents[1] / ".reliability"
Figure = int | float | str


def record(name: str, what: str, figures: dict[str, Figure]) -> None:
    """Keep what a test did.

    Parameters
    ----------
    name : str
        File name of the record: letters, digits, underscores.
    what : str
        A sentence for readers: what was done, and what was found to hold.
    figures : dict
        What was counted or measured, by its label, in the order of the table.
    """
    RECORDS.mkdir(exist_ok=True)
    text = json.dumps({"name": name, "what": what, "figures": figures}, indent=2)
    (RECORDS / f"{name}.json").write_text(text + "\n", encoding="utf-8")


def comparison(
    found: Mapping[str, str], expected: Mapping[str, str], wanted: Iterable[str] | None = None
) -> dict[str, Figure]:
    """Count how the files of a run compare with those of an undisturbed one.

    Parameters
    ----------
    found, expected : mappings
        Checksums by path.
    wanted : iterable of str, optional
        Paths that must be found; by default all that are expected.
    """
    return {
        "files compared": len(found),
        "with other bytes": sum(expected.get(path) != digest for path, digest in found.items()),
        "lost": len({*(expected if wanted is None else wanted)} - found.keys()),
    }


def render(folder: Path = RECORDS) -> str:
    """Return the records as a page of Markdown, in the order of their names.

    Raises
    ------
    FileNotFoundError
        If there is no record.
    """
    records = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*"))]
    if not records:
        raise FileNotFoundError(f"no record in {folder}: run the tests first: make reliability")
    return "\n".join([_INTRODUCTION, *map(_section, records)])


def _section(record: dict[str, Any]) -> str:
    title = record["name"].replace("_", " ").capitalize()
    rows = [f"| {label} | {value} |" for label, value in record["figures"].items()]
    return "\n".join([f"## {title}", "", record["what"], "", "| | |", "|---|---|", *rows, ""])


_INTRODUCTION = """# Reliability

What the tests of `make reliability` did to the workflow on one machine and what they found, written
by the tests themselves.
"""


if __name__ == "__main__":
    sys.stdout.write(render())
