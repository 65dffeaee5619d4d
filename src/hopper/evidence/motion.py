"""Stress and strain rate as tensors, and the laws of section 2 that they obey.

The solvers use reduced forms of these equations; here stand the equations themselves, to check
fields and the paper's own reductions against. Tensors are in units of rho g r at r = 1, their
components along r, theta and phi; compressive stress and contracting strain rate are positive.
"""

from dataclasses import dataclass
from math import pi
from typing import NamedTuple

import numpy as np

from hopper.arguments import Fraction, Row, checked
from hopper.arrays import Array, Complex, Numbers
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.radial.grid import half_grid
from hopper.radial.solution import RadialSolution
from hopper.radial.velocity import VelocityField
from hopper.spectral import chebyshev
from hopper.values import require_equal_shapes
from hopper.yield_conditions import MOHR_COULOMB, VON_MISES, YieldCondition

_COMPLEX_STEP = 1e-30
_SMALL_PSI = 1e-8


class Tensor(NamedTuple):
    """Components of a symmetric tensor with the symmetry of the flow, each of shape (n,)."""

    rr: Numbers
    tt: Numbers
    pp: Numbers
    rt: Numbers


@checked
def stress(
    law: YieldCondition, s: Fraction, sigma: Numbers | float, psi: Numbers | float
) -> Tensor:
    """Return the stress of average sigma and angle psi (radians), (3.1) or (3.2); s = sin delta."""
    require_equal_shapes(sigma=sigma, psi=psi)
    return Tensor(*(sigma * part for part in _shape(law, s, psi)))


def _shape(law: YieldCondition, s: float, psi: Numbers | float) -> Tensor:
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    return Tensor(
        1 - law.radial * s * c2,
        1 + law.angular * s * c2,
        1 + s * (law.hoop + law.hoop_cosine * c2),
        -s * s2,
    )


def _rate(
    law: YieldCondition, s: float, sigma: Numbers, psi: Numbers, dsigma: Numbers, dpsi: Numbers
) -> Tensor:
    """Return the derivative of the stress along which sigma and psi change by dsigma and dpsi."""
    c2, s2 = np.cos(2 * psi), np.sin(2 * psi)
    slopes = (law.radial * s2, -law.angular * s2, -law.hoop_cosine * s2, -c2)
    parts = zip(_shape(law, s, psi), slopes, strict=True)
    return Tensor(*(dsigma * part + sigma * 2 * s * slope * dpsi for part, slope in parts))


@checked
def strain_rate(u: Array, du: Array, curvature: int) -> Tensor:
    """Return that of radial flow v = -u(theta) r**(1 - d) e_r at r = 1; curvature = d - 2."""
    require_equal_shapes(u=u, du=du)
    return Tensor(-(1 + curvature) * u, u, curvature * u, du / 2)


@checked
def yield_residual(law: YieldCondition, s: float, t: Tensor) -> Numbers:
    """Return left minus right side of (2.4'), (2.5') over the square of the average stress."""
    if law == MOHR_COULOMB:
        average = (t.rr + t.tt) / 2
        return ((t.rr - t.tt) ** 2 + 4 * t.rt**2) / (2 * average) ** 2 - s**2
    p = (t.rr + t.tt + t.pp) / 3
    squares = (t.rr - p) ** 2 + (t.tt - p) ** 2 + (t.pp - p) ** 2 + 2 * t.rt**2
    return squares / p**2 - 2 * s**2


@checked
def principal_stresses(t: Tensor) -> Array:
    """Return the eigenvalues of a stress, ascending, shape (n, 3)."""
    matrix = np.zeros((*t.rr.shape, 3, 3))
    matrix[..., 0, 0], matrix[..., 1, 1], matrix[..., 2, 2] = t.rr, t.tt, t.pp
    matrix[..., 0, 1] = matrix[..., 1, 0] = t.rt
    return np.linalg.eigvalsh(matrix)


@checked
def friction_on_wall(t: Tensor) -> Numbers:
    """Return the ratio of tangential to normal stress on a wall theta = const, mu of (2.15)."""
    return -t.rt / t.tt


