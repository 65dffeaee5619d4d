"""The smallest outlet over which a cohesive material forms no arch, by Jenike's method.

An arch stands where the strength f_c of the material exceeds the stress sigma_1 / ff in its
abutment, ff the flow factor of the hopper. The two are equal at the critical stress f_crit, and the
outlet must be wider than B = H f_crit / (rho g), the diameter of a cone or the width of a wedge.

References
----------
A. W. Jenike, Storage and flow of solids, Bulletin 123, Utah Eng. Exp. Station (1964).
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from hopper.arguments import Positive, RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.problem import Hopper
from hopper.quantity import Quantity
from hopper.radial.flow_factor import geometry_factor

# Standard gravity, m/s^2.
GRAVITY = 9.80665
_KILO = 1e3


@dataclass(frozen=True)
class FlowFunction:
    """Strength f_c (kPa) of a material over the major stress sigma_1 (kPa) that consolidated it.

    Straight between points, and beyond the last one where ``slope`` is given.

    Attributes
    ----------
    major, strength : array, shape (n,)
        Points by increasing sigma_1.
    slope : float or None
        Of f_c beyond the last point; None where nothing is known there.
    """

    major: Array
    strength: Array
    slope: float | None = None

    __repr__ = brief("major", "strength", "slope")


@checked
def flow_function(major: RealRow, strength: RealRow, slope: float | None = None) -> FlowFunction:
    """Return a flow function through points (kPa), with the slope beyond them where that is known.

    Raises
    ------
    InvalidParameterError
        If they are not as many stresses of 0 or more, or sigma_1 does not increase.
    """
    x, y = np.asarray(major, dtype=float), np.asarray(strength, dtype=float)
    if x.size != y.size or not x.size:
        raise InvalidParameterError(
            "major and strength differ in length or are empty: give one f_c for each sigma_1"
        )
    for name, values in (("major", x), ("strength", y)):
        if values.min() < 0:
            raise InvalidParameterError(f"{name} has negative stresses: give 0 kPa or more")
    if np.any(np.diff(x) <= 0):
        raise InvalidParameterError("major must increase: sort the points, each sigma_1 once")
    return FlowFunction(x, y, slope)


@checked
def linear_flow_function(intercept: float, slope: float = 0.0) -> FlowFunction:
    """Return f_c = intercept + slope sigma_1, in kPa.

    Raises
    ------
    InvalidParameterError
        If the intercept is negative.
    """
    return flow_function([0.0], [intercept], slope)


@checked
def critical_stress(function: FlowFunction, factor: Positive) -> float:
    """Return f_crit (kPa), where f_c = sigma_1 / ff for the last time.

    Raises
    ------
    InvalidParameterError
        If they are nowhere equal; the message says which of both is larger.

    Examples
    --------
    >>> from hopper.design.outlet import critical_stress, linear_flow_function
    >>> critical_stress(linear_flow_function(intercept=1.0, slope=0.3), factor=2.0)
    2.5
    """
    major, strength = function.major, function.strength
    excess = strength - major / factor
    if excess[-1] > 0:
        steeper = inf if function.slope is None else function.slope
        fall = 1 / factor - steeper
        if not 0 < fall < inf:
            raise InvalidParameterError(
                f"the strength exceeds sigma_1 / ff at all stresses of the flow function, "
                f"ff = {factor:.4g}: no outlet keeps an arch from forming"
            )
        return float((major[-1] + excess[-1] / fall) / factor)
    above = np.flatnonzero(excess > 0)
    if not above.size:
        if excess[0] == 0:
            return float(strength[0])
        raise InvalidParameterError(
            f"the strength is below sigma_1 / ff at all stresses of the flow function, "
            f"ff = {factor:.4g}: give points at smaller sigma_1"
        )
    last = int(above[-1])
    pair = excess[last : last + 2]
    at = major[last] + (major[last + 1] - major[last]) * pair[0] / (pair[0] - pair[1])
    return float(at / factor)


@dataclass(frozen=True)
class Outlet:
    """The critical stress f_crit (kPa) and the smallest outlet (m), a diameter or a width."""

    stress: Quantity
    width: Quantity

    __repr__ = brief("stress", "width")


@checked
def smallest_outlet(
    hopper: Hopper, factor: Quantity, function: FlowFunction, density: Positive
) -> Outlet:
    """Return the smallest outlet of a hopper of flow factor ``factor``; density in kg/m^3.

    Raises
    ------
    InvalidParameterError
        As :func:`critical_stress`.

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.design.outlet import linear_flow_function, smallest_outlet
    >>> from hopper.quantity import Quantity
    >>> cone, strength = Hopper("cone", delta=0.7, half_angle=0.35), linear_flow_function(1.0, 0.2)
    >>> round(smallest_outlet(cone, Quantity(1.5, 0.01), strength, density=1000).width.value, 3)
    0.34
    """
    stress = critical_stress(function, factor.value)
    # Of the flow factor: f_crit moves along the flow function.
    moved = critical_stress(function, factor.value + factor.error) - stress
    scale = geometry_factor(hopper) * _KILO / (density * GRAVITY)
    error = abs(moved) + 4 * float(np.finfo(float).eps) * stress
    return Outlet(Quantity(stress, error), Quantity(scale * stress, scale * error))
