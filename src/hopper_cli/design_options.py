"""Options of ``hopper design``: the margin, and what the outlet must be wide enough for."""

import argparse
from pathlib import Path

from hopper_cli import values
from hopper_cli.errors import UsageError


def add(command: argparse.ArgumentParser) -> None:
    """Add the options to the subcommand."""
    command.add_argument(
        "--margin",
        type=_margin,
        default=3.0,
        metavar="DEG",
        help="half angle to keep below the smallest limit, default %(default)g",
    )
    command.add_argument(
        "--bulk-density", type=_density, metavar="KG/M3", help="for the smallest outlet"
    )
    command.add_argument(
        "--flow-function",
        type=Path,
        metavar="FILE.csv",
        help="strength of the material: columns sigma_1 and f_c in kPa, by increasing sigma_1",
    )
    command.add_argument(
        "--flow-function-intercept",
        type=_stress,
        metavar="KPA",
        help="or f_c = intercept + slope sigma_1",
    )
    command.add_argument(
        "--flow-function-slope", type=_slope, metavar="SLOPE", help="default 0: constant strength"
    )


def check(options: argparse.Namespace) -> None:
    """Find options that do not go together, and files that do not exist.

    Raises
    ------
    UsageError
        If an option is wrong.
    """
    file, intercept = options.flow_function, options.flow_function_intercept
    if file is not None and (intercept is not None or options.flow_function_slope is not None):
        raise UsageError("argument --flow-function: give the file or intercept and slope, not both")
    if options.flow_function_slope is not None and intercept is None:
        raise UsageError("argument --flow-function-slope: give --flow-function-intercept too")
    given = file is not None or intercept is not None
    if given and options.bulk_density is None:
        raise UsageError("argument --bulk-density: the outlet needs it: give kg/m^3")
    if options.bulk_density is not None and not given:
        raise UsageError(
            "argument --bulk-density: the outlet needs a flow function too: give --flow-function "
            "or --flow-function-intercept"
        )
    if file is not None and not file.is_file():
        raise UsageError(f"argument --flow-function: there is no file {file}")


def _margin(text: str) -> float:
    return values.number(text, "degrees from 0 to below 90", lambda value: 0 <= value < 90)


def _density(text: str) -> float:
    return values.number(text, "kg/m^3 from 1 to 30000", lambda value: 1 <= value <= 30000)


def _stress(text: str) -> float:
    return values.number(text, "a strength in kPa from 0 to 10000", lambda x: 0 <= x <= 1e4)


def _slope(text: str) -> float:
    return values.number(text, "a number from 0 to 10", lambda value: 0 <= value <= 10)
