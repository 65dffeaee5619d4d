"""Values of options: numbers in a range, or one line that says which."""

import argparse
from collections.abc import Callable
from math import isfinite

_FEWEST_MODES, _MOST_MODES = 1, 40


def number(text: str, meaning: str, inside: Callable[[float], bool]) -> float:
    """Return a number that is inside a range; ``meaning`` says which.

    Raises
    ------
    ArgumentTypeError
        If it is not.
    """
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number: give {meaning}") from None
    if not (isfinite(value) and inside(value)):
        raise argparse.ArgumentTypeError(f"{text} is out of range: give {meaning}")
    return value


def angle(text: str) -> float:
    """Return an angle of a hopper or a material."""
    return number(text, "degrees between 0 and 90, both excluded", lambda value: 0 < value < 90)


def wall_angle(text: str) -> float:
    """Return an angle of wall friction."""
    return number(text, "degrees from 0 to below 90", lambda value: 0 <= value < 90)


def coefficient(text: str) -> float:
    """Return a coefficient of wall friction."""
    return number(text, "a number from 0 to 1000", lambda value: 0 <= value <= 1000)


def count(text: str) -> int:
    """Return a number of modes."""
    meaning = f"a whole number from {_FEWEST_MODES} to {_MOST_MODES}"
    return int(
        number(text, meaning, lambda n: _FEWEST_MODES <= n <= _MOST_MODES and n.is_integer())
    )
