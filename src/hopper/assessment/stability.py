"""Linear stability of a radial solution in numbers: modes, abscissa, transient growth."""

from collections.abc import Callable
from dataclasses import dataclass
from math import exp, pi

import numpy as np
import scipy

from hopper.arguments import checked
from hopper.arrays import Complex
from hopper.assessment.propagation import ROUNDING, propagated
from hopper.brief import brief
from hopper.quantity import Quantity
from hopper.radial.solution import RadialSolution
from hopper.spectral.transient import ModalBasis, condition_number, propagator_norm
from hopper.stability.collocation import Parity
from hopper.stability.low_modes import LEAST_MODES, Modes, partner_changes, upper_eigenvalues
from hopper.stability.modes import (
    Disturbances,
    LinearStability,
    Verdict,
    linear_stability,
    verdict_of,
)
from hopper.stability.transient import tilted_basis

# Half-grid points on which eigenvalues are followed under a shift of the fields.
_SENSITIVITY_SIZE = 36
# Half-grid points of the two meshes for transient growth, and the largest change of a kept mode.
_SIZE, _COARSE_SIZE, _CHANGE = 48, 32, 1e-6
# Round trips of a wave between axis and wall over which growth is followed; samples of each, four
# for each swing of the norm by the highest modes; accuracy of the time of the largest, in trips.
_TRIPS, _SAMPLES, _TIME = 4, 128, 1e-8


@dataclass(frozen=True)
class Transient:
    """Growth of symmetric perturbations in the span of the resolved modes, in tilted time.

    The norm is L2 of (sigma1, psi1) on t' = const; in cones with the weight sin(theta). Growth is
    followed for the first four round trips of a wave between axis and wall. More modes resolve
    narrower perturbations, which can grow more; so the number of modes is part of the answer.

    Attributes
    ----------
    modes : int
    condition : Quantity
        kappa(V), the bound of (4.11) on ``amplification``.
    amplification : Quantity
        Largest ||exp(-t M)|| / exp(-t alpha), alpha the spectral abscissa.
    growth : Quantity or None
        Largest ||exp(-t M)||; None unless symmetric perturbations decay.
    """

    modes: int
    condition: Quantity
    amplification: Quantity
    growth: Quantity | None

    __repr__ = brief("modes", "condition", "amplification")


@dataclass(frozen=True)
class StabilityAssessment:
    """Linear stability of a radial solution in numbers.

    Attributes
    ----------
    result : LinearStability
        Low modes, line, and what governs.
    modes : dict
        Low modes of each parity of disturbances, with what the fields leave uncertain of them.
    abscissa, symmetric : Quantity
        Supremum of Re(lambda) over all disturbances looked at, and over symmetric ones.
    asymmetric : Quantity or None
        The same over asymmetric ones, where they were looked at.
    spectrum : Modes
        Symmetric modes resolved to 1e-6.
    transient : Transient or None
        None where no mode is resolved as well.
    """

    result: LinearStability
    modes: dict[Parity, Modes]
    abscissa: Quantity
    symmetric: Quantity
    asymmetric: Quantity | None
    spectrum: Modes
    transient: Transient | None

    __repr__ = brief("verdict", "abscissa", "result.governed_by", "result.parity")

    @property
    def line(self) -> Quantity:
        """Abscissa of the asymptotic line."""
        return Quantity(self.result.line.abscissa, self.result.line.error_estimate)

    @property
    def verdict(self) -> Verdict:
        """Neutral where the error of the abscissa exceeds its size."""
        of_any, of_symmetric = self.abscissa, self.symmetric
        return verdict_of((of_any.value, of_any.error), (of_symmetric.value, of_symmetric.error))


@checked
def assess_stability(
    solution: RadialSolution, disturbances: Disturbances | None = None, count: int = 6
) -> StabilityAssessment:
    """Return the linear stability of a radial solution in numbers.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    disturbances : "symmetric" or "any", optional
        Default: any for wedges, symmetric for cones.
    count : int
        Low modes of each parity wanted.

    Raises
    ------
    HopperError
        As :func:`hopper.stability.modes.linear_stability`.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper.assessment.stability import assess_stability
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> found = assess_stability(solution)
    >>> found.verdict, round(found.abscissa.value, 4), round(found.transient.growth.value, 3)
    ('stable', -4.4827, 4.635)
    """
    result, modes, suprema = _with_errors(solution, disturbances, count)
    spectrum = _resolved_modes(solution, modes["symmetric"])
    return StabilityAssessment(
        result,
        modes,
        abscissa=_largest(suprema),
        symmetric=suprema["symmetric"],
        asymmetric=suprema.get("asymmetric"),
        spectrum=spectrum,
        transient=_transient(solution, spectrum.eigenvalues, result),
    )


