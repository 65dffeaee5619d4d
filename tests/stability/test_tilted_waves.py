"""Random data of both parities in wedges grow, in tilted time, at the supremum of Re(lambda)."""

import numpy as np
import pytest

from tests.stability.tilted_data import as_complex, name, radial, read
from tests.stability.tilted_waves import growth_rate, wave_operator

CASES = {name(case): case for case in read("tilted_reference") if case["geometry"] == "wedge"}
# Governed by the asymmetric pair, stable ones too; by an asymmetric real mode; by the symmetric
# pair near phi = delta. All beyond the tangency but the second and the fourth.
WEDGES = [
    "wedge-40.0-20.0-phi=25",
    "wedge-45.0-30.0-phi=15",
    "wedge-45.0-15.0-phi=30",
    "wedge-63.03-66.71-phi=4.86",
    "wedge-68.32-31.92-phi=46.95",
]


def supremum(case):
    modes = np.concatenate([as_complex(case["symmetric"]), as_complex(case["asymmetric"])])
    return max(case["line"], modes.real.max())


@pytest.mark.parametrize(
    "wedge",
    [*WEDGES[:2], WEDGES[4], *(pytest.param(WEDGES[i], marks=pytest.mark.soak) for i in (2, 3))],
)
def test_growth_of_random_data(wedge):
    case = CASES[wedge]
    rate, error = growth_rate(radial(case), settle=6, until=20)
    assert error < 0.02 * abs(rate)
    # 12 elements of degree 4 leave an error of the operator of up to 3e-4 (see below).
    assert rate == pytest.approx(supremum(case), abs=error + 5e-4)


@pytest.mark.parametrize("wedge", WEDGES)
def test_the_operator_has_no_modes_right_of_the_supremum(wedge):
    """Upwinding damps what the mesh does not resolve, so the abscissa itself converges."""
    case = CASES[wedge]
    coarse, fine = (
        np.linalg.eigvals(wave_operator(radial(case), n, 4)[0].toarray()).real.max()
        for n in (12, 24)
    )
    assert fine == pytest.approx(supremum(case), abs=abs(fine - coarse) + 1e-10)
    assert abs(fine - coarse) < 5e-4
