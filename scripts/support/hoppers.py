"""From the configuration's hoppers, in degrees, to the numerics', in radians."""

from math import atan, radians

from hopper.problem import Hopper, as_geometry
from hopper.radial.solution import RadialSolution, solve_radial


def mohr_coulomb(geometry: str, delta_deg: float, half_angle_deg: float) -> Hopper:
    """Return a hopper with a Mohr-Coulomb material."""
    return Hopper(as_geometry(geometry), radians(delta_deg), radians(half_angle_deg))


def radial_solution(
    geometry: str, delta_deg: float, half_angle_deg: float, mu: float
) -> RadialSolution:
    """Solve the radial equations of a Mohr-Coulomb hopper on the physical branch."""
    return solve_radial(mohr_coulomb(geometry, delta_deg, half_angle_deg), atan(mu))
