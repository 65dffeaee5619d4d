"""Doubts about options that are right as they stand: radians, an angle given as a coefficient."""

from argparse import Namespace

from hopper_cli import ranges

# Hoppers and materials have larger angles in degrees, and no larger ones in radians.
_RADIANS_END = 1.6
# Coefficients of wall friction are rarely above 1.
_LARGE_COEFFICIENT = 2.0


def doubts(options: Namespace) -> list[str]:
    """Return what may not be meant, a line each."""
    found = []
    known = [angle for name in ("delta", "half_angle", "phi") for angle in _all(options, name)]
    if len(known) > 1 and max(known) < _RADIANS_END:
        found.append("all angles are below 1.6 degrees: are they in radians? give degrees")
    found += [
        f"--mu {mu:g} is a coefficient: was --phi {mu:g} meant?"
        for mu in _all(options, "mu")[-1:]
        if _LARGE_COEFFICIENT <= mu < 90
    ]
    return found


def _all(options: Namespace, name: str) -> list[float]:
    """Return the numbers of an option: none, one, or those of a range or of steps."""
    value = getattr(options, name, None)
    if isinstance(value, ranges.Given):
        return [value.low, value.high]
    if isinstance(value, ranges.Steps):
        return value.values
    return [] if value is None else [value]
