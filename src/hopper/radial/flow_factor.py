"""Jenike's flow factor: the consolidating stress over the stress that a stable arch carries."""

from math import degrees, sin

import numpy as np

from hopper.arguments import checked
from hopper.radial.solution import RadialSolution


@checked
def flow_factor(solution: RadialSolution) -> float:
    """Return ff = H sigma_1(theta_w) / (2 sin theta_w), sigma_1 the major principal stress.

    For Mohr-Coulomb materials sigma_1 = (1 + sin delta) sigma. H is Jenike's geometry factor,
    2 + theta_w / 60 deg (cone) or 1 + theta_w / 180 deg (wedge).

    References
    ----------
    A. W. Jenike, Storage and flow of solids, Bulletin 123, Utah Eng. Exp. Station (1964).
    """
    hopper = solution.hopper
    angle = degrees(hopper.half_angle)
    h = 2 + angle / 60 if hopper.geometry == "cone" else 1 + angle / 180
    major, _ = hopper.material.principal_stresses(
        hopper.delta, np.array([solution.sigma_wall]), np.array([solution.psi_wall])
    )
    return h * float(major[0]) / (2 * sin(hopper.half_angle))
