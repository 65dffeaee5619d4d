"""Figures of the tests of reliability, from which `make reliability` writes docs/reliability.md.

A test calls :func:`record` once all its assertions hold.
"""

import json
from pathlib import Path

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
