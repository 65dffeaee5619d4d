"""Decay of end effects in elliptic flows, as in Saint-Venant's principle.

Modes lie on both sides of Re(lambda) = 0: marching in t is ill-posed, each end of the hopper
carries half of the conditions, and what an end does dies out away from it. With modes r**(-lambda),
those with Re(lambda) < 0 decay down the hopper, the others up. The flow rate, lambda = 0, is
conserved and set by one end.
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.radial.solution import RadialSolution
from hopper.von_mises.high_frequency import HighFrequency, high_frequency
from hopper.von_mises.modes import SIZES, ResolvedModes, low_modes, modes_on
from hopper.von_mises.strips import Rays, rays

_TESTED = 3


@dataclass(frozen=True)
class EndEffects:
    """Exponents of r at which end effects die out, at least.

    Attributes
    ----------
    modes : ResolvedModes
    rays : Rays
        Where the modes of high frequency lie.
    decay_down, decay_up : float
        Least -Re(lambda) over Re(lambda) < 0, and least Re(lambda) over Re(lambda) > 0.
    error_estimate : float
        Of both, absolute.
    """

    modes: ResolvedModes
    rays: Rays
    decay_down: float
    decay_up: float
    error_estimate: float

    __repr__ = brief("decay_down", "decay_up", "error_estimate")

    @property
    def gap(self) -> float:
        """The smaller of both."""
        return min(self.decay_down, self.decay_up)


@checked
def end_effects(
    solution: RadialSolution, tolerance: float = 1e-9, first: int | None = None
) -> EndEffects:
    """Return the decay exponents of an elliptic flow.

    Modes beyond the resolved ones decay faster: that is so where the next points of both rays do,
    by more than the last resolved modes miss theirs by.

    Parameters
    ----------
    solution : RadialSolution
        Of a von Mises cone with elliptic equations.
    tolerance, first
        As :func:`hopper.von_mises.modes.low_modes`.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises.
    ConvergenceError
        If the modes that decay least are not resolved.
    """
    modes, law = low_modes(solution, tolerance, first), high_frequency(solution)
    run = rays(law)
    for size in (modes.size, *SIZES[SIZES.index(modes.size) + 1 :]):
        if size != modes.size:
            modes = modes_on(solution, size)
        real = modes.eigenvalues.real
        sides = -real[real < 0], real[real > 0]
        least = [float(side.min(initial=inf)) for side in sides]
        beyond = _beyond(modes, run, law)
        if least[0] < beyond[1] and least[1] < beyond[0]:
            error = max(float(modes.errors[np.abs(real) == rate].max()) for rate in least)
            return EndEffects(modes, run, least[0], least[1], error)
    raise ConvergenceError(
        "decay of end effects not resolved: the modes that decay least are too high; change delta "
        "or lower the wall friction"
    )


def _beyond(modes: ResolvedModes, run: Rays, law: HighFrequency) -> Array:
    """Return the least abs(Re(lambda)) beyond the resolved modes on both rays, shape (2,)."""
    least = np.zeros(2)
    for i, (start, step) in enumerate(zip(run.start, run.step, strict=True)):
        mine: Complex = modes.eigenvalues[
            (modes.eigenvalues.imag > 0) & (modes.eigenvalues.real * step.real > 0)
        ]
        if mine.size < _TESTED:
            continue
        missed = np.abs((mine - law.nearest_roots(mine)).real[-_TESTED:]).max()
        following = start + step * np.ceil((mine[-1].imag - start.imag) / step.imag + 0.5)
        if np.isfinite(missed):
            least[i] = following.real * np.sign(step.real) - missed
    return least
