"""Answers for people: aligned tables, numbers with as many digits as their errors allow."""

from collections.abc import Sequence
from math import floor, log10

from hopper_data.tables import Row, Variable

_DIGITS = 10
_UNITS = {"degree": "deg", "radian": "rad", "1": ""}


def rounded(value: float, error: float | None) -> str:
    """Return a number rounded where its error begins, at most to ten digits."""
    if isinstance(value, int):
        return str(value)
    if value == 0:
        return "0"
    digits = _DIGITS
    if error:
        digits = min(_DIGITS, max(1, 1 + floor(log10(abs(value))) - floor(log10(error))))
    trailing_zeros = "#" if digits > 1 else ""
    return f"{value:{trailing_zeros}.{digits}g}".removesuffix(".")


def with_error(value: float, error: float | None) -> str:
    """Return ``value +- error``."""
    number = rounded(value, error)
    return number if error is None else f"{number} +- {error:.0e}"


def complex_with_error(value: complex, error: float) -> str:
    """Return ``real + imaginary i +- error``, of an eigenvalue with Im >= 0."""
    real = rounded(value.real, error)
    if value.imag == 0:
        return f"{real} +- {error:.0e}"
    return f"{real} + {rounded(value.imag, error)}i +- {error:.0e}"


def number_cells(rows: Sequence[Row]) -> list[tuple[str, str]]:
    """Return label, and value with error and unit, of every number that exists."""
    return [
        (row.variable.label, f"{with_error(row.value, row.error)} {_unit(row.variable)}".rstrip())
        for row in rows
        if row.value is not None
    ]


def _unit(variable: Variable) -> str:
    return variable.scale or _UNITS[variable.units]


def table(cells: Sequence[tuple[str, str]]) -> str:
    """Return two aligned columns."""
    width = max(len(label) for label, _ in cells)
    return "\n".join(f"  {label:<{width}}  {number}" for label, number in cells)