@checked
def flow_exponent(law: YieldCondition, t: Tensor, psi: Array, curvature: int) -> Numbers:
    """Return c in u' = -c u tan(2 psi) that the flow rule asks of radial flow.

    Mohr-Coulomb: coaxiality, (2.11); von Mises: Levy's flow rule, (2.14). psi in radians, not 0.
    """
    flow = strain_rate(np.ones_like(psi), np.zeros_like(psi), curvature)
    if law == MOHR_COULOMB:
        shear = (flow.rr - flow.tt) * t.rt / (t.rr - t.tt)
    else:
        p = (t.rr + t.tt + t.pp) / 3
        shear = flow.tt * t.rt / (t.tt - p)
    return -2 * shear / np.tan(2 * psi)


@dataclass(frozen=True)
class LevyFactor:
    """Least chi of V = chi (T - p I), (2.7), and the part of V that is not of this form.

    ``defect`` is the largest over the hopper, relative to the largest component of V.
    """

    least: float
    defect: float

    __repr__ = brief("least", "defect")


@checked
def levy_factor(solution: RadialSolution, velocity: VelocityField) -> LevyFactor:
    """Return how well a von Mises cone obeys Levy's flow rule, for u(0) = 1.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises.
    """
    hopper = solution.hopper
    if hopper.material != VON_MISES:
        raise InvalidParameterError("Levy's flow rule belongs to model = von-mises")
    m = velocity.log_u.size
    sigma, psi, _, _ = solution.fields_on([half_grid(m, hopper.half_angle)])
    u = np.exp(velocity.log_u)
    slope = chebyshev.half_differentiation_matrix(m, "even") @ velocity.log_u / hopper.half_angle
    flow = np.array(strain_rate(u, u * slope, hopper.curvature))
    t = stress(hopper.material, hopper.s, sigma, psi)
    p = (t.rr + t.tt + t.pp) / 3
    deviator = np.array([t.rr - p, t.tt - p, t.pp - p, t.rt])
    chi = flow[1] / deviator[1]
    defect = np.abs(flow - chi * deviator) / np.abs(flow).max(axis=0)
    return LevyFactor(float(chi.min()), float(defect.max()))


@checked
def velocity_coupling(solution: RadialSolution, *, radial_only: bool) -> float:
    """Return how strongly the stress equations react to a perturbation of the velocity.

    The hoop stress is what could couple them: (2.6') does not contain the velocity, (2.13) does.
    Its derivative along v_r / u = cos(pi theta / theta_w) and, unless ``radial_only``,
    v_theta / u = sin(pi theta / theta_w), which the wall permits; the largest over the hopper,
    with u = 1.
    """
    half_angle = solution.hopper.half_angle
    theta = solution.theta
    wave = pi * theta / half_angle
    v_r = -1 + 1j * _COMPLEX_STEP * np.cos(wave)
    swirl = 0 if radial_only else 1
    v_t = 1j * _COMPLEX_STEP * swirl * np.sin(wave)
    dv_t = 1j * _COMPLEX_STEP * swirl * pi / half_angle * np.cos(wave)
    if solution.hopper.material == MOHR_COULOMB:
        ratio = np.zeros_like(v_r)
    else:
        ratio = (v_r + v_t / np.tan(theta)) / (dv_t + v_r)
    return float(np.abs(ratio.imag).max() / _COMPLEX_STEP)


@checked
def linearised(solution: RadialSolution, theta: Row, curvature: int) -> tuple[Array, Array]:
    """Return A and F of u_t + A u_theta + F u = 0, u = (sigma1, psi1), straight from (2.8), (2.9).

    The equations of motion are differentiated by complex steps, exact to rounding.

    Parameters
    ----------
    solution : RadialSolution
        Field to linearise about.
    theta : array, shape (n,)
        Radians, 0 < |theta| <= theta_w.
    curvature : 0 or 1
        d - 2 in the equations, whatever the solution's: their difference is C of (4.1).

    Returns
    -------
    A, F : arrays, shape (n, 2, 2)
    """
    sigma, psi, dsigma, dpsi = solution.fields(theta)
    state = np.array([sigma, psi, 0 * theta, 0 * theta, dsigma, dpsi], dtype=complex)
    columns = []
    for i in range(len(state)):
        shifted = state.copy()
        shifted[i] += 1j * _COMPLEX_STEP
        columns.append(_momentum(solution, curvature, theta, shifted).imag / _COMPLEX_STEP)
    # (argument, equation, n) -> three matrices (n, equation, unknown).
    algebraic, in_time, in_angle = np.moveaxis(
        np.array(columns).reshape(3, 2, 2, -1), (1, 2), (3, 2)
    )
    a, f = (np.linalg.solve(in_time, part) for part in (in_angle, algebraic))
    return a.astype(np.float64), f.astype(np.float64)


