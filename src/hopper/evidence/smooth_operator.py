"""The smooth-wall equations (4.3) as an operator, and checks of what the paper deduces from them.

(4.3) is the linearisation for sin(2 psi) ~ 2 psi and cos(2 psi) ~ 1 in (sigma, omega = sigma psi).
The paper reduces it to one equation for omega, (4.4) and (4.5); here it is solved as it stands.
"""

from dataclasses import dataclass
from math import degrees, pi

import numpy as np
import scipy

from hopper.arguments import Radians, Row, checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.problem import Geometry, Hopper
from hopper.roots import root_between
from hopper.spectral import chebyshev
from hopper.stability import smooth_wall
from hopper.stability.tilted import require_mohr_coulomb
from hopper.values import require_angle

# Kummer series of more take long, and lose all digits.
_LARGEST_MU = 1e4
# Its square is a divisor.
_LEAST_HALF_ANGLE = 1e-100


@checked
def operator_matrix(hopper: Hopper, m: int) -> Array:
    """Return the matrix of (4.3) on a half grid of ``m`` nodes, shape (2 m - 1, 2 m - 1).

    Unknowns: sigma1, even, at all nodes and omega1, odd, at all but the wall; lambda U = M U.
    """
    require_mohr_coulomb(hopper)
    s, k = hopper.s, hopper.curvature
    theta = hopper.half_angle * chebyshev.half_nodes(m)
    even, odd = (
        chebyshev.half_differentiation_matrix(m, parity) / hopper.half_angle
        for parity in ("even", "odd")
    )
    one = np.eye(m)
    divergence = odd + k * one / np.tan(theta)[:, None]
    sigma_row = np.hstack([(1 - (3 + 2 * k) * s) * one, -2 * s * divergence]) / (1 - s)
    omega_row = np.hstack([-(1 + s) / (2 * s) * even, (3 + k) * one])
    return np.vstack([sigma_row, omega_row])[:-1, :-1]


@dataclass(frozen=True)
class FormulaCheck:
    """Eigenvalues of (4.3) by collocation against the pairs of (4.7), sine modes, or (4.9).

    Attributes
    ----------
    error : float
        Largest relative distance of a pair's eigenvalue to its one-to-one partner.
    missing : complex array
        Eigenvalues of (4.3), no larger than the pairs compared, that the formula does not give.
    """

    error: float
    missing: Complex

    __repr__ = brief("error", "missing")

    @property
    def highest_missing(self) -> float:
        """Largest real part of ``missing``, minus infinity if there is none."""
        return float(self.missing.real.max(initial=-np.inf))


@checked
def check_formula(hopper: Hopper, count: int, m: int) -> FormulaCheck:
    """Compare the ``count`` lowest pairs with the matrix of ``m`` half-grid nodes.

    ``m`` must resolve them: m > 2 count suffices.
    """
    if hopper.geometry == "wedge":
        formula, _ = smooth_wall.wedge_eigenvalues(hopper.delta, hopper.half_angle, count)
    else:
        wavenumbers = smooth_wall.cone_wavenumbers(hopper.half_angle, count)
        formula = smooth_wall.cone_eigenvalues(hopper.delta, wavenumbers)
    found = np.linalg.eigvals(operator_matrix(hopper, m)).astype(complex)
    distance = np.abs(formula[:, None] - found) / np.abs(formula)[:, None]
    rows, columns = scipy.optimize.linear_sum_assignment(np.minimum(distance, 1.0))
    rest = np.delete(found, columns)
    return FormulaCheck(
        float(distance[rows, columns].max()), rest[np.abs(rest) <= np.abs(formula).max()]
    )


@checked
def neutral_delta(geometry: Geometry, half_angle: Radians) -> float:
    """Return the delta (radians) at which the first pair of (4.7) or (4.9) crosses Re = 0.

    A root of the eigenvalues themselves; `smooth_wall.neutral_delta` is the closed form.
    """

    def growth(delta: float) -> float:
        return float(_first_pair(geometry, delta, half_angle).real.max())

    return root_between(growth, 0.1, 1.2, xtol=1e-14)


@checked
def crossing_delta(half_angle: Radians) -> float:
    """Return the delta (radians) at which the first pairs of wedge and cone have the same Re."""

    def gap(delta: float) -> float:
        wedge, cone = (
            _first_pair(geometry, delta, half_angle).real.max() for geometry in _GEOMETRIES
        )
        return float(wedge - cone)

    if gap(0.1) * gap(1.2) > 0:
        raise InvalidParameterError(
            f"half_angle = {degrees(half_angle):.6g} deg is out of range: there is no crossing"
        )
    return root_between(gap, 0.1, 1.2, xtol=1e-14)


def _first_pair(geometry: Geometry, delta: float, half_angle: float) -> Complex:
    if half_angle < _LEAST_HALF_ANGLE:
        raise InvalidParameterError(f"half_angle = {half_angle:.3g} is too small to compute with")
    if geometry == "wedge":
        return smooth_wall.wedge_eigenvalues(delta, half_angle, 1)[0]
    return smooth_wall.cone_eigenvalues(delta, smooth_wall.cone_wavenumbers(half_angle, 1))


@checked
def real_onset(half_angle: Radians) -> float:
    """Return the least delta (radians) at which (4.9) with the Bessel mu_1 has a real eigenvalue.

    By bisection on the eigenvalues; sin of it is what the paper calls f(theta_w).
    """
    mu = smooth_wall.cone_wavenumbers(half_angle, 1, "bessel")
    low, high = 0.1, pi / 2 - 1e-9
    while high - low > 1e-14:
        middle = (low + high) / 2
        if np.all(smooth_wall.cone_eigenvalues(middle, mu).imag != 0):
            low = middle
        else:
            high = middle
    return high


@checked
def real_eigenvalues(deltas: Row, half_angle: Radians, count: int) -> int:
    """Return how many of the ``count`` lowest pairs of (4.9) are real at any of ``deltas``."""
    mu = smooth_wall.cone_wavenumbers(half_angle, count, "bessel")
    return sum(
        int(np.sum(smooth_wall.cone_eigenvalues(float(delta), mu).imag == 0)) for delta in deltas
    )


@checked
def kummer_residual(mu: float, half_angle: Radians, m: int) -> float:
    """Return the residual of theta Phi(1 - 3 mu / 2, 2, theta**2 / 6) in (4.10).

    Largest over a half grid of ``m`` nodes, relative to the largest of the equation's terms.
    """
    require_angle("half_angle", half_angle)
    if not 0 <= mu <= _LARGEST_MU:
        raise InvalidParameterError(f"mu = {mu} is out of range: use 0 <= mu <= {_LARGEST_MU:.0e}")
    theta = half_angle * chebyshev.half_nodes(m)
    even, odd = (
        chebyshev.half_differentiation_matrix(m, parity) / half_angle for parity in ("even", "odd")
    )
    omega = theta * scipy.special.hyp1f1(1 - 1.5 * mu, 2, theta**2 / 6)
    slope = odd @ omega
    terms = np.array(
        [
            theta**2 * (even @ slope),
            (theta - theta**3 / 3) * slope,
            ((mu - 1 / 3) * theta**2 - 1) * omega,
        ]
    )
    return float(np.abs(terms.sum(axis=0)).max() / np.abs(terms).max())


_GEOMETRIES: tuple[Geometry, Geometry] = ("wedge", "cone")
