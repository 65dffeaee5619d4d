"""Coefficients of the von Mises equations linearised about a radial flow of a cone.

Off the radial flow T_thetatheta and T_phiphi differ. The yield surface (2.5') is a sphere, with a
third angle omega: with s = sin(delta), m = s / sqrt(3),

    T_rr = sigma (1 - 2 m cos omega cos 2psi)
    T_rt = -sigma s cos omega sin 2psi
    T_tt = sigma (1 + m cos omega cos 2psi + s sin omega)
    T_pp = sigma (1 + m cos omega cos 2psi - s sin omega)

Disturbances are relative to the radial flow, so that u0 drops out:

    sigma = r sigma0 (1 + S), psi = psi0 + Y, omega = Z
    v_r = -u0 (1 + U) / r**2, v_theta = -u0 W / r**2

With t = log r, c = cos 2psi0, q = sin 2psi0, l = sigma0' / sigma0, h = -u0' / u0 = sqrt(12) q / c,

    R = (1 - 2 m c) S + 4 m q Y      Q = -s q S - 2 s c Y      B = (1 + m c) S - 2 m q Y
    P = B + s Z                      Z = c / sqrt(12) (W' - (h + cot) W)

equations (2.8), (2.9), (2.10) and (2.14), with (2.13) as Z, are

    R_t + 3 R + Q' + (l + cot) Q - 2 B = 0
    Q_t + 4 Q + P' + l P + 2 s cot Z = 0
    U_t + W' + (cot - h) W = 0
    W_t - 3 W + U' - sqrt(3) q / c U_t + 4 sqrt(3) / c**2 Y = 0

S, Z, U are even in theta, Y, W odd. At the wall W = 0 and, by (2.15), Y = s q Z / (2 (c + m)).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import sqrt

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError, SingularVelocityError
from hopper.radial.grid import Grid
from hopper.radial.solution import RadialSolution
from hopper.yield_conditions import VON_MISES


@dataclass(frozen=True)
class Coefficients:
    """The radial flow at n angles: what the linearised equations need, arrays of shape (n,).

    Attributes
    ----------
    s, m : float
        sin(delta) and s / sqrt(3).
    cot, c, q : array
        cot(theta), cos(2 psi) and sin(2 psi).
    l, h : array
        Slope of log sigma, and minus the slope of log u.
    """

    s: float
    m: float
    cot: Array
    c: Array
    q: Array
    l: Array  # noqa: E741
    h: Array

    __repr__ = brief("s", "c", "q", "l", "h")

    @cached_property
    def tilt(self) -> Array:
        """Minus the mean slope dt/dtheta of the four characteristics, sqrt(3) q / (2 c)."""
        return sqrt(3) / 2 * self.q / self.c

    @cached_property
    def stress_rate(self) -> Array:
        """Factors of lambda S and lambda Y in the momentum equations in tilted time, (4, n).

        The first two are those of R + a Q, the others those of Q + a P less what F_T holds.
        """
        s, m, c, q, a = self.s, self.m, self.c, self.q, self.tilt
        return np.array([
            1 - 2 * m * c - a * s * q,
            4 * m * q - 2 * a * s * c,
            a * (1 + m * c) - s * q,
            -2 * (s * c + a * m * q + s * a**2 / (c * (1 + a**2))),
        ])  # fmt: skip

    @property
    def cancellation(self) -> float:
        """Largest factor by which the determinant of ``stress_rate`` loses digits: at its zeros."""
        rs, ry, ts, ty = self.stress_rate
        return float(((np.abs(rs * ty) + np.abs(ry * ts)) / np.abs(rs * ty - ry * ts)).max())

    @property
    def wall(self) -> float:
        """K of the wall's law Y = k W' at the last point, from Y = s q Z / (2 (c + m))."""
        c, q = self.c[-1], self.q[-1]
        return float(self.m * q * c / (4 * (c + self.m)))


@checked
def coefficients(solution: RadialSolution, grids: Sequence[Grid]) -> list[Coefficients]:
    """Return the coefficients at the points of each of several half grids.

    Parameters
    ----------
    solution : RadialSolution
        Of a von Mises cone.
    grids : sequence of Grid
        Half grids of the hopper; evaluated together, as overhead is most of the cost.

    Raises
    ------
    InvalidParameterError
        If the material is not von Mises.
    SingularVelocityError
        If psi reaches pi/4 at a point: there is no radial flow.
    """
    hopper = solution.hopper
    if hopper.material != VON_MISES:
        raise InvalidParameterError(
            "stress and velocity are coupled in von Mises materials only: use model = von-mises"
        )
    sigma, psi, dsigma, _ = solution.fields_on(grids)
    c, q = np.cos(2 * psi), np.sin(2 * psi)
    if c.min() <= 0:
        first = int(np.argmax(c <= 0))
        theta = float(np.concatenate([grid.theta for grid in grids])[first])
        raise SingularVelocityError(
            f"no radial flow: psi = {np.degrees(psi[first]):.6g} deg exceeds 45 deg at theta = "
            f"{np.degrees(theta):.6g} deg; lower the wall friction",
            theta,
        )
    l, h = dsigma / sigma, sqrt(12) * q / c  # noqa: E741
    stops = np.cumsum([grid.size for grid in grids])
    return [
        Coefficients(
            hopper.s,
            hopper.s / sqrt(3),
            grid.cot,
            *(a[stop - grid.size : stop] for a in (c, q, l, h)),
        )
        for grid, stop in zip(grids, stops, strict=True)
    ]
