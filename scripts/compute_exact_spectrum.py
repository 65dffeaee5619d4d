"""Exact smooth-wall eigenvalues of a hopper, the crosses of Figure 4.2."""

from math import radians

import numpy as np

from hopper_workflow import artifacts, jobs
from hopper.stability.smooth_wall import cone_eigenvalues, cone_wavenumbers, wedge_eigenvalues
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.tables import complex_number, flag


def compute_exact_spectrum(
    *, geometry: str, delta_deg: float, half_angle_deg: float, modes: int
) -> CfDataset:
    """Evaluate (4.7) for a wedge, (4.9) with Bessel and exact wavenumbers for a cone."""
    delta, half_angle = radians(delta_deg), radians(half_angle_deg)
    kinds: tuple[str, ...]
    if geometry == "wedge":
        kinds, families = ("sine", "cosine"), wedge_eigenvalues(delta, half_angle, modes)
    else:
        kinds, families = (
            ("bessel", "legendre"),
            (
                cone_eigenvalues(delta, cone_wavenumbers(half_angle, modes, "bessel")),
                cone_eigenvalues(delta, cone_wavenumbers(half_angle, modes, "legendre")),
            ),
        )
    result = {
        "eigenvalue": np.concatenate(families),
        "kind": np.repeat(kinds, [family.size for family in families]),
    }
    table = (
        complex_number("eigenvalue", "smooth-wall eigenvalue", "mode"),
        flag("kind", "family or equation", kinds, "mode"),
    )
    return dataset(result, table)


if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_exact_spectrum,
            "Exact smooth-wall eigenvalues, {geometry}",
            "(4.7), (4.8), (4.9)",
        )
    )
