"""The shell command ``hopper``: options, exit codes, and one-line errors.

Numerics, netCDF and plots are imported once the options are known to be right and ask for them.
"""

import argparse
import json
import os
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import NoReturn

from hopper.errors import HopperError, InvalidParameterError
from hopper_cli import (
    about,
    chart_options,
    checks,
    design_options,
    hints,
    march_options,
    ranges,
    sheet_options,
    values,
)
from hopper_cli.errors import UsageError

_NO_ANSWER, _USAGE, _INTERRUPTED, _BROKEN_PIPE = 1, 2, 130, 141

EXAMPLES = {
    "radial": "hopper radial --geometry cone --delta 40 --half-angle 20 --mu 0.3",
    "stability": "hopper stability --geometry cone --delta 40 --half-angle 20 --mu 0.3",
    "neutral": "hopper neutral --geometry cone --half-angle 10 --phi 10",
    "table": "hopper table hoppers.csv --out results.csv",
    "chart": "hopper chart --geometry cone --delta 42 --out chart.png",
    "design": "hopper design --geometry cone --delta 40 --phi 16",
    "march": "hopper march --geometry wedge --delta 45 --half-angle 15 --mu 0.2 --top bump-s "
    "--eps 0.2 --depth 1",
}
# What answers a command, where that is no part of `commands`.
_MODULES = {"design": "designs", "table": "sheets", "chart": "charts"}
_EXIT_CODES = """\
exit codes:
  0 answered, 1 there is no answer (the reason is on stderr), 2 wrong options or files"""


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message}; see {self.prog} --help")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with the given arguments, default those of the shell; return its exit code.

    The answer goes to stdout, errors to stderr as one line each.
    """
    # Matrices are small: more threads would wait for each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    given = sys.argv[1:] if arguments is None else arguments
    try:
        return _run(given)
    except KeyboardInterrupt:
        return _INTERRUPTED
    except OSError as error:
        # Of stdout, which Python flushes once more when it ends: let that succeed.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):
            return _BROKEN_PIPE
        return _fail(f"standard output: {error.strerror}", _NO_ANSWER)


def _run(arguments: Sequence[str]) -> int:
    """Print the answer, or why there is none; with ``--json`` both are JSON on stdout."""
    doubts: list[str] = []
    try:
        options = build_parser().parse_args(arguments)
        options.doubts = doubts = hints.doubts(options)
        checks.check(options)
        # Only now: the numerics take most of the time.
        answer = _answer(options)
    except SystemExit as finished:  # --help and --version
        return int(finished.code or 0)
    except HopperError as error:
        usage = isinstance(error, InvalidParameterError | UsageError)
        message = "; ".join([str(error), *doubts])
        if "--json" in arguments:
            document = {"error": {"kind": type(error).__name__, "message": message}}
            print(json.dumps(document, indent=2), flush=True)
        return _fail(message, _USAGE if usage else _NO_ANSWER)
    for doubt in doubts:
        print(f"hopper: warning: {doubt}", file=sys.stderr)
    print(answer, flush=True)
    return 0


def _answer(options: argparse.Namespace) -> str:
    answer: str = import_module(f"hopper_cli.{_module(options)}").answer(options)
    if getattr(options, "explain", False):
        from hopper_cli import documents

        answer = documents.explained(answer)
    return answer


def _module(options: argparse.Namespace) -> str:
    """Return the module that answers: each imports what it needs, and that takes its time."""
    if ranges.of_kind(options, ranges.Given):
        return "range_answers"
    if ranges.of_kind(options, ranges.Steps):
        return "sweeps"
    return _MODULES.get(options.command, "commands")


def _fail(message: str, code: int) -> int:
    print(f"hopper: error: {message}", file=sys.stderr)
    return code


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of the command, its parts and their options."""
    parser = _Parser(
        prog="hopper",
        description="Radial stress and velocity fields of a hopper, and their linear stability. "
        "Angles are in degrees; stresses are in units of rho g r.",
        epilog=_EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    about.add(parser)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    radial = _command(
        commands, "radial", "the radial solution: stresses, psi, velocity, flow factor, limits"
    )
    stability = _command(
        commands, "stability", "linear stability: low eigenvalues, high frequencies, verdict"
    )
    march = _command(
        commands, "march", "the stress marched down a hopper from its top, up to a breakdown"
    )
    for command, profile in (
        (radial, "fields over the polar angle"),
        (stability, "eigenvalues"),
        (march, "fields over depth and polar angle"),
    ):
        _add_hopper(command, ranged=command is not march)
        _add_files(command, profile)
    march_options.add(march)
    neutral = _command(
        commands, "neutral", "the internal frictions at which stability changes, and what is stable"
    )
    _add_geometry_and_model(neutral)
    _add_half_angle_and_wall(neutral)
    _add_modes(stability, neutral, _add_design(commands))
    _add_files_of_answers(commands)
    return parser


def _add_files_of_answers(commands: "argparse._SubParsersAction[_Parser]") -> None:
    sheet_options.add(_command(commands, "table", "the short answer about each hopper of a list"))
    chart_options.add(
        _command(commands, "chart", "the design chart of a material: limits of walls, flow factors")
    )


def _add_design(commands: "argparse._SubParsersAction[_Parser]") -> argparse.ArgumentParser:
    design = _command(
        commands, "design", "how wide a hopper may be for mass flow, and its smallest outlet"
    )
    _add_material(design, ranged=True)
    _add_wall(design, ranged=True)
    _add_ranges(design)
    design.add_argument("--force", action="store_true", help="overwrite an existing file")
    design_options.add(design)
    return design


def _add_modes(stability: argparse.ArgumentParser, *others: argparse.ArgumentParser) -> None:
    stability.add_argument(
        "--modes",
        type=values.count,
        default=6,
        metavar="N",
        help="low modes of each parity wanted, default %(default)s",
    )
    for command in (stability, *others):
        command.add_argument(
            "--disturbances",
            choices=["symmetric", "any"],
            help="default: any for wedges; of cones only symmetric ones are known, which are "
            "axisymmetric and without swirl",
        )


def _add_hopper(command: argparse.ArgumentParser, *, ranged: bool) -> None:
    _add_material(command, ranged=ranged)
    _add_half_angle_and_wall(command, ranged=ranged)
    if ranged:
        _add_ranges(command)


def _add_ranges(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--normal",
        action="store_true",
        help="probabilities too: x+-s is mean and standard deviation of independent normal values",
    )
    command.add_argument(
        "--out",
        type=Path,
        metavar="FILE",
        help="write the table of steps, --delta 30:60:1, to FILE.csv, .json or .nc",
    )


def _add_material(command: argparse.ArgumentParser, *, ranged: bool) -> None:
    _add_geometry_and_model(command)
    command.add_argument(
        "--delta",
        type=_of(values.angle, ranged),
        required=True,
        metavar="DEG",
        help="angle of internal friction; 38+-2 or 36:40 if it is known in a range"
        if ranged
        else "angle of internal friction",
    )


def _add_files(command: argparse.ArgumentParser, profile: str) -> None:
    command.add_argument(
        "--profile", type=Path, metavar="FILE", help=f"write {profile} to FILE.csv or FILE.nc"
    )
    command.add_argument(
        "--plot", type=Path, metavar="FILE", help="draw them in FILE.png, .pdf or .svg"
    )
    command.add_argument("--force", action="store_true", help="overwrite existing files")


def _command(
    commands: "argparse._SubParsersAction[_Parser]", name: str, summary: str
) -> argparse.ArgumentParser:
    command = commands.add_parser(
        name,
        help=summary,
        description=f"Compute {summary}.",
        epilog=f"example:\n  {EXAMPLES[name]}\n\n{_EXIT_CODES}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    # The answers of these are files.
    if name in ("table", "chart"):
        return command
    command.add_argument(
        "--json",
        action="store_true",
        help="print JSON, errors too; psi_wall and psi_max are in radians, ..._deg in degrees",
    )
    command.add_argument("--explain", action="store_true", help="say what the terms mean")
    return command


def _add_geometry_and_model(command: argparse.ArgumentParser) -> None:
    command.add_argument("--geometry", choices=["wedge", "cone"], required=True)
    command.add_argument(
        "--model",
        choices=["mohr-coulomb", "von-mises"],
        default="mohr-coulomb",
        help="yield condition, default %(default)s; von-mises: cones only",
    )


def _of(single: Callable[[str], float], ranged: bool) -> Callable[[str], ranges.Value]:
    return ranges.ranged(single) if ranged else single


def _add_half_angle_and_wall(command: argparse.ArgumentParser, *, ranged: bool = False) -> None:
    command.add_argument(
        "--half-angle",
        type=_of(values.angle, ranged),
        required=True,
        metavar="DEG",
        help="half opening angle, from the vertical",
    )
    _add_wall(command, ranged=ranged)


def _add_wall(command: argparse.ArgumentParser, *, ranged: bool) -> None:
    wall = command.add_mutually_exclusive_group(required=True)
    wall.add_argument(
        "--mu", type=_of(values.coefficient, ranged), help="coefficient of friction, tan(phi)"
    )
    wall.add_argument(
        "--phi", type=_of(values.wall_angle, ranged), metavar="DEG", help="angle of wall friction"
    )


if __name__ == "__main__":
    sys.exit(main())
