"""Values of options that are known in a range, 38+-2 or 36:40, or to be gone through, 30:60:1."""

import argparse
from argparse import Namespace
from collections.abc import Callable
from math import floor, isfinite, prod
from typing import NamedTuple, TypeVar

from hopper_cli.errors import UsageError

RANGED = ("delta", "half_angle", "mu", "phi")
_LIKE = "give a number, 38+-2, 36:40, or 30:60:1"
# Rows of a table on the terminal.
_MOST_ROWS = 10_000
# Of the number of steps, what rounding may take.
_ROUNDING = 1e-9


class Given(NamedTuple):
    """A range of an option; ``spread`` where it was given as a mean and a deviation."""

    low: float
    high: float
    spread: bool

    @property
    def middle(self) -> float:
        """The mean of both ends."""
        return (self.low + self.high) / 2

    def __str__(self) -> str:
        """Return both ends."""
        return f"{self.low:.6g} to {self.high:.6g}"


class Steps(NamedTuple):
    """Values of an option from ``start`` to ``stop``, both included if the steps meet it."""

    start: float
    stop: float
    step: float

    @property
    def values(self) -> list[float]:
        """All of them."""
        count = floor((self.stop - self.start) / self.step * (1 + _ROUNDING) + _ROUNDING) + 1
        return [float(f"{self.start + i * self.step:.12g}") for i in range(count)]


Value = float | Given | Steps
_Kind = TypeVar("_Kind", Given, Steps)


def ranged(single: Callable[[str], float]) -> Callable[[str], Value]:
    """Return the type of an option that takes a range too; ``single`` is that of one number.

    The function raises ArgumentTypeError for what is neither.
    """

    def value(text: str) -> Value:
        plain = text.replace("\N{PLUS-MINUS SIGN}", "+-")
        if "+-" in plain:
            parts = [_number(part, text) for part in plain.split("+-")]
            return _spread(parts, text, single)
        if ":" in plain:
            parts = [_number(part, text) for part in plain.split(":")]
            return _steps(parts, text, single) if len(parts) == 3 else _range(parts, text, single)
        if "," in plain:
            _number(plain, text)
        return single(plain)

    return value


def _number(part: str, text: str) -> float:
    try:
        value = float(part)
    except ValueError:
        point = ", with a decimal point" if "," in part else ""
        raise argparse.ArgumentTypeError(
            f"{text!r}: {part!r} is not a number: {_LIKE}{point}"
        ) from None
    if not isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r}: {part} is not finite: {_LIKE}")
    return value


def _spread(parts: list[float], text: str, single: Callable[[str], float]) -> Value:
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} has +- twice: {_LIKE}")
    mean, deviation = parts
    if deviation < 0:
        raise argparse.ArgumentTypeError(f"{text!r}: what follows +- is negative: {_LIKE}")
    if deviation == 0:
        return single(f"{mean}")
    low, high = (_end(value, text, single) for value in (mean - deviation, mean + deviation))
    return Given(low, high, spread=True)


def _range(parts: list[float], text: str, single: Callable[[str], float]) -> Value:
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"{text!r} has too many colons: {_LIKE}")
    low, high = (_end(value, text, single) for value in parts)
    if low > high:
        raise argparse.ArgumentTypeError(
            f"{text!r} is upside down: give the smaller end first, {high:g}:{low:g}"
        )
    return Given(low, high, spread=False) if low < high else low


def _steps(parts: list[float], text: str, single: Callable[[str], float]) -> Steps:
    start, stop, step = parts
    start, stop = (_end(value, text, single) for value in (start, stop))
    if step == 0:
        raise argparse.ArgumentTypeError(f"{text!r}: the step is zero: give start:stop:step")
    if (stop - start) * step < 0:
        raise argparse.ArgumentTypeError(
            f"{text!r}: the step leads away from the stop: give {start:g}:{stop:g}:{-step:g}"
        )
    if abs((stop - start) / step) >= _MOST_ROWS:
        raise argparse.ArgumentTypeError(
            f"{text!r} has more than {_MOST_ROWS} steps: give a larger step"
        )
    return Steps(start, stop, step)


def _end(value: float, text: str, single: Callable[[str], float]) -> float:
    try:
        return single(f"{value!r}")
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(f"{text!r} crosses a limit: {error}") from None


def of_kind(options: Namespace, kind: type[_Kind]) -> dict[str, _Kind]:
    """Return the options that are ranges, or steps, by their names."""
    values = {name: getattr(options, name, None) for name in RANGED}
    return {name: value for name, value in values.items() if isinstance(value, kind)}


def check(options: Namespace) -> None:
    """Find ranges and steps that do not go together with each other or with another option.

    Raises
    ------
    UsageError
        If there are any.
    """
    given, steps = of_kind(options, Given), of_kind(options, Steps)
    if given and steps:
        first, second = option(next(iter(given))), option(next(iter(steps)))
        raise UsageError(
            f"argument {first}: a range and the steps of {second} do not go together: give one"
        )
    if options.normal:
        if not given:
            raise UsageError("argument --normal: no option has a range: give one as 38+-2")
        for name, value in given.items():
            if not value.spread:
                raise UsageError(
                    f"argument {option(name)}: --normal needs mean and standard deviation: give "
                    f"{value.middle:g}+-{value.high - value.middle:g}"
                )
    if given or steps:
        for name in ("profile", "plot"):
            if getattr(options, name, None):
                raise UsageError(
                    f"argument --{name}: there is one of one hopper only: leave out the range"
                )
    _check_rows(options, steps)


def _check_rows(options: Namespace, steps: dict[str, Steps]) -> None:
    count = prod(len(value.values) for value in steps.values())
    if count > _MOST_ROWS:
        raise UsageError(
            f"argument {option(next(iter(steps)))}: {count} rows are more than {_MOST_ROWS}: give "
            "larger steps"
        )
    if options.out is not None and not steps:
        raise UsageError("argument --out: is for a table: give steps, as 30:60:1")


def option(name: str) -> str:
    """Return the option of a name."""
    return f"--{name.replace('_', '-')}"
