"""Options of ``hopper chart``: geometry, internal friction, and the file."""

import argparse
from pathlib import Path

from hopper_cli import values
from hopper_cli.outputs import require_writable

_SUFFIXES = (".png", ".pdf", ".svg")
_LEAST, _MOST = 20.0, 75.0


def add(command: argparse.ArgumentParser) -> None:
    """Add the options to the subcommand."""
    command.add_argument("--geometry", choices=["wedge", "cone"], required=True)
    command.add_argument(
        "--delta", type=_delta, required=True, metavar="DEG", help="angle of internal friction"
    )
    command.add_argument(
        "--out", type=Path, required=True, metavar="FILE", help="draw FILE.png, .pdf or .svg"
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


def _delta(text: str) -> float:
    meaning = f"degrees from {_LEAST:g} to {_MOST:g}"
    return values.number(text, meaning, lambda delta: _LEAST <= delta <= _MOST)
