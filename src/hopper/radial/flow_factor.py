"""Jenike's flow factor: the consolidating stress over the stress that a stable arch carries."""

from math import degrees, sin

import numpy as np

from hopper.arguments import checked
from hopper.problem import Hopper
from hopper.radial.solution import RadialSolution


@checked
def geometry_factor(hopper: Hopper) -> float:
    """Return Jenike's H(theta_w): 2 + theta_w / 60 deg (cone) or 1 + theta_w / 180 deg (wedge).

    Examples
    --------
    >>> from hopper import Hopper
    >>> from hopper.radial.flow_factor import geometry_factor
    >>> round(geometry_factor(Hopper("cone", delta=0.7, half_angle=0.35)), 4)
    2.3342
    """
    angle = degrees(hopper.half_angle)
    return 2 + angle / 60 if hopper.geometry == "cone" else 1 + angle / 180


@checked
def flow_factor(solution: RadialSolution) -> float:
    """Return ff = H sigma_1(theta_w) / (2 sin theta_w), sigma_1 the major principal stress.

    For Mohr-Coulomb materials sigma_1 = (1 + sin delta) sigma. H is :func:`geometry_factor`.

    References
    ----------
    A. W. Jenike, Storage and flow of solids, Bulletin 123, Utah Eng. Exp. Station (1964).

    Examples
    --------
    >>> from hopper import Hopper, flow_factor, solve_radial
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> round(flow_factor(solution), 4)
    1.4503
    """
    hopper = solution.hopper
    major, _ = hopper.material.principal_stresses(
        hopper.delta, np.array([solution.sigma_wall]), np.array([solution.psi_wall])
    )
    return geometry_factor(hopper) * float(major[0]) / (2 * sin(hopper.half_angle))
