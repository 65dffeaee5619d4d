"""Smooth-wall theory: abscissae over delta, neutral angles, and cone eigenvalues three ways."""

from math import radians

import numpy as np

from hopper_workflow import artifacts, jobs, ranges
from hopper.problem import Geometry
from hopper.stability import smooth_wall
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import angle, in_degrees, number, text


def compute_smooth_wall(
    *, delta_deg: dict[str, float], half_angles_deg: dict[str, float], modes: int
) -> CfDataset:
    """Tabulate the theory over delta (Figure 4.1) and over the half angle (cone variants)."""
    delta, angles = ranges.steps(**delta_deg), ranges.steps(**half_angles_deg)
    crossing = smooth_wall.crossing_delta()
    result = {
        "abscissa": [smooth_wall.abscissa(shape, np.radians(delta)) for shape in _GEOMETRIES],
        "neutral_delta": [smooth_wall.neutral_delta(shape) for shape in _GEOMETRIES],
        "crossing_delta": crossing,
        "crossing_abscissa": float(smooth_wall.abscissa("wedge", crossing)),
        "wavenumber": [
            [smooth_wall.cone_wavenumbers(radians(angle), modes, variant) for angle in angles]
            for variant in smooth_wall.CONE_VARIANTS
        ],
        "threshold": smooth_wall.oscillation_threshold(np.radians(angles)),
        "largest_half_angle": smooth_wall.largest_distinct_half_angle(),
        "geometry": list(_GEOMETRIES),
        "variant": list(smooth_wall.CONE_VARIANTS),
        "delta": delta,
        "half_angle": angles,
        "n": np.arange(1, modes + 1),
    }
    return dataset(result, TABLE, AXES)


_GEOMETRIES: tuple[Geometry, ...] = ("wedge", "cone")
TABLE = (
    number("abscissa", "abscissa of the line of eigenvalues", "geometry delta"),
    angle("neutral_delta", "angle of internal friction of neutral stability", "geometry"),
    angle("crossing_delta", "delta of equal abscissae"),
    number("crossing_abscissa", "abscissa at the crossing"),
    number("wavenumber", "mu_n of the cone", "variant half_angle n"),
    number("threshold", "f(theta_w), the least sin(delta) with a real eigenvalue", "half_angle"),
    angle("largest_half_angle", "half angle below which mu_1 > 2"),
)
AXES = (
    text("geometry", "shape of the hopper", "geometry"),
    text("variant", "equation for mu_n", "variant"),
    in_degrees("delta", "angle of internal friction", "delta"),
    in_degrees("half_angle", "half opening angle", "half_angle"),
    number("n", "number of the mode", "n"),
)

if __name__ == "__main__":
    jobs.run(artifacts.writing(compute_smooth_wall, "Smooth-wall theory", "(4.3)-(4.10)"))
