"""What a result consists of, as data: names, where values come from, meanings, units.

A table is a tuple of variables. The same table gives the rows of a text or JSON answer and, by
:mod:`hopper_data.datasets`, the variables of a netCDF file.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import degrees, radians
from typing import Any, Literal

import numpy as np

from hopper.brief import brief
from hopper.quantity import Quantity

Kind = Literal["number", "angle", "complex", "flag", "text"]


@dataclass(frozen=True)
class Variable:
    """One variable of a result.

    Attributes
    ----------
    name : str
        For programs.
    label : str
        For people; with ``scale`` the long name of CF.
    over : str
        Its dimensions, separated by spaces.
    source : str
        Attributes or keys that lead to its values, separated by points. Of a sequence of objects
        the values of all of them are taken.
    kind : str
        ``angle`` is in radians in the result and in degrees in tables and files; ``flag`` takes
        codes, or names among ``meanings``.
    units : str
        As CF spells them.
    scale : str
        What a dimensionless number is a multiple of, where that is not plain.
    power : int
        Of an angle: 2 for an area.
    meanings : tuple of str
        Of a flag's codes 0, 1, ...
    """

    name: str
    label: str
    over: str = ""
    source: str = ""
    kind: Kind = "number"
    units: str = "1"
    scale: str = ""
    power: int = 1
    meanings: tuple[str, ...] = ()

    __repr__ = brief("name", "label", "over", "units")

    @property
    def long_name(self) -> str:
        """Label and scale."""
        return f"{self.label} over {self.scale}" if self.scale else self.label

    def of(self, result: Any) -> Any:
        """Return its values in a result, angles in degrees; a quantity as it is."""
        values = _lookup(result, (self.source or self.name).split("."))
        if self.kind == "angle" and values is not None:
            for _ in range(self.power):
                values = _in_degrees(values)
        return values


Table = tuple[Variable, ...]


def number(
    name: str, label: str, over: str = "", source: str = "", units: str = "1", scale: str = ""
) -> Variable:
    """Return a number or an array of them, dimensionless by default."""
    return Variable(name, label, over, source, "number", units, scale)


def angle(name: str, label: str, over: str = "", source: str = "", power: int = 1) -> Variable:
    """Return an angle, in radians in the result and in degrees in tables and files."""
    units = "degree" if power == 1 else f"degree{power}"
    return Variable(name, label, over, source, "angle", units, power=power)


def in_degrees(name: str, label: str, over: str = "", source: str = "") -> Variable:
    """Return an angle that is in degrees already, as people give them."""
    return number(name, label, over, source, "degree")


def complex_number(name: str, label: str, over: str = "", source: str = "") -> Variable:
    """Return a complex number: real and imaginary part in files, as netCDF has no complex type."""
    return Variable(name, label, over, source, "complex")


def flag(
    name: str, label: str, meanings: tuple[str, ...], over: str = "", source: str = ""
) -> Variable:
    """Return one of a few meanings, as codes or as names."""
    return Variable(name, label, over, source, "flag", meanings=meanings)


def text(name: str, label: str, over: str = "", source: str = "") -> Variable:
    """Return words."""
    return Variable(name, label, over, source, "text")


def within(part: str, table: Iterable[Variable]) -> Table:
    """Return a table for a larger result, of which ``part`` is what the given one describes."""
    return tuple(
        replace(variable, source=f"{part}.{variable.source or variable.name}") for variable in table
    )


def parts(variable: Variable, values: Any) -> list[tuple[Variable, Any]]:
    """Return a variable with its values, or the two parts of a complex one."""
    if variable.kind != "complex":
        return [(variable, values)]
    return [
        (_part(variable, "real", "real"), np.real(values)),
        (_part(variable, "imag", "imaginary"), np.imag(values)),
    ]


def _part(variable: Variable, suffix: str, word: str) -> Variable:
    return number(f"{variable.name}_{suffix}", f"{word} part of {variable.label}", variable.over)


def _lookup(result: Any, path: list[str]) -> Any:
    if not path or result is None:
        return result
    name, *rest = path
    if isinstance(result, list | tuple):
        return [_lookup(item, path) for item in result]
    return _lookup(result.get(name) if isinstance(result, Mapping) else getattr(result, name), rest)


def _in_degrees(values: Any) -> Any:
    if isinstance(values, Quantity):
        return Quantity(degrees(values.value), degrees(values.error))
    return np.degrees(values)


@dataclass(frozen=True)
class Row:
    """A variable with its value and absolute error, both None where it does not exist."""

    variable: Variable
    value: float | None
    error: float | None = None

    __repr__ = brief("variable.name", "value", "error")

    @property
    def relative_error(self) -> float:
        """Error relative to the value; of angles, in radians."""
        if self.value is None or self.error is None:
            return 0.0
        units = self.variable.units
        if units == "degree":
            return radians(self.error)
        return self.error if units == "radian" else self.error / abs(self.value)

    def in_degrees(self) -> "Row":
        """Return the row of an angle in radians in degrees, named accordingly."""
        variable = angle(f"{self.variable.name}_deg", self.variable.label)
        value, error = (
            None if number is None else degrees(number) for number in (self.value, self.error)
        )
        return Row(variable, value, error)


def rows(result: Any, table: Iterable[Variable]) -> list[Row]:
    """Return a row for each variable that is a single number."""
    return [_row(variable, variable.of(result)) for variable in table]


def _row(variable: Variable, value: Any) -> Row:
    if isinstance(value, Quantity):
        return Row(variable, value.value, value.error)
    return Row(variable, value)
