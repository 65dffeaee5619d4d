"""Where the modes of high frequency lie: strips, lines or rays in the plane of lambda.

Hyperbolic flows. The law of :mod:`hopper.von_mises.high_frequency`,
A + B E_a + C E_b + F E_a E_b = 0 with |E_j| = rho_j = exp(x Phi_j + Gamma_j), x = Re(lambda),
couples two incommensurable periods, so its roots fill strips of x. As |A + B E_a| / |C + F E_a| is
monotone in the cosine of the phase of E_a, x belongs to one where rho_b lies between the two values
of that ratio at E_a = +-rho_a: where the product over the four signs of

    D(x; +-, +-) = A +- rho_a B +- rho_b C +- +- rho_a rho_b F

is not positive. The edges are the real zeros of the four D. They are approached, and not attained.
Along smooth walls A F = B C, and each strip is a line.

Elliptic flows: Phi is complex, and the roots lie on rays.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import exp, inf, log, pi

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array, Complex
from hopper.brief import brief
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.roots import root_between
from hopper.von_mises.high_frequency import HighFrequency


@dataclass(frozen=True)
class Strips:
    """Intervals of Re(lambda) that the modes of high frequency of a hyperbolic flow fill.

    Attributes
    ----------
    intervals : array, shape (k, 2)
        Lower and upper edges, increasing; two, or one where those of both families overlap.
    spacing : array, shape (2,)
        2 pi / Phi of families a and b: distance in Im(lambda) of the modes of each.
    error_estimate : float
        Of the edges.
    """

    intervals: Array
    spacing: Array
    error_estimate: float

    __repr__ = brief("upper_edge", "spacing", "error_estimate")

    @property
    def upper_edge(self) -> float:
        """Supremum of Re(lambda) at high frequency."""
        return float(self.intervals[-1, 1])


@checked
def strips(law: HighFrequency) -> Strips:
    """Return the strips of a hyperbolic flow.

    Raises
    ------
    ConvergenceError
        If an edge is lost in rounding.
    """
    (phi_a, phi_b), (gamma_a, gamma_b) = law.phi.tolist(), law.gamma.tolist()
    a, b, c, f = law.walls.tolist()
    rates = [0.0, phi_b, phi_a, phi_a + phi_b]
    edges: list[float] = []
    for sign_a in (1, -1):
        for sign_b in (1, -1):
            terms = [
                (a, 0.0), (sign_b * c, gamma_b), (sign_a * b, gamma_a),
                (sign_a * sign_b * f, gamma_a + gamma_b),
            ]  # fmt: skip
            edges += _zeros(terms, rates)
    if len(edges) < 2 or len(edges) % 2:
        raise ConvergenceError(
            f"strips of high frequency not resolved: {len(edges)} edges; change delta slightly"
        )
    intervals = np.sort(edges).reshape(-1, 2)
    error = law.error_estimate * (2 + float(np.abs(intervals).max()) * phi_a) / phi_b
    return Strips(intervals, 2 * pi / law.phi, error)


@checked
def lines(law: HighFrequency) -> Array:
    """Return Re(lambda) = -Gamma / Phi of the lines of families a and b along a smooth wall."""
    return -law.gamma / law.phi


@dataclass(frozen=True)
class Rays:
    """Rays ``start + n step``, n = 1, 2, ..., of the modes with Im(lambda) > 0 of elliptic flows.

    Each array has shape (2,): the ray of growing Re(lambda), and the one of falling Re(lambda).
    The conjugate modes lie on their mirror images.
    """

    start: Complex
    step: Complex

    __repr__ = brief("slope")

    @property
    def slope(self) -> float:
        """|Re / Im| of lambda along the rays."""
        return float(abs(self.step[0].real / self.step[0].imag))


@checked
def rays(law: HighFrequency) -> Rays:
    """Return the rays of an elliptic flow.

    Where Re(lambda) grows E_a is large, so that E_b = -B / F; where it falls E_b is small, and
    E_a = -A / B.
    """
    a, b, _, f = law.walls
    phi, gamma = law.phi[::-1], law.gamma[::-1]
    start = (np.log(1j * np.array([b / f, a / b])) - gamma) / phi
    return Rays(start.astype(np.complex128), 2j * pi / phi)


@checked
def zeros(terms: Sequence[tuple[float, float]], rates: Sequence[float]) -> list[float]:
    """Return the real zeros of sum c_k exp(g_k + w_k x), by increasing x.

    Between zeros of the derivative of the sum over its first exponential, itself a sum of one term
    less, the quotient is monotone (Rolle).

    Parameters
    ----------
    terms : list of (c_k, g_k)
        Factors, and what is added to the exponents.
    rates : list of w_k
        Increasing.

    Raises
    ------
    InvalidParameterError
        If they differ in number.
    """
    if len(terms) != len(rates):
        raise InvalidParameterError("terms and rates differ in number: give one rate for each term")
    return _zeros(terms, rates)


def _zeros(terms: Sequence[tuple[float, float]], rates: Sequence[float]) -> list[float]:
    kept = [(c, g, w) for (c, g), w in zip(terms, rates, strict=True) if c != 0]
    if len(kept) < 2:
        return []
    (c0, g0, w0), rest = kept[0], kept[1:]
    if len(kept) == 2:
        (c1, g1, w1) = rest[0]
        return [(log(-c0 / c1) + g0 - g1) / (w1 - w0)] if c0 * c1 < 0 else []
    turning = _zeros([(c * (w - w0), g) for c, g, w in rest], [w for _, _, w in rest])

    # Scaled by the largest term, which keeps the sign.
    def value(x: float) -> float:
        exponents = [g + w * x for _, g, w in kept]
        top = max(exponents)
        return sum([c * exp(e - top) for (c, _, _), e in zip(kept, exponents, strict=True)])

    found = []
    points = [_beyond(kept[::-1]), *turning, _beyond(kept)]
    for low, high in pairwise(points):
        ends = value(low), value(high)
        if ends[0] == 0:
            found.append(low)
        elif ends[0] * ends[1] < 0:
            found.append(root_between(value, low, high, xtol=1e-14))
    return found


def _beyond(terms: list[tuple[float, float, float]]) -> float:
    """Return an x beyond which the last term exceeds the sum of the others."""
    c, g, w = terms[-1]
    others = len(terms) - 1
    bounds = [(log(2 * others * abs(b / c)) + e - g) / (w - v) for b, e, v in terms[:-1]]
    return max(bounds, default=-inf) if w > terms[0][2] else min(bounds, default=inf)
