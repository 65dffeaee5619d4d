"""Doubts about options that are right as they stand: radians, an angle given as a coefficient."""

from argparse import Namespace

# Hoppers and materials have larger angles in degrees, and no larger ones in radians.
_RADIANS_END = 1.6
# Coefficients of wall friction are rarely above 1.
_LARGE_COEFFICIENT = 2.0


def doubts(options: Namespace) -> list[str]:
    """Return what may not be meant, a line each."""
    found = []
    angles = [getattr(options, name, None) for name in ("delta", "half_angle", "phi")]
    known = [angle for angle in angles if angle is not None]
    if len(known) > 1 and max(known) < _RADIANS_END:
        found.append("all angles are below 1.6 degrees: are they in radians? give degrees")
    mu = getattr(options, "mu", None)
    if mu is not None and _LARGE_COEFFICIENT <= mu < 90:
        found.append(f"--mu {mu:g} is a coefficient: was --phi {mu:g} meant?")
    return found
