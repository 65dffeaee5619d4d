"""Characteristics of the von Mises equations, and their type.

The four slopes kappa = dt/dtheta are the roots of

    c (c + m) k**4 + 2 sqrt(3) q (c + m) k**3 + (4 q**2 - c (c + m)) k**2
        - 2 sqrt(3) q (c - m) k + c (c - 2 m) = 0.

In the axes of principal stress, turned by alpha with tan 2alpha = 2 q / (sqrt(3) c), it is
biquadratic, T1 k**4 - (2 - c**2 + m c) k**2 + T2 = 0 with the principal stresses T1 > T2 in the
plane of flow over sigma, and of discriminant (4 - c**2) (3 m - c) (c + m). For delta < 60 deg T2 is
positive: where cos 2psi > sqrt(3) sin delta the equations are elliptic, elsewhere hyperbolic.
"""

from dataclasses import dataclass
from math import pi, sqrt
from typing import Literal

import numpy as np

from hopper.arguments import Fraction, Row, checked
from hopper.arrays import Numbers
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.radial.solution import RadialSolution
from hopper.roots import root_between
from hopper.spectral import chebyshev
from hopper.values import require_equal_shapes

Kind = Literal["elliptic", "hyperbolic", "mixed", "tension"]

# delta from which T_rr <= 0 on the axis, and the one from which the axis is hyperbolic, radians.
TENSION = pi / 3
AXIS_HYPERBOLIC = float(np.arcsin(1 / sqrt(3)))
# psi at the nodes misses its maximum to second order in their distance: a closer look is due only
# within this part of a border.
_NEAR = 0.98
_RING_NODES = 40


@dataclass(frozen=True)
class EquationType:
    """Where the equations of a radial flow are elliptic or hyperbolic.

    Attributes
    ----------
    kind : "elliptic", "hyperbolic", "mixed" or "tension"
        Tension: T_rr <= 0 on the axis, delta >= 60 deg.
    slanted : bool
        Hyperbolic, but a characteristic lies in t = const where cos 2psi = 2 sin(delta) / sqrt(3):
        data belong on a surface t - f(theta) = const. The spectrum does not change.
    sonic : tuple of floats
        Angles theta (radians) at which a mixed flow changes its type; the first ends the core.
    ring_spacing : float
        Mean spacing in Im(lambda) of the modes that run in the ring of a mixed flow; NaN otherwise.
    """

    kind: Kind
    slanted: bool = False
    sonic: tuple[float, ...] = ()
    ring_spacing: float = np.nan

    __repr__ = brief("kind", "slanted", "ring_spacing")


@checked
def equation_type(solution: RadialSolution) -> EquationType:
    """Return the type of the equations of a radial flow, over the whole cone.

    The largest psi decides, which lies inside wide cones and not at their wall.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial, yield_condition
    >>> from hopper.von_mises.characteristics import equation_type
    >>> hopper = Hopper("cone", 0.7, 0.2, yield_condition("von-mises"))
    >>> equation_type(solve_radial(hopper, friction_angle=0.1)).kind
    'hyperbolic'
    """
    delta, s = solution.hopper.delta, solution.hopper.s
    if delta >= TENSION:
        return EquationType("tension")
    if delta >= AXIS_HYPERBOLIC:
        return EquationType("hyperbolic", slanted=reaches(solution, tangency_angle(s)))
    limit = sonic_angle(s)
    if not reaches(solution, limit):
        return EquationType("elliptic")
    sonic = _crossings(solution, limit)
    return EquationType("mixed", sonic=sonic, ring_spacing=_ring_spacing(solution, sonic))


@checked
def sonic_angle(s: Fraction) -> float:
    """Return the psi (radians) at which the type changes, cos 2psi = sqrt(3) s; s = sin(delta).

    Examples
    --------
    >>> from hopper.von_mises.characteristics import sonic_angle
    >>> round(sonic_angle(s=0.5), 4)
    0.2618
    """
    return float(np.arccos(min(1.0, sqrt(3) * s))) / 2


