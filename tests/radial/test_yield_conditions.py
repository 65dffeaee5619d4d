"""No formula of one yield condition serves the other without a word."""

from math import radians

import pytest

from hopper import Hopper, linear_stability, mass_flow_half_angle, solve_radial
from hopper.domain.borders import tangency_friction
from hopper.errors import InvalidParameterError
from hopper.evidence.printed import linearised
from hopper.evidence.smooth_operator import operator_matrix
from hopper.radial.mass_flow import mass_flow_friction_angle
from hopper.stability.tilted import first_tangency
from hopper.yield_conditions import VON_MISES

HOPPER = Hopper("cone", radians(40), radians(20), VON_MISES)
SOLUTION = solve_radial(HOPPER, radians(10))


@pytest.mark.parametrize(
    ("function", "arguments"),
    [
        (linear_stability, (SOLUTION,)),
        (first_tangency, (SOLUTION,)),
        (linearised, (SOLUTION, SOLUTION.theta)),
        (tangency_friction, (HOPPER,)),
        (operator_matrix, (HOPPER, 8)),
        (mass_flow_half_angle, (HOPPER, 0.1)),
        (mass_flow_friction_angle, (HOPPER,)),
    ],
)
def test_formulas_of_mohr_coulomb_materials_refuse_others(function, arguments):
    with pytest.raises(InvalidParameterError, match=r"[Mm]ohr-[Cc]oulomb"):
        function(*arguments)
