"""Where flow becomes neutral along a parameter: ends of stable intervals, as roots with errors."""

from collections.abc import Callable

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Mask
from hopper.assessment.stability import abscissa_with_error
from hopper.quantity import Quantity
from hopper.radial.solution import RadialSolution
from hopper.roots import root_between
from hopper.stability.modes import Disturbances, linear_stability
from hopper.values import require_row

# Step for slopes of the abscissa, in the parameter.
_STEP = 1e-6


@checked
def neutral_between(
    solution: Callable[[float], RadialSolution],
    low: float,
    high: float,
    xtol: float,
    disturbances: Disturbances | None = None,
) -> Quantity:
    """Return where the spectral abscissa vanishes between two values of a parameter, to ``xtol``.

    ``solution`` takes the parameter; ``disturbances`` as in
    :func:`hopper.stability.modes.linear_stability`.

    Raises
    ------
    InvalidParameterError
        If both are stable or both unstable.
    HopperError
        As ``solution``, and where the stability is not resolved.
    """

    def abscissa(place: float) -> float:
        return linear_stability(solution(place), disturbances).abscissa

    found = root_between(abscissa, low, high, xtol)
    _, here = abscissa_with_error(solution(found), disturbances)
    slope = abs(abscissa(found - _STEP) - here.value) / _STEP
    return Quantity(found, (abs(here.value) + here.error) / slope + xtol)


@checked
def last_run(stable: Mask) -> tuple[int, int] | None:
    """Return the first and last index of the last run of stable samples, None without one.

    Raises
    ------
    InvalidParameterError
        If ``stable`` is not a row.
    """
    places = np.flatnonzero(require_row("stable", stable))
    if not places.size:
        return None
    first = last = int(places[-1])
    while first and stable[first - 1]:
        first -= 1
    return first, last
