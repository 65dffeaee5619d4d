"""Roots of functions of one variable, between two places where their signs differ.

SciPy has such functions too; its package for them takes longer to import than most jobs work.

References
----------
T. R. Chandrupatla, A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear
function without using derivatives, Adv. Eng. Software 28, 145 (1997).
"""

from collections.abc import Callable
from math import isnan
from sys import float_info

from hopper.arguments import checked
from hopper.errors import ConvergenceError, InvalidParameterError

_MOST_STEPS = 200
_ROUNDING = 4 * float_info.epsilon


@checked
def root_between(
    function: Callable[[float], float], low: float, high: float, xtol: float = 2e-12
) -> float:
    """Return where a function vanishes, to ``xtol`` and rounding.

    Every step shrinks a bracket: by inverse quadratic interpolation where that is safe, else by
    halves. The ends are evaluated first.

    Raises
    ------
    InvalidParameterError
        If ``function`` has one sign at both ends, or a value is not a number.
    ConvergenceError
        If it takes more than 200 steps.

    Examples
    --------
    >>> from hopper.roots import root_between
    >>> root_between(lambda x: x**2 - 2, 0, 2)
    1.4142135623730954
    """
    x, other = low, high  # the newest place, and one where the function has the other sign
    at_x, at_other = _value(function, low), _value(function, high)
    # Signs, not their product, in which small values vanish.
    if at_x and at_other and (at_x > 0) == (at_other > 0):
        raise InvalidParameterError(f"function has one sign at {low:.6g} and {high:.6g}")
    before, at_before = x, at_x
    share = at_x / (at_x - at_other) if at_x != at_other else 0.0  # of a straight line
    for _ in range(_MOST_STEPS):
        best, at_best = (x, at_x) if abs(at_x) < abs(at_other) else (other, at_other)
        least = (xtol + _ROUNDING * abs(best)) / 2
        if at_best == 0 or abs(other - x) <= 2 * least:
            return best
        least /= abs(other - x)
        share = min(max(share, least), 1 - least) if share == share else 0.5
        new = x + share * (other - x)
        at_new = _value(function, new)
        if (at_new > 0) == (at_x > 0):
            before, at_before = x, at_x
        else:
            before, at_before, other, at_other = other, at_other, x, at_x
        x, at_x = new, at_new
        share = _share(x, at_x, other, at_other, before, at_before)
    raise ConvergenceError(f"no root between {low:.6g} and {high:.6g} after {_MOST_STEPS} steps")


def _value(function: Callable[[float], float], place: float) -> float:
    value = float(function(place))
    if isnan(value):
        raise InvalidParameterError(f"function is not a number at {place:.6g}")
    return value


def _share(a: float, at_a: float, b: float, at_b: float, c: float, at_c: float) -> float:
    """Return the part of the way from a to b to the root of the inverse quadratic, or a half."""
    if at_b == at_c or at_a == at_c:
        return 0.5
    place, value = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
    if not (value**2 < place and (1 - value) ** 2 < 1 - place):
        return 0.5
    return at_a / (at_b - at_a) * at_c / (at_b - at_c) + (
        (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
    )