@checked
def tangency_angle(s: Fraction) -> float:
    """Return the psi (radians) at which a characteristic lies in t = const, from s = sin(delta)."""
    return float(np.arccos(min(1.0, 2 * s / sqrt(3)))) / 2


@checked
def slopes(c: Row, q: Row, m: Fraction) -> Numbers:
    """Return the slopes kappa, ordered as on the axis if real, shape (4, n).

    Real where all are. Complex ones: the last is the one with Re > 0 > Im, the third its conjugate;
    the first two are their mirrors.

    Parameters
    ----------
    c, q : arrays, shape (n,)
        cos 2psi > 0 and sin 2psi.
    m : float
        sin(delta) / sqrt(3), below 1/2.

    Raises
    ------
    InvalidParameterError
        If the shapes differ, or c <= 0.
    """
    require_equal_shapes(c=c, q=q)
    if np.any(c <= 0):
        raise InvalidParameterError("c must be positive: the velocity is singular where it is not")
    discriminant: Numbers = (4 - c**2) * (3 * m - c) * (c + m)
    if np.any(discriminant < 0):
        discriminant = discriminant.astype(np.complex128)
    half_sum = 1 - m * c / 2
    half_difference = m / 2 * np.sqrt(12 - 3 * c**2)
    # The larger root, and the smaller one from the product.
    larger = (2 - c**2 + m * c + np.sqrt(discriminant)) / (2 * (half_sum + half_difference))
    product = (half_sum - half_difference) / (half_sum + half_difference)
    outer, inner = np.sqrt(larger), np.sqrt(product / larger)
    if np.iscomplexobj(discriminant):
        # The principal root of a negative discriminant is +i: the last is to have Im < 0.
        outer, inner = inner, outer
    twice = 2 / sqrt(3) * q / c
    turn = twice / (1 + np.sqrt(1 + twice**2))
    roots = np.stack([-outer, -inner, inner, outer])
    return (roots - turn) / (1 + roots * turn)


@checked
def reaches(solution: RadialSolution, psi: float) -> bool:
    """Whether the largest psi of a flow is at least the given one, radians."""
    at_nodes = float(solution.psi.max())
    return at_nodes >= psi or (at_nodes >= _NEAR * psi and solution.psi_maximum()[1] >= psi)


def _crossings(solution: RadialSolution, psi: float) -> tuple[float, ...]:
    """Return where psi passes a value below its maximum: once, or twice if psi falls again."""

    def excess(theta: float) -> float:
        return float(solution.psi_at(theta)[0]) - psi

    top, wall = solution.psi_maximum()[0], solution.hopper.half_angle
    found = [root_between(excess, 0.0, top, xtol=1e-14)] if excess(top) > 0 else [top]
    if excess(wall) < 0:
        found.append(root_between(excess, top, wall, xtol=1e-14) if excess(top) > 0 else top)
    return tuple(float(theta) for theta in found)


def _ring_spacing(solution: RadialSolution, sonic: tuple[float, ...]) -> float:
    """Return 2 pi over the integral of k4 - k3 + k2 - k1 over the ring.

    The integrand has a square root at the sonic lines, which theta = ... (1 - cos) removes.
    """
    inner = sonic[0]
    outer = sonic[1] if len(sonic) > 1 else solution.hopper.half_angle
    x, weight = chebyshev.nodes(_RING_NODES), chebyshev.clenshaw_curtis_weights(_RING_NODES)
    angle = (1 + x) * pi / 2
    theta = inner + (outer - inner) * (1 - np.cos(angle)) / 2
    psi = solution.psi_at(theta)
    m = solution.hopper.s / sqrt(3)
    # Inside the ring 3 m >= c but for rounding at its ends.
    k = slopes(np.minimum(np.cos(2 * psi), 3 * m), np.sin(2 * psi), m)
    integrand = (k[3] - k[2] + k[1] - k[0]) * np.sin(angle) * (outer - inner) / 2
    return 2 * pi / float(weight @ integrand * pi / 2)
