"""Findings, the four verdicts, and how a comparison becomes one."""

from collections.abc import Callable
from dataclasses import dataclass
from decimal import ROUND_UP, Context
from typing import Literal, get_args

Verdict = Literal["holds", "holds with limits", "does not hold", "cannot be decided"]
VERDICTS: tuple[Verdict, ...] = get_args(Verdict)
HOLDS, LIMITED, FAILS, UNDECIDED = VERDICTS
_TWO_DIGITS = Context(prec=2, rounding=ROUND_UP)


class UndecidedError(Exception):
    """An artifact lacks what a claim needs; the message says what."""


@dataclass(frozen=True)
class Finding:
    """A verdict, the number it rests on with its absolute error, and what a reader should know."""

    computed: float
    error: float
    verdict: Verdict
    remark: str


@dataclass(frozen=True)
class Printed:
    """A number of the paper and half a unit of its last digit."""

    value: float
    half_unit: float

    @classmethod
    def parse(cls, text: str) -> "Printed":
        """Read a number as printed."""
        decimals = len(text.partition(".")[2])
        return cls(float(text), 0.5 * 10.0**-decimals)

    @classmethod
    def exact(cls, value: float) -> "Printed":
        """Take a number that stands for itself, such as sqrt(12)."""
        return cls(value, rounding(value))


def rounding(value: float) -> float:
    """Return what double precision leaves uncertain of a short computation's result."""
    return 1e-14 * max(1.0, abs(value))


def upper_bound(value: float, bound: float) -> str:
    """Return ``< 1e-10`` for what lies below the bound it is judged by, as rounding should.

    Its size differs from machine to machine, so that a bound of its own would.
    """
    return f"< {bound:g}" if value < bound else f"{value:.1e}"


def rounded_up(error: float) -> str:
    """Return an error with two digits that still covers."""
    return f"{float(_TWO_DIGITS.create_decimal_from_float(error)):.1e}" if error else "0"


def rounds(printed: Printed, computed: float, error: float, remark: str) -> Finding:
    """Hold if the computed value, give or take its error, rounds to the printed digits."""
    close = abs(computed - printed.value) <= printed.half_unit + error
    return Finding(computed, error, HOLDS if close else FAILS, remark)


def below(computed: float, bound: float, error: float, remark: str) -> Finding:
    """Hold if the computed value lies below the bound; undecided if its error does not tell."""
    if abs(computed - bound) < error:
        return Finding(computed, error, UNDECIDED, f"The error does not tell. {remark}")
    return Finding(computed, error, HOLDS if computed < bound else FAILS, remark)


def above(computed: float, bound: float, error: float, remark: str) -> Finding:
    """Hold if the computed value lies above the bound, as :func:`below`."""
    turned = below(-computed, -bound, error, remark)
    return Finding(computed, error, turned.verdict, turned.remark)


def counted(count: int, total: int, remark: str) -> Finding:
    """Hold if all cases do, with limits if some do.

    Raises
    ------
    UndecidedError
        If there is no case.
    """
    if not total:
        raise UndecidedError("the artifact has no case of it")
    verdict = HOLDS if count == total else LIMITED if count else FAILS
    return Finding(count, 0.0, verdict, f"{count} of {total}. {remark}")


def limited(finding: Finding, condition: bool) -> Finding:
    """Return a finding that holds as one that holds with limits, if the condition is true."""
    if finding.verdict == HOLDS and condition:
        return Finding(finding.computed, finding.error, LIMITED, finding.remark)
    return finding


Judge = Callable[..., Finding]
