"""Yield conditions in Sokolovskii variables, and the law of sliding friction at the wall.

With sigma the average stress, psi the Sokolovskii angle and s = sin(delta), both of the paper's
models, (3.1) and (3.2), read

    T_rr = sigma (1 - radial s cos 2psi)        T_rt = -sigma s sin 2psi
    T_tt = sigma (1 + angular s cos 2psi)       T_pp = sigma (1 + hoop s + hoop_cosine s cos 2psi)

and differ only in the four numbers of :class:`YieldCondition`.
"""

from dataclasses import dataclass
from math import asin, atan, cos, degrees, pi, sin, sqrt, tan

from hopper.arguments import Radians, checked
from hopper.brief import brief
from hopper.errors import InvalidParameterError, WallFrictionError
from hopper.values import require_angle, shown

_ROUNDING = 1e-14


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
            largest = degrees(self.largest_friction_angle(delta))
            raise WallFrictionError(
                f"wall friction angle phi = {degrees(friction_angle):.6g} deg has no wall angle: "
                f"a {self.name} material with delta = {degrees(delta):.6g} deg transmits at most "
                f"phi = {largest:.6g} deg; lower phi (or mu) or raise delta"
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
    """
    if not isinstance(name, str) or name not in _BY_NAME:
        raise InvalidParameterError(
            f"model = {shown(name)} is unknown: use {' or '.join(_BY_NAME)}"
        )
    return _BY_NAME[name]
