"""Yield conditions in Sokolovskii variables, and the law of sliding friction at the wall.

With sigma the average stress, psi the Sokolovskii angle and s = sin(delta), both of the paper's
models, (3.1) and (3.2), read

    T_rr = sigma (1 - radial s cos 2psi)        T_rt = -sigma s sin 2psi
    T_tt = sigma (1 + angular s cos 2psi)       T_pp = sigma (1 + hoop s + hoop_cosine s cos 2psi)

and differ only in the four numbers of :class:`YieldCondition`. Nothing elsewhere may assume more of
a yield condition than these formulas say: principal stresses in particular come from here.
"""

from dataclasses import dataclass
from math import asin, atan, cos, degrees, pi, sin, sqrt, tan
from sys import float_info

import numpy as np

from hopper.arguments import Radians, Row, checked
from hopper.arrays import Array
from hopper.brief import apart, brief
from hopper.errors import InvalidParameterError, WallFrictionError
from hopper.values import require_angle, require_equal_shapes, shown

_ROUNDING = 1e-14
_EPS = float_info.epsilon


@dataclass(frozen=True)
class YieldCondition:
    """A yield condition with its flow rule; see the module's formulas for the fields."""

    name: str
    radial: float
    angular: float
    hoop: float
    hoop_cosine: float

    __repr__ = brief("name")

    @checked
    def wall_angle(self, delta: Radians, friction_angle: Radians) -> float:
        """Return psi_w (radians) of a wall of the given friction angle (radians).

        Solves T_rt = -tan(phi) T_tt, (2.15), on the branch of smaller psi.

        Raises
        ------
        InvalidParameterError
            If an angle is out of range.
        WallFrictionError
            If no angle satisfies the wall law.
        """
        require_angle("delta", delta)
        require_angle("friction_angle", friction_angle, zero_allowed=True)
        inclination = atan(self.angular * tan(friction_angle))
        ratio = sin(inclination) / (self.angular * sin(delta))
        if ratio > 1 + _ROUNDING:
            phi, largest = apart(
                degrees(friction_angle), degrees(self.largest_friction_angle(delta))
            )
            raise WallFrictionError(
                f"wall friction angle phi = {phi} deg has no wall angle: "
                f"a {self.name} material with delta = {degrees(delta):.6g} deg transmits at most "
                f"phi = {largest} deg; lower phi (or mu) or raise delta"
            )
        return 0.5 * (inclination + asin(min(ratio, 1.0)))

    @checked
    def friction_angle(self, delta: Radians, psi: Radians) -> float:
        """Return phi (radians) of the wall on which the Sokolovskii angle is ``psi`` (radians).

        Raises
        ------
        InvalidParameterError
            If an angle is out of range.
        """
        require_angle("delta", delta)
        if not abs(psi) <= pi:
            raise InvalidParameterError(
                f"psi = {degrees(psi):.6g} deg is out of range: it must lie in [-180, 180] deg"
            )
        s = sin(delta)
        return atan(s * sin(2 * psi) / (1 + self.angular * s * cos(2 * psi)))

    @checked
    def wall_angle_rounding(self, delta: float, psi: float) -> float:
        """Return the rounding error of psi_w as :meth:`wall_angle` computes it, radians.

        Towards the largest friction d phi / d psi vanishes and the error of psi grows.
        """
        phi = abs(self.friction_angle(delta, psi))
        s, c2, s2 = sin(delta), cos(2 * psi), sin(2 * psi)
        pressure = 1 + self.angular * s * c2
        slope = 2 * s * abs(c2 + self.angular * s) / (pressure**2 + (s * s2) ** 2)
        return 4 * _EPS * (abs(psi) + phi / max(slope, sqrt(_EPS)))

    @checked
    def largest_friction_angle(self, delta: Radians) -> float:
        """Return the largest phi (radians) for which :meth:`wall_angle` exists.

        Raises
        ------
        InvalidParameterError
            If an angle is out of range.
        """
        require_angle("delta", delta)
        return atan(tan(asin(self.angular * sin(delta))) / self.angular)

    @checked
    def singular_angle(self, delta: Radians) -> float:
        """Return the psi (radians) at which the radial stress equations become singular.

        There the coefficient of (sigma', psi'), 2 s (angular s + cos 2psi), vanishes.

        Raises
        ------
        InvalidParameterError
            If an angle is out of range.
        """
        require_angle("delta", delta)
        return asin(self.angular * sin(delta)) / 2 + asin(1) / 2

    @checked
    def principal_stresses(self, delta: Radians, sigma: Row, psi: Row) -> tuple[Array, Array]:
        """Return the major and the minor principal stress in the plane of r and theta, shape (n,).

        In units of sigma. The stress T_pp across that plane lies between them.

        Raises
        ------
        InvalidParameterError
            If delta is out of range, or sigma and psi differ in shape.
        """
        require_angle("delta", delta)
        require_equal_shapes(sigma=sigma, psi=psi)
        s, cosine, sine = sin(delta), np.cos(2 * psi), np.sin(2 * psi)
        mean = 1 + (self.angular - self.radial) / 2 * s * cosine
        radius = s * np.hypot((self.angular + self.radial) / 2 * cosine, sine)
        return sigma * (mean + radius), sigma * (mean - radius)


MOHR_COULOMB = YieldCondition("Mohr-Coulomb", radial=1, angular=1, hoop=1, hoop_cosine=0)
VON_MISES = YieldCondition(
    "von Mises", radial=2 / sqrt(3), angular=1 / sqrt(3), hoop=0, hoop_cosine=1 / sqrt(3)
)

_BY_NAME = {"mohr-coulomb": MOHR_COULOMB, "von-mises": VON_MISES}


def yield_condition(name: str) -> YieldCondition:
    """Return the condition called ``mohr-coulomb`` or ``von-mises``.

    Raises
    ------
    InvalidParameterError
        If the name is neither.

    Examples
    --------
    >>> from hopper import Hopper, yield_condition
    >>> Hopper("cone", 0.7, 0.35, yield_condition("von-mises"))
    Hopper(cone, delta=40.107 deg, half_angle=20.0535 deg, von Mises)
    """
    if not isinstance(name, str) or name not in _BY_NAME:
        raise InvalidParameterError(
            f"model = {shown(name)} is unknown: use {' or '.join(_BY_NAME)}"
        )
    return _BY_NAME[name]
