"""Modes of a von Mises cone that two fine meshes agree on, and what is known of high ones."""

from dataclasses import replace
from math import atan, radians

import numpy as np

from hopper_workflow import artifacts, jobs
from hopper.errors import ConvergenceError
from hopper.problem import Geometry, Hopper
from hopper.radial.solution import RadialSolution, solve_radial
from hopper.von_mises.characteristics import EquationType, equation_type
from hopper.von_mises.high_frequency import high_frequency
from hopper.von_mises.modes import modes_on
from hopper.von_mises.strips import rays, strips
from hopper.yield_conditions import VON_MISES
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.stability import COUPLED_FLAGS, eigenvalues
from hopper_data.tables import complex_number, number, within


def compute_von_mises_spectrum(
    *, geometry: Geometry, delta_deg: float, half_angle_deg: float, mu: float, half_nodes: int
) -> CfDataset:
    """Compare a mesh with the one before, and resolved modes with the law of high frequency."""
    hopper = Hopper(geometry, radians(delta_deg), radians(half_angle_deg), VON_MISES)
    solution = solve_radial(hopper, atan(mu))
    kind, modes = equation_type(solution), modes_on(solution, half_nodes)
    if not modes.eigenvalues.size:
        raise ConvergenceError(f"no mode is resolved at mu = {mu:g}: lower the wall friction")
    result = {"modes": modes, "kind": kind, **_law(solution, kind, modes.eigenvalues)}
    return dataset(result, TABLE)


def _law(solution: RadialSolution, kind: EquationType, modes: np.ndarray) -> dict[str, object]:
    """Return strips or rays, and the root of the law next to each mode; nothing if mixed."""
    if kind.kind not in ("elliptic", "hyperbolic"):
        return {"ring_spacing": kind.ring_spacing}
    law = high_frequency(solution)
    roots = np.full(modes.size, np.nan + 0j)
    roots[modes.imag > 0] = law.nearest_roots(modes[modes.imag > 0])
    lie = {"rays": rays(law)} if kind.kind == "elliptic" else {"strips": strips(law)}
    return {"roots": roots, **lie}


TABLE = (
    *within("modes", eigenvalues("coupled")),
    complex_number("root", "root of the law of high frequency next to it", "mode", "roots"),
    replace(COUPLED_FLAGS[0], source="kind.kind"),
    number("strips", "edges of the strips of Re(lambda)", "strip edge", "strips.intervals"),
    complex_number("ray_start", "start of a ray of modes", "ray", "rays.start"),
    complex_number("ray_step", "step from mode to mode along it", "ray", "rays.step"),
    number("ring_spacing", "mean spacing of ring modes in Im(lambda)"),
)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_von_mises_spectrum, "Modes of a von Mises cone", "(2.8)-(2.15), linearised"
        )
    )
