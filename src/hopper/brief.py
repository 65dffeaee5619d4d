"""Results in one short line, and numbers in messages, as a person wants them."""

from collections.abc import Callable
from math import degrees
from typing import Any

import numpy as np


def brief(*shown: str) -> Callable[[Any], str]:
    """Return a ``__repr__`` that shows the given attributes.

    Each is a name, or several joined by points; after ``deg`` an angle in radians is shown in
    degrees. Of an array the range and the size are shown.
    """

    def __repr__(self: Any) -> str:  # noqa: N807
        return f"{type(self).__name__}({', '.join(_shown(self, name) for name in shown)})"

    return __repr__


def apart(*values: float) -> list[str]:
    """Return numbers that differ with as many digits as show it, at least six."""
    for digits in range(6, 18):
        found = [f"{value:.{digits}g}" for value in values]
        if len(set(found)) == len(set(values)):
            break
    return found


def _shown(result: Any, name: str) -> str:
    path, *unit = name.split()
    value = result
    for part in path.split("."):
        value = getattr(value, part, None)
    if isinstance(value, str):
        return value
    label = path.removesuffix("_estimate").removeprefix("hopper.")
    return f"{label}={_number(value, *unit)}"


def _number(value: Any, unit: str = "") -> str:
    if isinstance(value, np.ndarray):
        if value.dtype == bool:
            return f"{value.sum()} of {value.size}"
        if not value.size or np.iscomplexobj(value) or np.isnan(value).all():
            return f"{value.size} values"
        ends = _number(float(np.nanmin(value)), unit), _number(float(np.nanmax(value)), unit)
        return f"{ends[0]}..{ends[1]} ({value.size})"
    if isinstance(value, float | np.floating):
        return f"{degrees(value):.6g} deg" if unit else f"{value:.6g}"
    if unit and value is not None:  # a quantity: its value and its error
        return f"{degrees(value.value):.10g} +- {degrees(value.error):.0e} deg"
    return repr(value)
