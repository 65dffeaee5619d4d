"""A staggered Chebyshev discretisation of the stability problem in tilted time.

In t' = t + h(theta), h' = s2 / (s + c2), N loses its diagonal and u_t' + J (u_theta + K u) = 0 with
J = (N + h' I)^-1 couples sigma1 to the slope of psi1 and the reverse. So sigma1 stands on the 2 m
points of the first kind, psi1 on the 2 m + 1 of the second, walls included, and each slope is taken
where the other field stands. No field has a grid mode: each polynomial has all its points. Parity
leaves m points of sigma1, and m - 1 (symmetric) or m (asymmetric, with the axis) of psi1.
"""

import numpy as np
from numpy.polynomial import chebyshev

from hopper.radial.solution import RadialSolution
from tests.stability.tilted_equations import compiled
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC


def coefficients(solution: RadialSolution, theta):
    """Return N and K at ``theta`` from the package's fields, each of shape (2, 2, n)."""
    f, s = compiled(solution.hopper.curvature), solution.hopper.s
    sigma, psi = solution.fields(theta)[:2]
    entries = np.array([f(s, *at)[2:] for at in zip(theta, sigma, psi, strict=True)])
    return tuple(np.moveaxis(entries.reshape(-1, 2, 2, 2), 0, -1))


def _transfer(source, degrees, target):
    """Return matrices from values at ``source`` to values and slopes at ``target``."""
    unit = np.eye(degrees[-1] + 1)[:, degrees]
    values = np.linalg.inv(chebyshev.chebval(source, unit).T)
    slopes = chebyshev.chebder(unit)
    return chebyshev.chebval(target, unit).T @ values, chebyshev.chebval(target, slopes).T @ values


def staggered_matrix(solution: RadialSolution, m: int, parity=SYMMETRIC):
    """Return the matrix whose eigenvalues are those of exp(-lambda t) modes of one parity."""
    assert parity == SYMMETRIC or solution.hopper.geometry == "wedge"
    first = np.cos(np.pi * (np.arange(m) + 0.5) / (2 * m))
    second = np.cos(np.pi * np.arange(m + 1) / (2 * m))
    if parity == ASYMMETRIC:
        sigma_degrees, psi_degrees = np.arange(1, 2 * m, 2), np.arange(0, 2 * m + 1, 2)
    else:
        second = second[:-1]
        sigma_degrees, psi_degrees = np.arange(0, 2 * m, 2), np.arange(1, 2 * m, 2)
    half_angle = solution.hopper.half_angle
    # psi1 vanishes at the wall, the first of the points of the second kind.
    psi_at, psi_slope = (a[:, 1:] for a in _transfer(second, psi_degrees, first))
    second = second[1:]
    sigma_at, sigma_slope = _transfer(first, sigma_degrees, second)
    n, k = coefficients(solution, half_angle * first)
    above = (psi_slope / half_angle + k[1, 1][:, None] * psi_at) / n[1, 0][:, None]
    sigma_block = np.diag(k[1, 0] / n[1, 0])
    n, k = coefficients(solution, half_angle * second)
    below = (sigma_slope / half_angle + k[0, 0][:, None] * sigma_at) / n[0, 1][:, None]
    return np.block([[sigma_block, above], [below, np.diag(k[0, 1] / n[0, 1])]])


def staggered_modes(solution: RadialSolution, m: int, parity=SYMMETRIC):
    """Return the eigenvalues with Im >= 0 by increasing modulus."""
    values = np.linalg.eigvals(staggered_matrix(solution, m, parity)).astype(complex)
    values = values[values.imag > -1e-12 * np.abs(values)]
    return values[np.argsort(np.abs(values), kind="stable")]
