"""Hoppers of one shape, and roots of the abscissa by the secant method."""

from math import exp, nan, radians, sin

import numpy as np
import pytest

from hopper import Hopper, friction_limit, linear_stability, solve_radial, solve_radial_family
from hopper.domain.growth import Hoppers, root, root_near
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.radial.friction_limit import fold_near
from hopper.radial.members import member_with_tau
from hopper.radial.solution import solution_of
from hopper.stability.asymptotic_line import asymptotic_line
from hopper.stability.modes import LinearStability
from tests.stability.tilted_chebyshev import staggered_modes
from tests.stability.tilted_data import read

FOLDS = read("tilted_reference", "folds")


def judged(result) -> LinearStability:
    assert isinstance(result, LinearStability), result
    return result


def test_stability_from_neighbour_to_neighbour():
    hoppers = Hoppers("wedge", radians(20))
    for delta, phi in ((40, 25), (40.5, 25), (41, 25.5), (30, 2)):
        found = judged(hoppers.at_wall(radians(delta), radians(phi)))
        single = linear_stability(
            solve_radial(Hopper("wedge", radians(delta), radians(20)), radians(phi))
        )
        assert found.abscissa == pytest.approx(single.abscissa, abs=1e-9)
        assert (found.governed_by, found.parity) == (single.governed_by, single.parity)
        assert hoppers.last is not None
        assert hoppers.last.hopper.delta == radians(delta)
    only = Hoppers("wedge", radians(20), "symmetric")
    assert list(judged(only.at_wall(radians(40), radians(25))).modes) == ["symmetric"]


def test_what_is_missing():
    hoppers = Hoppers("cone", radians(10))
    assert hoppers.at_wall(radians(30), radians(30.1)) == "no_wall_angle"
    assert hoppers.at_wall(radians(30), radians(29)) == "no_radial_solution"
    assert hoppers.at_wall(radians(8), 0.0) == "non_positive_stress"
    assert Hoppers("cone", radians(30)).at_wall(radians(25), radians(23.45)) == "not_converged"


def test_stability_by_the_stress_on_the_axis():
    """Beyond the fold too, where phi is of no use."""
    fold = friction_limit(Hopper("cone", radians(35), radians(30)))
    hoppers = Hoppers("cone", radians(30))
    judged(hoppers.at_wall(radians(35), radians(18.6)))
    before = judged(hoppers.with_tau(radians(35), fold.tau * exp(-0.05)))
    beyond = judged(hoppers.with_tau(radians(35), fold.tau * exp(0.05)))
    for found, shift in ((before, -0.05), (beyond, 0.05)):
        solution = solve_radial_family(
            Hopper("cone", radians(35), radians(30)), exp(-shift) / fold.tau
        )
        assert found.abscissa == pytest.approx(linear_stability(solution).abscissa, abs=1e-9)
    assert before.abscissa < 0 < beyond.abscissa
    assert beyond.governed_by == "real mode"


@pytest.mark.parametrize(
    "fold", FOLDS[:3], ids=lambda fold: f"{fold['delta_deg']}-{fold['half_angle_deg']}"
)
def test_fold_and_what_grows_there_besides_its_zero(fold):
    delta, half_angle = radians(fold["delta_deg"]), radians(fold["half_angle_deg"])
    hopper = Hopper("cone", delta, half_angle)
    start = member_with_tau(hopper, 0.97 / fold["sigma_axis"])
    member = fold_near(hopper, start)
    assert member is not None
    assert member.tau * fold["sigma_axis"] == pytest.approx(1, rel=1e-7)
    solution = solution_of(member)
    assert solution.friction_angle == pytest.approx(radians(fold["phi_deg"]), abs=1e-12)
    hoppers = Hoppers("cone", half_angle)
    hoppers.last = start
    modes = staggered_modes(solution, 100)
    zero = np.abs(modes).argmin()
    assert np.abs(modes[zero]) < 1e-6
    expected = max(np.delete(modes, zero)[:4].real.max(), asymptotic_line(solution).abscissa)
    assert hoppers.at_fold(delta) == pytest.approx(expected, abs=1e-5)


def test_no_fold_near():
    with pytest.raises(ConvergenceError, match="no fold near delta = 35 deg"):
        Hoppers("cone", radians(10)).at_fold(radians(35))


@pytest.mark.parametrize("half_angle", [0, -0.1, 2, nan])
def test_half_angles_out_of_range(half_angle):
    with pytest.raises(InvalidParameterError, match=r"half_angle = .* is out of range"):
        Hoppers("cone", half_angle)


def test_disturbances_that_are_none():
    with pytest.raises(InvalidParameterError, match="singular at the apex of a cone"):
        Hoppers("cone", 0.1, "any")
    with pytest.raises(InvalidParameterError, match="disturbances = 'all' is unknown"):
        Hoppers("wedge", 0.1, "all")  # type: ignore[arg-type]
    with pytest.raises(InvalidParameterError, match="geometry = 'pyramid' is unknown"):
        Hoppers("pyramid", 0.1)  # type: ignore[arg-type]


# Roots.


@pytest.mark.parametrize("slope", [None, 0.8, 1.3])
def test_roots(slope):
    found = root(lambda x: sin(x) + 0.1, 0.3, slope)
    assert found is not None
    assert found.at == pytest.approx(-np.arcsin(0.1), abs=1e-14)
    assert found.slope == pytest.approx(np.cos(0.1), abs=6e-3)


def test_roots_from_the_other_side_of_what_exists():
    def growth(x):
        if x < 0.5:
            raise ConvergenceError("no hopper here")
        return x * x - 0.2500001

    found = root(growth, 0.5)
    assert found is not None
    assert found.at == pytest.approx(0.2500001**0.5, abs=1e-12)


def test_no_root():
    assert root(lambda x: 1 + x * x, 0.3) is None
    assert root(lambda x: 1.0, 0.3) is None
    assert root_near(lambda x: "no_radial_solution", 0.3) is None

    def missing(x):
        raise ConvergenceError("nothing anywhere")

    assert root(missing, 0.3) is None


def test_root_of_the_abscissa():
    hoppers = Hoppers("cone", radians(10))
    found = root_near(lambda delta: hoppers.at_wall(delta, 0.0), radians(33))
    assert found is not None
    assert np.degrees(found.at) == pytest.approx(33.6739, abs=5e-5)
    assert found.slope < 0
