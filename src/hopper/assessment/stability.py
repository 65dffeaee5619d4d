"""Linear stability of a radial solution in numbers: modes, abscissa, transient growth."""

from collections.abc import Callable
from dataclasses import dataclass
from math import exp, pi
from typing import Literal

import numpy as np
from scipy.optimize import minimize_scalar

from hopper.arrays import Array, Complex
from hopper.assessment.propagation import ROUNDING, propagated
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.quantity import Quantity
from hopper.radial.solution import RadialSolution
from hopper.spectral.transient import ModalBasis, condition_number, propagator_norm
from hopper.stability.convergence_filter import convergence_filter
from hopper.stability.mesh_spectrum import HALVES, mesh_spectrum
from hopper.stability.modes import LinearStability, linear_stability, upper_eigenvalues
from hopper.stability.transient import modal_basis

Verdict = Literal["stable", "unstable", "neutral"]

# Half-grid points on which eigenvalues are followed under a shift of the fields.
_SENSITIVITY_SIZE = 48
# Nodes of the two meshes for transient growth, and the largest change of a kept mode between them.
_NODES, _COARSE_NODES, _CHANGE = 96, 64, 1e-6
# Round trips of a wave between axis and wall over which growth is followed; samples of each.
_TRIPS, _SAMPLES = 4, 64


@dataclass(frozen=True)
class Transient:
    """Growth of perturbations in the span of the resolved modes of physical parity.

    The norm is L2 of (sigma1, psi1). Growth is followed for the first four round trips of a wave
    between axis and wall. More modes resolve narrower perturbations, which can grow more; in
    cones, where waves focus on the axis, without bound. So the number of modes is part of the
    answer.

    Attributes
    ----------
    modes : int
    condition : Quantity
        kappa(V), the bound of (4.11) on ``amplification``.
    amplification : Quantity
        Largest ||exp(-t M)|| / exp(-t alpha), alpha the spectral abscissa.
    growth : Quantity or None
        Largest ||exp(-t M)||; None unless the hopper is stable.
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
    mode_errors : array, shape (n,)
        Absolute errors of the low modes.
    abscissa : Quantity
    spectrum : complex array, shape (k,)
        Low modes, and further modes resolved to 1e-6, Im >= 0, by modulus.
    spectrum_errors : array, shape (k,)
        Absolute.
    transient : Transient or None
        None where too few modes are resolved.
    """

    result: LinearStability
    mode_errors: Array
    abscissa: Quantity
    spectrum: Complex
    spectrum_errors: Array
    transient: Transient | None

    __repr__ = brief("verdict", "abscissa", "result.governed_by")

    @property
    def line(self) -> Quantity:
        """Abscissa of the asymptotic line."""
        return Quantity(self.result.line.abscissa, self.result.line.error_estimate)

    @property
    def verdict(self) -> Verdict:
        """Stable or unstable; neutral where the error of the abscissa exceeds its size."""
        if abs(self.abscissa.value) <= self.abscissa.error:
            return "neutral"
        return "stable" if self.abscissa.value < 0 else "unstable"


def assess_stability(solution: RadialSolution) -> StabilityAssessment:
    """Return the linear stability of a radial solution in numbers.

    Raises
    ------
    HopperError
        As :func:`hopper.stability.stability`.
    """
    result, mode_errors, abscissa = abscissa_with_error(solution)
    low = result.eigenvalues
    kept, changes = _resolved_modes(solution)
    # What rounding and the fields leave is alike for all modes, relative to their modulus.
    changes = changes + np.abs(kept) * np.max(mode_errors / np.abs(low))
    further = (kept.imag >= 0) & (np.abs(kept) > (1 + _CHANGE) * np.abs(low[-1]))
    return StabilityAssessment(
        result,
        mode_errors,
        abscissa,
        spectrum=np.concatenate([low, kept[further]]),
        spectrum_errors=np.concatenate([mode_errors, changes[further]]),
        transient=_transient(solution, kept, result) if kept.size else None,
    )


def abscissa_with_error(solution: RadialSolution) -> tuple[LinearStability, Array, Quantity]:
    """Return what decides stability, the errors of its low modes, and the abscissa."""
    result = linear_stability(solution)
    modes = result.eigenvalues

    def followed(shifted: RadialSolution) -> Complex:
        found = upper_eigenvalues(shifted, _SENSITIVITY_SIZE)
        return found[np.abs(modes[:, None] - found).argmin(axis=1)]

    before = followed(solution)
    share = propagated(solution, lambda shifted: np.abs(followed(shifted) - before))
    errors = result.mode_errors + share
    # The line's own estimate covers the fields already.
    governed_by_mode = result.governed_by == "mode"
    error = float(errors[np.argmax(modes.real)]) if governed_by_mode else result.error_estimate
    return result, errors, Quantity(result.abscissa, error)


def _resolved_modes(solution: RadialSolution) -> tuple[Complex, Array]:
    """Return the modes of physical parity on which two meshes agree, and by how much (absolute)."""
    fine, coarse = mesh_spectrum(solution, _NODES), mesh_spectrum(solution, _COARSE_NODES)
    try:
        found = convergence_filter(fine, coarse, _CHANGE)
    except ConvergenceError:
        return np.empty(0, complex), np.empty(0)
    kept = found.kept & (fine.half == HALVES.index("physical"))
    # Both of a pair or none: the filter's thresholds see them apart by rounding.
    kept &= np.isin(fine.eigenvalues.conj(), fine.eigenvalues[kept])
    modes = fine.eigenvalues[kept]
    return modes, found.change[kept] * np.abs(modes)


def _transient(solution: RadialSolution, kept: Complex, result: LinearStability) -> Transient:
    fine, coarse = (modal_basis(solution, n, "physical", kept) for n in (_NODES, _COARSE_NODES))
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
        amplification=largest(result.abscissa),
        growth=largest(0.0) if result.stable else None,
    )


def _scaled_norm(basis: ModalBasis, elapsed: float, rate: float) -> float:
    """Return ||exp(-t M)|| exp(-rate elapsed)."""
    return float(propagator_norm([basis], elapsed)) * exp(-rate * elapsed)


def _time_of_largest(basis: ModalBasis, rate: float, period: float) -> float:
    times = np.linspace(0, _TRIPS * period, _TRIPS * _SAMPLES + 1)
    peak = times[np.argmax(propagator_norm([basis], times) * np.exp(-rate * times))]
    around = max(0.0, peak - times[1]), min(peak + times[1], times[-1])
    found = minimize_scalar(
        lambda elapsed: -_scaled_norm(basis, elapsed, rate), bounds=around, method="bounded"
    )
    return float(found.x)
