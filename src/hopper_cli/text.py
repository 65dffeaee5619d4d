"""Answers for people: aligned tables, numbers with as many digits as their errors allow."""

from collections.abc import Sequence
from math import degrees, floor, log10
from typing import TYPE_CHECKING

from hopper.quantity import Quantity
from hopper_data.tables import Row, Variable

if TYPE_CHECKING:  # the page of a case needs no numerics
    from hopper.assessment.neutral import NeutralAssessment
    from hopper.domain.neutral_points import IntervalEnd
    from hopper.stability.collocation import Parity
    from hopper.stability.modes import Governor
    from hopper.von_mises.growth import Governor as CoupledGovernor

_DIGITS = 10
_UNITS = {"degree": "deg", "1": ""}


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
    shown = [row.in_degrees() if row.variable.units == "radian" else row for row in rows]
    return [
        (row.variable.label, f"{with_error(row.value, row.error)} {unit(row.variable)}".rstrip())
        for row in shown
        if row.value is not None
    ]


def unit(variable: Variable) -> str:
    """Return the unit of a number for people."""
    return variable.scale or _UNITS.get(variable.units, variable.units)


def table(cells: Sequence[tuple[str, str]]) -> str:
    """Return two aligned columns."""
    width = max(len(label) for label, _ in cells)
    return "\n".join(f"  {label:<{width}}  {number}" for label, number in cells)


def neutral_cells(found: "NeutralAssessment") -> list[tuple[str, str]]:
    """Return a line for each neutral delta and each stable interval, in degrees."""
    points = [
        (
            "neutral delta",
            f"{_angle(point.delta)} deg, {described(point.governed_by, point.parity)}",
        )
        for point in found.points
    ]
    intervals = [
        (
            "stable delta",
            f"{_angle(one.lower)} ({ENDS[one.lower_end]}) to "
            f"{_angle(one.upper)} deg ({ENDS[one.upper_end]})",
        )
        for one in found.intervals
    ]
    return points + intervals or [("stable delta", "none")]


def described(governor: "Governor | CoupledGovernor", parity: "Parity | None") -> str:
    """Return what governs in words."""
    if governor == "strip":
        return "the upper strip of high frequency"
    return "the asymptotic line" if parity is None else f"{_ARTICLE[parity]} {governor}"


_ARTICLE: "dict[Parity, str]" = {"symmetric": "a symmetric", "asymmetric": "an asymmetric"}
ENDS: "dict[IntervalEnd, str]" = {
    "neutral": "neutral",
    "fold": "limit of friction: a fold",
    "wall": "the wall is as rough as the material",
    "interior": "limit of friction: psi is singular inside",
    "axis": "limit of friction: no stress on the axis",
    "stress_not_positive": "no positive stress beyond",
    "not_converged": "not resolved beyond",
    "steepest_looked_at": "not looked at beyond",
    "tension": "tensile on the axis beyond",
}


def _angle(angle: Quantity) -> str:
    return with_error(degrees(angle.value), degrees(angle.error))
