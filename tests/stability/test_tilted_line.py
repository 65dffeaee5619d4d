"""The asymptotic line before, at and beyond the tangency, three ways."""

import numpy as np
import pytest

from tests.stability.tilted_data import ELSEWHERE, ELSEWHERE_NAMES, name, radial, read
from tests.stability.tilted_line import extrapolated, high_modes, line_along, line_by_quadrature
from tests.stability.tilted_witnesses import ASYMMETRIC, SYMMETRIC

REFERENCE = read("tilted_reference")


@pytest.mark.parametrize("case", REFERENCE, ids=name)
def test_quadrature_over_the_fields_and_along_the_shot_solution(case):
    solution = radial(case)
    line, spacing = line_by_quadrature(solution)
    tolerance = case["line_error"] + 10 * solution.error_estimate * abs(line)
    assert line == pytest.approx(case["line"], abs=tolerance)
    assert spacing == pytest.approx(case["spacing"], rel=1e-12 + 10 * solution.error_estimate)


@pytest.mark.parametrize(("case", "parity", "modes"), ELSEWHERE[:6], ids=ELSEWHERE_NAMES[:6])
def test_lines_computed_elsewhere(case, parity, modes):
    line = line_along(radial(case))[0]
    assert line == pytest.approx(case["line"], rel=case["tolerance_relative"])


# Printed digits of the page for hoppers before the tangency, by another formula.
@pytest.mark.parametrize(
    ("geometry", "delta", "half_angle", "mu", "line"),
    [
        ("wedge", 35, 10, 0, 0.6549139210),
        ("cone", 35, 10, 0, -0.2025704150),
        ("wedge", 38, 17, 0.12, 0.1066787151),
        ("cone", 38, 17, 0.12, -2.0201385323),
    ],
)
def test_line_before_the_tangency(geometry, delta, half_angle, mu, line):
    case = {"geometry": geometry, "delta_deg": delta, "half_angle_deg": half_angle, "mu": mu}
    assert line_by_quadrature(radial(case))[0] == pytest.approx(line, abs=6e-11)


BEYOND = [
    ("wedge-40.0-20.0-phi=25", SYMMETRIC, (4, 6, 9)),
    ("wedge-40.0-20.0-phi=25", ASYMMETRIC, (4, 6, 9)),
    ("wedge-30.0-30.0-phi=20", SYMMETRIC, (4, 6, 9)),
    ("cone-50.0-15.0-phi=20", SYMMETRIC, (6, 9, 13)),
]
# A thin layer at the axis, and a wall nearly as rough as the material, delay the limit.
SLOW = [
    ("cone-30.0-10.0-phi=25", SYMMETRIC, (20, 30, 45)),
    ("cone-35.0-10.0-phi=28", SYMMETRIC, (20, 30, 45)),
    ("cone-45.0-20.0-phi=24", SYMMETRIC, (30, 45, 60)),
    ("wedge-45.0-10.0-phi=42", ASYMMETRIC, (20, 30, 45)),
]
SLOW_PARAMS = [pytest.param(*entry, marks=pytest.mark.soak) for entry in SLOW]


@pytest.mark.parametrize(("hopper", "parity", "numbers"), [*BEYOND, *SLOW_PARAMS])
def test_line_is_the_limit_of_modes_as_one_over_the_square(hopper, parity, numbers):
    case = next(case for case in REFERENCE if name(case) == hopper)
    solution, line = radial(case), case["line"]
    modes = high_modes(solution, numbers, parity)
    limit, error = extrapolated(modes)
    assert limit == pytest.approx(line, abs=error + 1e-10)
    assert error < 1e-3 * max(1, abs(line))
    # (Re lambda - Lambda) Im**2 tends to a constant: the order is two.
    lower, upper = (modes.real[1:] - line) * modes.imag[1:] ** 2
    order = 2 - np.log(abs(upper / lower)) / np.log(modes.imag[2] / modes.imag[1])
    assert order == pytest.approx(2, abs=0.1)
