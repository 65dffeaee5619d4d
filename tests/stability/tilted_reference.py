"""Write tests/data/tilted_reference.json: modes, lines, folds, corners, by shooting alone.

Run as ``python -m tests.stability.tilted_reference`` (a few minutes). From the package come only
starting values of sigma_0; it is then solved for anew on the shot radial solution.
"""

import json
from dataclasses import replace
from math import atan, cos, degrees, exp, log, radians, sin
from pathlib import Path

import numpy as np

from hopper.problem import Geometry, Hopper
from hopper.radial.solution import solve_radial
from tests.stability.tilted_folds import corner, fold, newton, wall_friction
from tests.stability.tilted_line import line_along
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC, Base, modes, shoot_all, to_wall

FILE = Path(__file__).parents[1] / "data" / "tilted_reference.json"
ABOUT = (
    "Modes exp(-lambda t), Im >= 0, by decreasing Re: all those with lowest_re < Re < 40 and Im up "
    "to highest_im, none left out (argument principle). Computed by shooting of the complex linear "
    "equations with DOP853 along the radial solution shot from sigma_axis; no collocation. Members "
    "of branch physical are given by phi_deg, those of branch second by sigma_axis. errors: of "
    "each mode, absolute: the change from rtol 1e-12 to 1e-13, the change by moving sigma_axis by "
    "its own error, and rounding. line: Lambda, integrated along; line_error likewise. folds: of "
    "cones, lambda = 0 is an eigenvalue. corners: folds with a double zero, where the border of "
    "the stable domain of cones turns from the neutral curve to the fold; the neutral curve of "
    "the complex pair ends there. Good to 1e-9 degrees, sigma_axis to 1e-8 of itself."
)


def tangent_wall(delta_deg):
    """phi (degrees) of the wall on which psi is that of tangency, pi/4 - delta/2."""
    delta = radians(delta_deg)
    return degrees(atan(sin(delta) * cos(delta) / (1 + sin(delta) ** 2)))


# Geometry, delta, half angle, phi (degrees).
WALLS: list[tuple[Geometry, float, float, float]] = [
    ("wedge", 35, 10, 0),
    ("wedge", 20, 5, 15),
    ("wedge", 25, 10, 10),
    ("wedge", 45, 10, 0),
    ("wedge", 38, 17, 7),
    ("wedge", 35, 10, tangent_wall(35)),
    ("wedge", 30, 30, 20),
    ("wedge", 40, 20, 25),
    ("wedge", 45, 30, 15),
    ("wedge", 45, 15, 30),
    ("wedge", 50, 40, 30),
    ("wedge", 60, 25, 45),
    ("wedge", 45, 10, 42),
    ("wedge", 63.03, 66.71, 4.86),
    ("wedge", 68.32, 31.92, 46.946),
    ("cone", 35, 10, 0),
    ("cone", 20, 20, 10),
    ("cone", 25, 10, 15),
    ("cone", 25, 30, 20),
    ("cone", 28, 30, 20),
    ("cone", 30, 10, 25),
    ("cone", 35, 10, tangent_wall(35)),
    ("cone", 35, 10, 28),
    ("cone", 35, 30, 18),
    ("cone", 40, 5, 30),
    ("cone", 45, 20, 24),
    ("cone", 50, 15, 20),
    ("cone", 60, 10, 30),
    ("cone", 30, 45, 9),
]
# Geometry, delta, half angle, sigma_0: beyond the fold.
MEMBERS: list[tuple[Geometry, float, float, float]] = [
    ("cone", 35, 30, 0.03),
    ("cone", 28, 30, 0.05),
    ("cone", 30, 10, 0.02),
]
# Cones: delta, half angle, sigma_0 nearby.
FOLDS = [
    (28, 30, 0.064),
    (30, 10, 0.027),
    (30, 30, 0.054),
    (30, 45, 0.07),
    (30, 45, 0.0136),
    (35, 10, 0.0143),
    (35, 30, 0.037),
    (40, 5, 0.0029),
    (40, 30, 0.026),
    (45, 10, 0.0037),
    (45, 20, 0.011),
    (45, 30, 0.019),
    (50, 20, 0.0071),
    (55, 10, 0.00016),
]
# Half angle, delta, sigma_0 nearby.
CORNERS = [
    (5, 29.1, 0.02),
    (10, 29.6, 0.029),
    (15, 30.2, 0.035),
    (20, 30.8, 0.04),
    (25, 31.3, 0.043),
    (30, 31.8, 0.047),
    (35, 32.3, 0.05),
    (40, 32.8, 0.054),
]


