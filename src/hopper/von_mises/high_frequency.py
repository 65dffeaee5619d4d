"""The law that modes of high frequency obey, by quadrature over the radial flow.

With V = (P, Q, lambda U, lambda W) the linearised equations are V' = (lambda K1 + K0 + ...) V. The
eigenvalues of K1 are the slopes kappa of the characteristics; with right and left vectors r, l of
K1, a wave along one of them is exp(lambda int kappa + int g), g = l (K0 r - r'). They belong to two
families, a and b, each of which runs from wall to wall: on the axis regularity couples only waves
of one family. With

    Phi = int kappa, Gamma = p.v. int g   from -theta_w to theta_w, of the wave with kappa > 0,
    E = i exp(lambda Phi + Gamma),        v = (Q + mu P) / (lambda W) of r at the wall,

modes of Im(lambda) > 0 approach, with an error of order 1 / lambda, the roots of

    A + B E_a + C E_b + F E_a E_b = 0,
    A = v_a- - v_b-, B = v_a+ - v_b-, C = v_a- - v_b+, F = v_a+ - v_b+.
"""

from dataclasses import dataclass
from math import pi, sqrt, tan

import numpy as np

from hopper.arguments import ComplexRow, checked
from hopper.arrays import Array, Complex, Numbers
from hopper.brief import brief
from hopper.errors import ConvergenceError
from hopper.radial.grid import Grid, half_grid
from hopper.radial.solution import RadialSolution
from hopper.spectral import chebyshev
from hopper.von_mises.characteristics import slopes
from hopper.von_mises.linearisation import Coefficients, coefficients

# Overhead is most of the cost up to a hundred half nodes.
_SIZES = (24, 48, 96, 192, 384)
_TOLERANCE = 1e-11
_ACCEPTABLE = 1e-5
_ROUNDING = 1e-13
_NEWTON_STEPS = 30


@dataclass(frozen=True)
class HighFrequency:
    """What the law of high frequency is made of; of families a and b where an array has two.

    Real for hyperbolic flows; for elliptic ones a and b are conjugate, Im(phi_a) < 0.

    Attributes
    ----------
    phi, gamma : arrays, shape (2,)
    walls : array, shape (4,)
        A, B, C and F.
    error_estimate : float
        Of gamma, and of phi relative to phi_a.
    """

    phi: Numbers
    gamma: Numbers
    walls: Numbers
    error_estimate: float

    __repr__ = brief("phi", "gamma", "error_estimate")

    @checked
    def residual(self, eigenvalues: ComplexRow) -> tuple[Complex, Complex]:
        """Return the law's left side and its derivative over the largest term, shape (n,).

        For Im(lambda) > 0.
        """
        return self._residual(eigenvalues)

    def _residual(self, eigenvalues: Complex) -> tuple[Complex, Complex]:
        both = self.phi.sum(), self.gamma.sum()
        exponents = np.stack([
            np.log(self.walls[0] + 0j) + 0 * eigenvalues,
            np.log(1j * self.walls[1]) + eigenvalues * self.phi[0] + self.gamma[0],
            np.log(1j * self.walls[2]) + eigenvalues * self.phi[1] + self.gamma[1],
            np.log(-self.walls[3] + 0j) + eigenvalues * both[0] + both[1],
        ])  # fmt: skip
        terms = np.exp(exponents - exponents.real.max(axis=0))
        rates = np.array([0, self.phi[0], self.phi[1], both[0]])
        return terms.sum(axis=0), rates @ terms

    @checked
    def nearest_roots(self, eigenvalues: ComplexRow) -> Complex:
        """Return the root of the law next to each mode of high frequency, by Newton's iteration.

        NaN where there is none within the spacing of modes.
        """
        roots, reach = eigenvalues.copy(), 2 * pi / abs(self.phi[0])
        with np.errstate(all="ignore"):
            for _ in range(_NEWTON_STEPS):
                value, slope = self._residual(roots)
                step = value / slope
                # Exponentials of far-off values overflow.
                roots -= np.where(np.abs(step) < reach, step, reach * step / np.abs(step))
                if np.all(np.abs(step) < _ROUNDING * np.abs(roots)):
                    break
        good = (np.abs(step) < 1e-9 * reach) & (np.abs(roots - eigenvalues) < reach)
        return np.where(good, roots, np.nan)


