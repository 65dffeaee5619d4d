"""The supremum of Re(lambda) of hyperbolic flows: resolved modes and the upper strip.

The mode of the flow rate, lambda = 0, is a change of the base flow and not counted. Modes between
the resolved ones and the strip may stand above both, and real parts overshoot the strip in beats of
the two families. How far they do is judged by how far the last resolved modes lie from the roots of
the law of high frequency: a test, not a proof.
"""

from dataclasses import dataclass
from math import ceil, inf, nan
from typing import Literal

import numpy as np

from hopper.arguments import checked
from hopper.brief import brief
from hopper.radial.solution import RadialSolution
from hopper.von_mises.high_frequency import HighFrequency, high_frequency
from hopper.von_mises.modes import SIZES, ResolvedModes, low_modes, modes_on
from hopper.von_mises.strips import Strips, strips

Governor = Literal["mode", "strip"]
# Modes that the test looks at: no fewer than these, and two beats of the families.
_LEAST_TESTED = 8
# Part of the abscissa that unresolved modes may add.
_UNKNOWN_PART = 0.1


@dataclass(frozen=True)
class Growth:
    """What is known of the supremum of Re(lambda).

    Attributes
    ----------
    modes : ResolvedModes
    strips : Strips
    abscissa : float
        Largest Re(lambda) of the resolved modes and the upper strip's edge.
    governed_by : "mode" or "strip"
    frequency : float
        Im(lambda) of the mode that governs; NaN for the strip, which no mode need attain.
    error_estimate : float
        Absolute, of that mode or edge.
    overshoot : float
        Largest distance in Re(lambda) of the last resolved modes of the upper strip from the roots
        of the law of high frequency next to them; inf where too few are resolved.
    """

    modes: ResolvedModes
    strips: Strips
    abscissa: float
    governed_by: Governor
    frequency: float
    error_estimate: float
    overshoot: float

    __repr__ = brief("abscissa", "governed_by", "error_estimate", "bound")

    @property
    def bound(self) -> float:
        """What modes not resolved may reach, by the test of resolution; at least the abscissa."""
        return max(self.abscissa, self.strips.upper_edge + self.overshoot)

    @property
    def settled(self) -> bool:
        """Whether a finer mesh would change neither the verdict nor much of the abscissa."""
        unknown = self.bound - self.abscissa
        return unknown <= _UNKNOWN_PART * abs(self.abscissa) and not self.abscissa < 0 <= self.bound


@checked
def growth(solution: RadialSolution, tolerance: float = 1e-9, first: int | None = None) -> Growth:
    """Return the supremum over the low modes and the upper strip, without resolving it further.

    Parameters
    ----------
    solution : RadialSolution
        Of a von Mises cone with hyperbolic equations.
    tolerance, first
        As :func:`hopper.von_mises.modes.low_modes`.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises.
    SingularVelocityError
        If psi reaches pi/4.
    ConvergenceError
        If too few modes or the strips are not resolved.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial, yield_condition
    >>> from hopper.von_mises.growth import growth
    >>> hopper = Hopper("cone", 0.7, 0.2, yield_condition("von-mises"))
    >>> round(growth(solve_radial(hopper, friction_angle=0.1)).abscissa, 4)
    -0.0207
    """
    modes = low_modes(solution, tolerance, first)
    return growth_of(modes, high_frequency(solution))


@checked
def resolved_growth(
    solution: RadialSolution, tolerance: float = 1e-9, first: int | None = None
) -> Growth:
    """Return the supremum on the first mesh on which the test of resolution settles it.

    On the finest mesh, if on none: see ``settled``. Raises as :func:`growth`.
    """
    modes, law = low_modes(solution, tolerance, first), high_frequency(solution)
    found = growth_of(modes, law)
    for size in SIZES[SIZES.index(modes.size) + 1 :]:
        if found.settled:
            break
        found = growth_of(modes_on(solution, size), law)
    return found


@checked
def growth_of(modes: ResolvedModes, law: HighFrequency) -> Growth:
    """Return the supremum from resolved modes and the law of high frequency of one flow."""
    lie = strips(law)
    highest = int(np.argmax(modes.eigenvalues.real))
    value = complex(modes.eigenvalues[highest])
    overshoot = _overshoot(modes, lie, law)
    if value.real > lie.upper_edge:
        error = float(modes.errors[highest])
        return Growth(modes, lie, value.real, "mode", value.imag, error, overshoot)
    return Growth(modes, lie, lie.upper_edge, "strip", nan, lie.error_estimate, overshoot)


def _overshoot(modes: ResolvedModes, lie: Strips, law: HighFrequency) -> float:
    upper = modes.eigenvalues[modes.eigenvalues.imag > 0]
    if len(lie.intervals) > 1:
        # Those nearer to the upper strip than to the next one.
        upper = upper[upper.real > lie.intervals[-2:].mean()]
    tested = max(_LEAST_TESTED, 2 * ceil(lie.spacing.max() / lie.spacing.min()))
    if upper.size < tested:
        return inf
    last = upper[-tested:]
    distance = np.abs((last - law.nearest_roots(last)).real)
    return float(np.where(np.isfinite(distance), distance, inf).max())
