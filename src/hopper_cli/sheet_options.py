"""Options of ``hopper table``: a list of hoppers, where the answers go, and how many cores."""

import argparse
import os
from pathlib import Path

from hopper_cli import values
from hopper_cli.outputs import require_writable

_SUFFIXES = (".csv", ".xlsx", ".json", ".nc")


def add(command: argparse.ArgumentParser) -> None:
    """Add the options to the subcommand."""
    command.add_argument(
        "list",
        type=Path,
        metavar="LIST.csv",
        help="a row a hopper: columns geometry, delta, half-angle, mu or phi, and if wanted model "
        "and disturbances; others are kept",
    )
    command.add_argument(
        "--out",
        type=Path,
        required=True,
        metavar="FILE",
        help="write the answers to FILE.csv, .xlsx, .json or .nc",
    )
    command.add_argument(
        "--columns",
        type=lambda text: [name.strip() for name in text.split(",") if name.strip()],
        default=[],
        metavar="NAMES",
        help="more columns, with commas: radial, limits, transients, design, or single ones of "
        "theirs as JSON calls them",
    )
    command.add_argument(
        "--cores",
        type=_cores,
        default=os.cpu_count() or 1,
        metavar="N",
        help="processes, default all cores: %(default)s",
    )
    command.add_argument("--force", action="store_true", help="overwrite an existing file")


def check(options: argparse.Namespace) -> None:
    """Find a file that cannot be written.

    Raises
    ------
    UsageError
        If there is one.
    """
    require_writable("--out", options.out, _SUFFIXES, overwrite=options.force)


def _cores(text: str) -> int:
    meaning = "a whole number from 1 to 1024"
    return int(values.number(text, meaning, lambda n: 1 <= n <= 1024 and n.is_integer()))
