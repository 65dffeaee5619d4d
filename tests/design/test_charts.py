"""Design charts: every limit against solutions on both of its sides."""

from math import degrees, pi, radians

import numpy as np
import pytest

from hopper import Hopper, flow_factor, solve_radial
from hopper.design.charts import chart
from hopper.design.half_angles import half_angles
from hopper.design.material import Material
from hopper.errors import HopperError, InvalidParameterError, NoRadialSolutionError
from hopper.problem import Geometry
from hopper.radial.friction_limit import friction_limit
from hopper.stability.modes import linear_stability

HOPPERS: tuple[tuple[Geometry, float], ...] = (("cone", 30), ("wedge", 50))
ANGLES = np.radians([10.0, 25.0, 40.0])


@pytest.fixture(scope="module")
def charts():
    return {
        (geometry, delta): chart(geometry, radians(delta), ANGLES, 4) for geometry, delta in HOPPERS
    }


def points(charts, name):
    for (geometry, delta), found in charts.items():
        line = getattr(found, name)
        for angle, phi, error in zip(
            found.half_angle, line.friction_angle, line.error, strict=True
        ):
            if np.isfinite(phi):
                yield Hopper(geometry, radians(delta), float(angle)), float(phi), float(error)


def test_limits_agree_with_those_in_the_half_angle(charts):
    """A chart's point has its half angle as the root for its wall."""
    for line, name in (("classical", "classical"), ("velocity", "velocity")):
        for hopper, phi, _ in points(charts, line):
            made = Material(hopper.geometry, hopper.delta, phi)
            top = hopper.geometry == "wedge" and abs(degrees(phi) - 37.46) < 0.01
            if name == "velocity" and (hopper.geometry == "cone" or top):
                continue  # there the half angle is not what ends it
            found = getattr(half_angles(made), name)
            assert found
            assert abs(found.value - hopper.half_angle) < 1e-9


def test_solutions_end_at_the_limit(charts):
    for hopper, phi, error in points(charts, "limit"):
        assert error < 1e-8
        assert solve_radial(hopper, phi * (1 - 1e-4))
        with pytest.raises(HopperError):
            solve_radial(hopper, phi * (1 + 1e-6))


def test_psi_is_45_degrees_at_the_limit_of_velocity(charts):
    for hopper, phi, _ in points(charts, "velocity"):
        if hopper.geometry == "wedge":  # close to a fold psi changes fast
            assert abs(solve_radial(hopper, phi).psi_maximum()[1] - pi / 4) < 1e-8


@pytest.mark.parametrize(("name", "sign"), [("stability", 1), ("stable_from", -1)])
def test_the_abscissa_changes_its_sign_at_the_limit_of_stability(charts, name, sign):
    found = 0
    for hopper, phi, error in points(charts, name):
        found += 1
        assert error < 1e-6
        assert abscissa(hopper, phi - sign * 1e-5) < 0
        try:
            assert abscissa(hopper, phi + sign * 1e-5) > 0
        except NoRadialSolutionError:
            assert abs(friction_limit(hopper).friction_angle - phi) < 1e-5
    assert found


def abscissa(hopper, phi):
    return linear_stability(solve_radial(hopper, phi)).abscissa


def test_flow_factors_are_those_of_solutions(charts):
    for (geometry, delta), found in charts.items():
        assert np.all(found.friction_angle[:, 0] == 0)
        for i, angle in enumerate(found.half_angle):
            for phi, factor in zip(found.friction_angle[i], found.flow_factor[i], strict=True):
                solution = solve_radial(Hopper(geometry, radians(delta), float(angle)), float(phi))
                assert abs(flow_factor(solution) / factor - 1) < 1e-8


def test_the_stable_interval_of_narrow_wedges_closes(charts):
    """Between two half angles of which one only has a stable wall there are more."""
    found = chart("wedge", radians(40), np.radians([15.0, 22.0]), 2)
    assert found.half_angle.size > 4
    width = found.stability.friction_angle - found.stable_from.friction_angle
    known = width[np.isfinite(width)]
    assert known[-1] < known[0] / 3
    assert np.all(np.diff(known) < 0)


def test_rows_that_are_refused():
    with pytest.raises(InvalidParameterError, match="two at least, and increase"):
        chart("cone", 0.6, ANGLES[::-1])
    with pytest.raises(InvalidParameterError, match="frictions = 1 is too few"):
        chart("cone", 0.6, ANGLES, 1)