def folds():
    for delta, half_angle, sigma_axis in FOLDS:
        member = fold(Hopper("cone", radians(delta), radians(half_angle)), sigma_axis)
        yield {
            "delta_deg": delta,
            "half_angle_deg": half_angle,
            "phi_deg": degrees(wall_friction(member)),
            "sigma_axis": member.sigma_axis,
        }


def corners():
    for half_angle, near_delta, near_sigma in CORNERS:
        delta, phi, member = corner(half_angle, near_delta, near_sigma)
        yield {
            "half_angle_deg": half_angle,
            "delta_deg": delta,
            "phi_deg": phi,
            "sigma_axis": member.sigma_axis,
        }


def member_of_wall(hopper, phi_deg):
    """Return the Base with this wall, and the error of log sigma_0."""

    def excess(x):
        return np.array([wall_friction(Base(hopper, exp(x[0]))) - radians(phi_deg)])

    start = solve_radial(hopper, radians(phi_deg)).sigma_axis
    x, step = newton(excess, [log(start)])
    # Newton has converged; what is left is the rounding of phi, here through its slope.
    slope = float((excess(x + 1e-5) - excess(x - 1e-5))[0]) / 2e-5
    return Base(hopper, exp(x[0])), step + 1e-14 / abs(slope)


def all_modes(member, parity, lowest_re, highest):
    """Return the modes with Im between 0 and ``highest``; real ones exactly real."""
    # An eigenvalue may lie on the boundary: then a little lower.
    for lowest in (-0.31, -0.43, -0.59):
        try:
            found = modes(member, complex(lowest_re, lowest), complex(40, highest), parity)
        except AssertionError:
            continue
        found[np.abs(found.imag) < 1e-9] = found[np.abs(found.imag) < 1e-9].real
        found = found[found.imag >= 0]
        return found[np.lexsort([found.imag, -found.real.round(9)])]
    raise AssertionError(f"modes of {member} not separated")


def errors(member, found, parity, error_axis):
    """Return estimates of the errors of modes."""
    rough = shoot_all(member, found, parity, rtol=1e-12)
    shift = max(error_axis, 1e-9)
    moved = replace(member, sigma_axis=member.sigma_axis * exp(shift))
    slope = np.abs(shoot_all(moved, found, parity) - found) / shift
    rounding = 1e-13 * np.maximum(1, np.abs(found))
    return np.abs(rough - found) + slope * error_axis + rounding


def entry(member, phi_deg, error_axis):
    """Return one entry of the file."""
    hopper = member.hopper
    line, spacing = line_along(member)
    moved = replace(member, sigma_axis=member.sigma_axis * exp(1e-9))
    line_error = abs(line_along(moved)[0] - line) / 1e-9 * error_axis + 1e-12 * max(1, abs(line))
    lowest_re, highest = min(0, line) - 40, 3.3 * spacing
    result = {
        "geometry": hopper.geometry,
        "delta_deg": round(degrees(hopper.delta), 12),
        "half_angle_deg": round(degrees(hopper.half_angle), 12),
        "phi_deg": phi_deg,
        "sigma_axis": member.sigma_axis,
        "psi_wall_deg": degrees(to_wall(member, 0).psi),
        "line": line,
        "line_error": line_error,
        "spacing": spacing,
        "lowest_re": lowest_re,
        "highest_im": highest,
    }
    parities = [SYMMETRIC] if hopper.geometry == "cone" else [SYMMETRIC, ASYMMETRIC]
    for parity in parities:
        found = all_modes(member, parity, lowest_re, highest)
        result[parity] = [[mode.real, mode.imag] for mode in found]
        result[f"{parity}_errors"] = list(errors(member, found, parity, error_axis))
    return result


def entries():
    for geometry, delta, half_angle, phi in WALLS:
        hopper = Hopper(geometry, radians(delta), radians(half_angle))
        member, error_axis = member_of_wall(hopper, phi)
        yield {"branch": "physical", **entry(member, phi, error_axis)}
    for geometry, delta, half_angle, sigma_axis in MEMBERS:
        member = Base(Hopper(geometry, radians(delta), radians(half_angle)), sigma_axis)
        yield {"branch": "second", **entry(member, degrees(wall_friction(member)), 0.0)}


def main():
    content = {
        "about": ABOUT,
        "sets": list(entries()),
        "folds": list(folds()),
        "corners": list(corners()),
    }
    FILE.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
