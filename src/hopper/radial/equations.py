"""The radial stress equations (2.8), (2.9) with (3.3), divided by sigma.

They are linear in d log(sigma)/d theta and d psi/d theta, and in tau = 1 / sigma_0, the strength of
gravity relative to the stress at the axis.
"""

from functools import lru_cache

import numpy as np

from hopper.arguments import Row, checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.problem import Hopper
from hopper.radial.grid import Grid
from hopper.values import require_equal_shapes

_NEAR_AXIS = 1e-7
# Terms of the radial equations over sigma, and what is computed from them. L is log sigma.
_TERMS = (
    "1", "versine cot", "cos", "sin", "cos cot", "sin cot", "cos L'", "sin L'", "cos psi'",
    "sin psi'", "L'", "down", "out",
)  # fmt: skip


@checked
def normal_weight(hopper: Hopper) -> float:
    """Return the coefficient of -sin(delta) cos(2 psi) in the radial equation.

    Without gravity psi = 0 solves that equation where sin(delta) times this, plus the hoop stress,
    is 1.
    """
    k, law = hopper.curvature, hopper.material
    return (2 + k) * law.radial + law.angular + k * law.hoop_cosine


@lru_cache(maxsize=256)
def _equations(hopper: Hopper) -> Array:
    """Return the coefficients of the terms, shape (8, len(_TERMS)); sin, cos are of 2 psi.

    The versine is 1 - cos. Rows: radial and angular equation; their derivatives by psi, slopes
    held; the factors of L' and psi' in the radial, and in the angular equation.
    """
    k, s, law = hopper.curvature, hopper.s, hopper.material
    # T_tt - T_pp over sigma is s (excess cos 2psi - hoop), and 0 on the axis: hoop is the excess.
    b, excess = law.angular, law.angular - law.hoop_cosine
    normal = s * normal_weight(hopper)
    rows: list[dict[str, float]] = [
        {"1": 1 - k * law.hoop * s, "cos": -normal, "sin cot": -k * s, "sin L'": -s,
         "cos psi'": -2 * s, "down": 1},
        {"sin": -(3 + k) * s, "versine cot": -k * s * excess, "L'": 1,
         "cos L'": b * s, "sin psi'": -2 * b * s, "out": -1},
        {"sin": 2 * normal, "cos cot": -2 * k * s, "cos L'": -2 * s, "sin psi'": 4 * s},
        {"cos": -2 * (3 + k) * s, "sin cot": -2 * k * s * excess, "sin L'": -2 * b * s,
         "cos psi'": -4 * b * s},
        {"sin": -s},
        {"cos": -2 * s},
        {"1": 1, "cos": b * s},
        {"sin": -2 * b * s},
    ]  # fmt: skip
    return np.array([[row.get(term, 0.0) for term in _TERMS] for row in rows])


def _terms(psi: Array, cot: Array, dlog: Array, dpsi: Array, down: Array, out: Array) -> Array:
    """Return the terms in their order, shape (len(_TERMS), n)."""
    double = 2 * psi
    terms = np.ones((len(_TERMS), psi.size))
    np.cos(double, out=terms[2])
    np.sin(double, out=terms[3])
    for row, factor in ((4, cot), (6, dlog), (8, dpsi)):
        np.multiply(terms[2:4], factor, out=terms[row : row + 2])
    # (1 - cos) cot without cancellation near the axis.
    terms[1] = terms[5] * terms[3] / (1 + terms[2])
    terms[10], terms[11], terms[12] = dlog, down, out
    return terms


@checked
def slopes(hopper: Hopper, theta: Row, sigma: Row, psi: Row) -> tuple[Array, Array]:
    """Return d log(sigma)/d theta and d psi/d theta that the equations prescribe, shape (n,)."""
    determinant, dlog, dpsi = flow(hopper, theta, sigma, psi)
    dlog, dpsi = dlog / determinant, dpsi / determinant
    near = np.abs(theta) < _NEAR_AXIS
    if near.any():
        # There cot(theta) sin(2 psi) is 2 psi' to second order, and its rounding is not.
        flat = np.zeros(int(near.sum()))
        light = np.cos(theta[near]) / sigma[near]
        terms = _terms(psi[near], flat, flat, flat, light, flat)
        dpsi[near] = _equations(hopper)[0] @ terms / (2 * hopper.s * (1 + hopper.curvature))
    return dlog, dpsi


@checked
def flow(hopper: Hopper, theta: Row, sigma: Row, psi: Row) -> tuple[Array, Array, Array]:
    """Return the common denominator of the slopes and the two numerators, each of shape (n,).

    As derivatives of (theta, log sigma, psi) they are regular where psi is singular.
    """
    require_equal_shapes(theta=theta, sigma=sigma, psi=psi)
    cot = np.divide(1.0, np.tan(theta), out=np.zeros_like(theta), where=theta != 0)
    flat = np.zeros_like(theta)
    terms = _terms(psi, cot, flat, flat, np.cos(theta) / sigma, np.sin(theta) / sigma)
    radial, angular, _, _, radial_l, radial_psi, angular_l, angular_psi = _equations(hopper) @ terms
    return (
        radial_l * angular_psi - radial_psi * angular_l,
        radial_psi * angular - angular_psi * radial,
        angular_l * radial - radial_l * angular,
    )


@checked
def residual_and_jacobian(hopper: Hopper, grid: Grid, u: Array) -> tuple[Array, Array]:
    """Return the residuals of the equations, shape (2 m + 1,), and their derivatives by ``u``.

    ``u`` = (log(sigma / sigma_0), psi, tau); the last rows are left to the closure.
    """
    m = grid.size
    if u.shape != (2 * m + 1,):
        raise InvalidParameterError(f"u has shape {u.shape}: it must be ({2 * m + 1},)")
    tau = u[-1]
    lightness = np.exp(-u[:m])
    down, out = lightness * grid.cos, lightness * grid.sin
    terms = _terms(
        u[m:-1], grid.cot, grid.d_even @ u[:m], grid.d_odd @ u[m:-1], tau * down, tau * out
    )
    rows = _equations(hopper) @ terms

    residual = np.zeros(2 * m + 1)
    residual[:-1] = rows[:2].reshape(-1)

    jacobian = np.zeros((2 * m + 1, 2 * m + 1))
    for block, factors in ((slice(0, m), rows[4:6]), (slice(m, 2 * m), rows[6:8])):
        np.multiply(factors[0][:, None], grid.d_even, out=jacobian[block, :m])
        np.multiply(factors[1][:, None], grid.d_odd, out=jacobian[block, m:-1])
    # Diagonals of the four blocks as strided views: adding to them needs no index arrays.
    step, flat, half = 2 * m + 2, jacobian.reshape(-1), m * (2 * m + 1)
    flat[:half:step] -= terms[11]
    flat[m:half:step] += rows[2]
    flat[half : 2 * half : step] += terms[12]
    flat[half + m : 2 * half : step] += rows[3]
    jacobian[:m, -1] = down
    jacobian[m:-1, -1] = -out
    return residual, jacobian