@checked
def abscissa_with_error(
    solution: RadialSolution, disturbances: Disturbances | None = None
) -> tuple[LinearStability, Quantity]:
    """Return what decides the stability of a solution, and its abscissa with error."""
    result, _, suprema = _with_errors(solution, disturbances)
    return result, _largest(suprema)


def _with_errors(
    solution: RadialSolution, disturbances: Disturbances | None, count: int = LEAST_MODES
) -> tuple[LinearStability, dict[Parity, Modes], dict[Parity, Quantity]]:
    """Return the stability, its modes with what the fields leave in them, and each supremum."""
    result = linear_stability(solution, disturbances, count)
    modes = {
        parity: _with_fields(solution, parity, found) for parity, found in result.modes.items()
    }
    # The line's own estimate covers the fields.
    suprema = {name: Quantity(*found.supremum(result.line)) for name, found in modes.items()}
    return result, modes, suprema


def _largest(suprema: dict[Parity, Quantity]) -> Quantity:
    return max(suprema.values(), key=lambda supremum: supremum.value)


def _with_fields(solution: RadialSolution, parity: Parity, found: Modes) -> Modes:
    """Return modes with the errors that the fields leave in them added."""
    modes = found.eigenvalues

    def followed(shifted: RadialSolution) -> Complex:
        near = upper_eigenvalues(shifted, _SENSITIVITY_SIZE, parity)
        return near[np.abs(modes[:, None] - near).argmin(axis=1)]

    before = followed(solution)
    share = propagated(solution, lambda shifted: np.abs(followed(shifted) - before))
    return Modes(modes, found.errors + share)


def _resolved_modes(solution: RadialSolution, low: Modes) -> Modes:
    """Return the symmetric modes on which two meshes agree, and by how much (absolute)."""
    fine, coarse = (upper_eigenvalues(solution, size) for size in (_SIZE, _COARSE_SIZE))
    change = partner_changes(fine, coarse)
    resolved = int(np.argmax(change >= _CHANGE)) if (change >= _CHANGE).any() else fine.size
    kept = fine[:resolved]
    size = np.maximum(np.abs(kept), 1)
    # What rounding and the fields leave is alike for all modes, relative to their modulus.
    fields = np.max(low.errors / np.maximum(np.abs(low.eigenvalues), 1))
    return Modes(kept, (change[:resolved] + fields) * size)


def _transient(
    solution: RadialSolution, upper: Complex, result: LinearStability
) -> Transient | None:
    if not upper.size:
        return None
    kept = np.concatenate([upper, upper[upper.imag > 0].conj()])
    fine, coarse = (
        tilted_basis(solution, size, "symmetric", kept) for size in (_SIZE, _COARSE_SIZE)
    )
    abscissa, _ = result.symmetric
    period = 2 * pi / result.line.spacing

    def on_both(number: Callable[[ModalBasis], float]) -> Quantity:
        value, rounding = number(fine), ROUNDING * condition_number([fine])
        return Quantity(value, abs(value - number(coarse)) + rounding * value)

    def largest(rate: float) -> Quantity:
        elapsed = _time_of_largest(fine, rate, period)
        return on_both(lambda basis: _scaled_norm(basis, elapsed, rate))

    return Transient(
        modes=kept.size,
        condition=on_both(lambda basis: condition_number([basis])),
        amplification=largest(abscissa),
        growth=largest(0.0) if abscissa < 0 else None,
    )


def _scaled_norm(basis: ModalBasis, elapsed: float, rate: float) -> float:
    """Return ||exp(-t M)|| exp(-rate elapsed)."""
    return float(propagator_norm([basis], elapsed)) * exp(-rate * elapsed)


def _time_of_largest(basis: ModalBasis, rate: float, period: float) -> float:
    times = np.linspace(0, _TRIPS * period, _TRIPS * _SAMPLES + 1)
    peak = times[np.argmax(propagator_norm([basis], times) * np.exp(-rate * times))]
    around = max(0.0, peak - times[1]), min(peak + times[1], times[-1])
    found = scipy.optimize.minimize_scalar(
        lambda elapsed: -_scaled_norm(basis, elapsed, rate),
        bounds=around,
        method="bounded",
        options={"xatol": _TIME * period},
    )
    return float(found.x)