def _momentum(solution: RadialSolution, k: int, theta: Array, state: Complex) -> Complex:
    """Return the residuals of (2.8) and (2.9) over rho g, with r d/dr = d/dt and T = r S."""
    law, s = solution.hopper.material, solution.hopper.s
    sigma, psi, sigma_t, psi_t, sigma_theta, psi_theta = state
    at = stress(law, s, sigma, psi)
    by_t = _rate(law, s, sigma, psi, sigma_t, psi_t)
    by_theta = _rate(law, s, sigma, psi, sigma_theta, psi_theta)
    cot = 1 / np.tan(theta)
    radial = (
        at.rr
        + by_t.rr
        + by_theta.rt
        + (1 + k) * at.rr
        - at.tt
        + k * (cot * at.rt - at.pp)
        + np.cos(theta)
    )
    angular = (
        at.rt + by_t.rt + by_theta.tt + (2 + k) * at.rt + k * cot * (at.tt - at.pp) - np.sin(theta)
    )
    return np.array([radial, angular])


@dataclass(frozen=True)
class FieldCheck:
    """What a radial field makes of the laws stated for it; residuals are the largest in size.

    Attributes
    ----------
    yield_residual : float
        Of (2.4') or (2.5').
    ratio_residual : float
        sigma_1 / sigma_3 over (1 + s) / (1 - s), minus 1; NaN for von Mises.
    hoop_residual : float
        Mohr-Coulomb: T_phiphi over the major principal stress, minus 1, (2.6). Von Mises: T_phiphi
        over T_thetatheta, minus 1.
    wall_mu : float
        Tangential over normal stress at the wall, (2.15).
    exponent, exponent_spread : float
        Mean and range over the hopper of c in u' = -c u tan(2 psi).
    coupling_radial, coupling : float
        :func:`velocity_coupling` without and with perturbations across the radial direction.
    psi_max : float
        Radians.
    """

    yield_residual: float
    ratio_residual: float
    hoop_residual: float
    wall_mu: float
    exponent: float
    exponent_spread: float
    coupling_radial: float
    coupling: float
    psi_max: float

    __repr__ = brief(
        "yield_residual", "hoop_residual", "wall_mu", "exponent", "coupling", "psi_max deg"
    )


@checked
def check_field(solution: RadialSolution) -> FieldCheck:
    """Hold a radial field against (2.4)-(2.6), (2.11)-(2.15) and (3.1)-(3.5)."""
    law, s = solution.hopper.material, solution.hopper.s
    t = stress(law, s, solution.sigma, solution.psi)
    principal = principal_stresses(t)
    ratio = principal[:, 2] / principal[:, 0] * (1 - s) / (1 + s) - 1
    coulomb = law == MOHR_COULOMB
    inside = np.abs(solution.psi) > _SMALL_PSI
    # On a smooth wall psi vanishes, and tan(2 psi) with it.
    at = Tensor(*(part[inside] for part in t))
    exponent = flow_exponent(law, at, solution.psi[inside], solution.hopper.curvature)
    return FieldCheck(
        yield_residual=_largest(yield_residual(law, s, t)),
        ratio_residual=_largest(ratio) if coulomb else np.nan,
        hoop_residual=_largest(t.pp / (principal[:, 2] if coulomb else t.tt) - 1),
        wall_mu=float(friction_on_wall(t)[-1]),
        exponent=float(np.mean(exponent)),
        exponent_spread=float(np.ptp(exponent)),
        coupling_radial=velocity_coupling(solution, radial_only=True),
        coupling=velocity_coupling(solution, radial_only=False),
        psi_max=solution.psi_maximum()[1],
    )


def _largest(values: Numbers) -> float:
    return float(np.abs(values).max())
