"""Options of ``hopper march``: the stress at the top, and how far down."""

import argparse
from pathlib import Path

from hopper_cli import values
from hopper_cli.errors import UsageError

# Beyond, r_top exp(-depth) is no number.
_DEEPEST = 700
# Tops with the option that each needs.
_TOPS = {
    "bump-s": "eps",
    "bump-a": "eps",
    "one-sided": "eps",
    "scaled": "factor",
    "linear": "",
    "bin": "",
}
_FILES = (".csv", ".nc")
_HELP = """\
stress at the top: bump-s, bump-a (a bump of log sigma, of psi), one-sided (of log sigma in one half
of a wedge), scaled (the radial stress times a factor), linear (psi linear in the angle), bin (major
stress horizontal, as in a bin above), or FILE.csv, FILE.nc with theta, sigma, psi"""


def add(command: argparse.ArgumentParser) -> None:
    """Add the options to the subcommand."""
    command.add_argument("--top", required=True, metavar="TOP", help=_HELP)
    command.add_argument(
        "--eps", type=_amplitude, help="amplitude of a bump: of log sigma, or of psi in radians"
    )
    command.add_argument("--factor", type=_factor, help="factor of scaled")
    command.add_argument(
        "--depth",
        type=_depth,
        required=True,
        metavar="TAU",
        help="march down to tau = log(r_top / r)",
    )
    command.add_argument(
        "--at-tau", type=_place, metavar="TAU", help="print the stress at this depth too"
    )


def check(options: argparse.Namespace) -> None:
    """Find options that do not go together, and files that do not exist.

    Raises
    ------
    UsageError
        If an option is wrong.
    """
    if options.model == "von-mises":
        raise UsageError(
            "argument --model: the stress march is formulated for mohr-coulomb only: use --model "
            "mohr-coulomb"
        )
    top = options.top
    if top not in _TOPS:
        path = Path(top)
        if path.suffix.lower() not in _FILES:
            known = ", ".join(_TOPS)
            raise UsageError(
                f"argument --top: {top!r} is unknown: use {known} or a file {' or '.join(_FILES)}"
            )
        if not path.is_file():
            raise UsageError(f"argument --top: there is no file {path}")
    needed = _TOPS.get(top, "")
    for name in ("eps", "factor"):
        given = getattr(options, name) is not None
        if given and name != needed:
            raise UsageError(f"argument --{name}: the top {top} has none: leave it out")
        if not given and name == needed:
            raise UsageError(f"argument --top: {top} needs --{name}")
    if top == "one-sided" and options.geometry == "cone":
        raise UsageError(
            "argument --top: the top of a cone must be symmetric: use bump-s or --geometry wedge"
        )
    if options.at_tau is not None and options.at_tau > options.depth:
        raise UsageError(
            f"argument --at-tau: {options.at_tau:g} is below --depth {options.depth:g}: march "
            "deeper"
        )


def _amplitude(text: str) -> float:
    return values.number(text, "a number from -100 to 100", lambda value: abs(value) <= 100)


def _factor(text: str) -> float:
    return values.number(text, "a positive number", lambda value: value > 0)


def _depth(text: str) -> float:
    meaning = f"a positive number up to {_DEEPEST}, where r = r_top exp(-depth) vanishes"
    return values.number(text, meaning, lambda value: 0 < value <= _DEEPEST)


def _place(text: str) -> float:
    return values.number(text, "a number from 0 to --depth", lambda value: value >= 0)
