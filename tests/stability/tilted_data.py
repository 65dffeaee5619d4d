"""Reference values of the tilted problem, from tests/data.

``spectra_beyond_tangency``, ``spectra_asymmetric`` and ``neutral_points`` were computed elsewhere,
by shooting and collocation; ``tilted_reference`` by :mod:`tests.stability.tilted_reference`.
"""

import json
from math import atan, radians
from pathlib import Path

import numpy as np

from hopper.problem import Hopper
from hopper.radial.solution import RadialSolution, solve_radial, solve_radial_family
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC

DATA = Path(__file__).parents[1] / "data"


def read(name, key="sets"):
    """Return a list of a file."""
    return json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))[key]


def radial(case) -> RadialSolution:
    """Return the package's radial solution of an entry (degrees; mu or phi, or beyond the fold)."""
    hopper = Hopper(case["geometry"], radians(case["delta_deg"]), radians(case["half_angle_deg"]))
    if case.get("branch") == "second":
        return solve_radial_family(hopper, case["sigma_axis"])
    return solve_radial(hopper, atan(case["mu"]) if "mu" in case else radians(case["phi_deg"]))


def name(case) -> str:
    """Return a label of an entry."""
    wall = f"mu={case['mu']:.3g}" if "mu" in case else f"phi={case['phi_deg']:.4g}"
    return "-".join([case["geometry"], f"{case['delta_deg']}", f"{case['half_angle_deg']}", wall])


def as_complex(pairs):
    return np.array([complex(*pair) for pair in pairs])


# Entries of the two files computed elsewhere with their parity and modes.
ELSEWHERE = [
    (case, parity, as_complex(case["eigenvalues"]))
    for file, parity in (("spectra_beyond_tangency", SYMMETRIC), ("spectra_asymmetric", ASYMMETRIC))
    for case in read(file)
]
ELSEWHERE_NAMES = [f"{name(case)}-{parity}" for case, parity, _ in ELSEWHERE]