@checked
def high_frequency(solution: RadialSolution) -> HighFrequency:
    """Return the law of high frequency of an elliptic or hyperbolic flow.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises.
    SingularVelocityError
        If psi reaches pi/4.
    ConvergenceError
        If the quadratures do not reach 1e-5: the flow changes its type inside, or nearly so.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial, yield_condition
    >>> from hopper.von_mises.high_frequency import high_frequency
    >>> hopper = Hopper("cone", 0.7, 0.2, yield_condition("von-mises"))
    >>> high_frequency(solve_radial(hopper, friction_angle=0.1)).phi.round(4)
    array([0.3532, 0.1989])
    """
    for size in _SIZES:
        grid = half_grid(size, solution.hopper.half_angle)
        law = law_on(solution, grid, coefficients(solution, [grid])[0])
        if law.error_estimate < _TOLERANCE * max(1, float(np.abs(law.gamma).max())):
            break
    amplified = law.error_estimate + float(np.abs(law.gamma).max()) * (
        10 * solution.error_estimate + _ROUNDING
    )
    if not amplified < _ACCEPTABLE:
        raise ConvergenceError(
            f"law of high frequency not resolved: error {amplified:.1e}; the flow changes its type "
            "inside the cone, or nearly does: change delta or lower the wall friction"
        )
    return HighFrequency(law.phi, law.gamma, law.walls, amplified)


@checked
def law_on(solution: RadialSolution, grid: Grid, at: Coefficients) -> HighFrequency:
    """Return the law by quadrature on a half grid; error_estimate is that of the quadrature."""
    n, half_angle = grid.size, solution.hopper.half_angle
    # The whole interval: c is even, all else odd.
    c = np.concatenate([at.c[::-1], at.c])
    q, cot, l, h = (  # noqa: E741
        np.concatenate([-f[::-1], f]) for f in (at.q, at.cot, at.l, at.h)
    )
    outgoing = slopes(c, q, at.m)[[3, 2]]
    right = _right_vectors(outgoing, c, q, at.s)
    # A wave of the same family that comes in is the mirror image, with P and lambda U reversed.
    mirrored = right[:, :, ::-1] * np.array([-1, 1, -1, 1])[:, None]
    basis = np.concatenate([right, mirrored]).transpose(2, 1, 0)
    left = np.linalg.inv(basis)[:, :2].transpose(1, 2, 0)
    d = chebyshev.differentiation_matrix(2 * n) / half_angle
    transport = _lower_order(right, (c, q, cot, l, h), at.s) - right @ d.T
    g = (left * transport).sum(axis=1)
    # Poles of opposite sign at +-theta cancel in the sum.
    even = (outgoing + outgoing[:, ::-1])[:, n:], (g + g[:, ::-1])[:, n:]
    weights = half_angle * chebyshev.clenshaw_curtis_weights(2 * n)[n:]
    phi, gamma = (f @ weights for f in even)
    tail = [_tail(f) * half_angle for f in even]
    mu = tan(solution.friction_angle)
    v_out = right[:, 1, -1] + mu * right[:, 0, -1]
    v_in = mirrored[:, 1, -1] + mu * mirrored[:, 0, -1]
    walls = np.array(
        [v_in[0] - v_in[1], v_out[0] - v_in[1], v_in[0] - v_out[1], v_out[0] - v_out[1]]
    )
    error = max(tail[0] / abs(phi[0]) * float(np.abs(gamma).max()), tail[1])
    return HighFrequency(phi, gamma, walls, error)


def _tail(values: Numbers) -> float:
    """Largest of the last Chebyshev coefficients of even functions on a half grid, shape (2, n)."""
    parts = np.concatenate([values.real, values.imag]).T
    return float(np.abs(chebyshev.half_coefficients(parts, "even")[-3:]).max())


def _right_vectors(k: Numbers, c: Array, q: Array, s: float) -> Numbers:
    """Return (P, Q, lambda U, lambda W) over lambda W of slopes k, shape (2, n), as (2, 4, n)."""
    m = s / sqrt(3)
    Y = -c / (4 * sqrt(3)) * (c * (k**2 - 1) + sqrt(3) * q * k)
    S = -Y * (4 * m * q + 2 * s * c * k) / (1 - 2 * m * c + s * q * k)
    Q = -s * q * S - 2 * s * c * Y
    P = (1 + m * c) * S - 2 * m * q * Y + s * c / sqrt(12) * k
    return np.stack([P, Q, k, np.ones_like(k)], axis=1)


def _lower_order(right: Numbers, flow: tuple[Array, ...], s: float) -> Numbers:
    """Return K0 r, shape (2, 4, n); flow is c, q, cot, l and h."""
    c, q, cot, l, h = flow  # noqa: E741
    m = s / sqrt(3)
    P, Q, k, W = right.transpose(1, 0, 2)
    # Z = Z0 + Z1 / lambda; the parts of R and Y in Z1 are of this order too.
    Z0, Z1 = c / sqrt(12) * k, -c / sqrt(3) * cot
    R1, Y1 = -s * (c - 2 * m) / (c + m) * Z1, s * q / (2 * (c + m)) * Z1
    return np.stack([
        -l * P - 4 * Q - 2 * s * cot * Z0,
        # R of leading order is k Q, as r is an eigenvector.
        -(l + cot + 3 * k) * Q + 2 * (P - s * Z0) + R1,
        (3 - 4 * sqrt(3) / c**2 * Y1) * W,
        (h - cot) * W,
    ], axis=1)  # fmt: skip
