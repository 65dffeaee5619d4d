"""Low modes, asymptotic line and spectral abscissa against independent computations."""

from contextlib import suppress
from dataclasses import replace
from math import atan, cos, pi, radians, sin

import numpy as np
import pytest

from hopper import Hopper, linear_stability, solve_radial
from hopper.errors import (
    ConvergenceError,
    InvalidParameterError,
    NoRadialSolutionError,
    TangencyError,
)
from hopper.radial.collocation import Closure, newton
from hopper.radial.grid import half_grid
from hopper.stability import smooth_wall
from hopper.stability.asymptotic_line import asymptotic_line
from hopper.stability.convergence_filter import convergence_filter
from hopper.stability.mesh_spectrum import mesh_spectrum
from hopper.stability.modes import low_modes, upper_eigenvalues
from hopper.yield_conditions import VON_MISES
from tests.stability.witnesses import (
    galerkin_modes,
    line_by_quadrature,
    partner_distances,
    radial,
    shooting_roots,
)

HOPPERS = [
    ("wedge", 35, 10, 0.0),
    ("cone", 35, 10, 0.0),
    ("wedge", 38, 17, 0.12),
    ("cone", 38, 17, 0.12),
    ("wedge", 25, 50, 0.2),
    ("cone", 30, 30, 0.3),
    ("cone", 45, 10, 0.3),
    ("cone", 60, 2, 0.01),
]


def wall_tangency(delta):
    """mu (delta in degrees) at which psi reaches pi/4 - delta/2 at the wall."""
    s = sin(radians(delta))
    return s * cos(radians(delta)) / (1 + s**2)


# Low modes.


@pytest.mark.parametrize("hopper", HOPPERS)
def test_low_modes_by_a_second_discretisation(hopper):
    solution = radial(*hopper)
    modes, _ = low_modes(solution)
    assert len(modes) >= 3
    assert np.all(modes.imag >= 0)
    assert np.all(np.diff(np.abs(modes)) > 0)
    galerkin = galerkin_modes(solution, 48)
    assert partner_distances(modes, galerkin).max() < 1e-9
    # And none is left out.
    within = galerkin[(galerkin.imag > -1e-9) & (np.abs(galerkin) < np.abs(modes[-1]) + 1e-6)]
    assert len(within) == len(modes)


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
@pytest.mark.parametrize("mu", [0.0, 0.1])
def test_low_modes_by_shooting(geometry, mu):
    solution = radial(geometry, 35, 10, mu)
    modes = linear_stability(solution).eigenvalues[:4]
    roots = shooting_roots(solution, modes)
    assert np.all(np.abs(roots - modes) < 1e-8 * np.maximum(1, np.abs(modes)))


@pytest.mark.parametrize(
    ("geometry", "expected"),
    [
        ("wedge", [-1.6901729747, 0.6565572222 + 34.4981225575j, 0.6553231053 + 69.1155862467j]),
        ("cone", [-4.3803555504, -0.2027465702 + 41.9624728598j, -0.2026228243 + 77.1014751493j]),
    ],
)
def test_low_modes_of_figure_4_2(geometry, expected):
    modes = linear_stability(radial(geometry, 35, 10)).eigenvalues[:3]
    np.testing.assert_allclose(modes, expected, rtol=0, atol=1e-10)


# The asymptotic line.


@pytest.mark.parametrize("hopper", HOPPERS)
def test_line_by_adaptive_quadrature(hopper):
    solution = radial(*hopper)
    line = asymptotic_line(solution)
    abscissa, spacing = line_by_quadrature(solution)
    error = abs(line.abscissa - abscissa)
    size = max(1, abs(line.abscissa))
    assert error < 1e-12 * size
    assert error <= line.error_estimate + 8 * np.finfo(float).eps * size
    assert abs(line.spacing / spacing - 1) < 1e-12


@pytest.mark.parametrize(
    ("hopper", "abscissa"),
    [
        (("wedge", 35, 10), 0.6549139210),
        (("cone", 35, 10), -0.2025704150),
        (("wedge", 38, 17, 0.12), 0.1066787151),
        (("cone", 38, 17, 0.12), -2.0201385323),
    ],
)
def test_known_lines(hopper, abscissa):
    assert abs(asymptotic_line(radial(*hopper)).abscissa - abscissa) < 1e-10


@pytest.mark.parametrize(
    ("hopper", "size"),
    [
        (("cone", 38, 17, 0.12), 8),
        (("cone", 45, 10, 0.3), 10),
        (("wedge", 25, 10, 0.3249), 10),
        (("cone", 25, 30, 0.3109), 22),
    ],
)
def test_error_estimate_of_the_line_covers_the_radial_solution(hopper, size):
    # A radial solution on too few points, with the error it knows of.
    solution = radial(*hopper)
    closure = Closure("psi_wall", solution.psi_wall)
    member = solution.member
    for points in (size - 2, size):
        grid = half_grid(points, solution.hopper.half_angle)
        found = newton(solution.hopper, grid, closure, member.on(grid))
        assert found is not None
        member = found
    crude = asymptotic_line(replace(solution, member=member))
    error = abs(crude.abscissa - asymptotic_line(solution).abscissa)
    assert 1e-12 < error <= crude.error_estimate


@pytest.mark.parametrize(
    "hopper", [("wedge", 35, 10), ("cone", 35, 10), ("wedge", 38, 17, 0.12), ("cone", 38, 17, 0.12)]
)
def test_high_modes_approach_the_line(hopper):
    solution = radial(*hopper)
    line = asymptotic_line(solution)
    modes = upper_eigenvalues(solution, 128)
    modes = modes[modes.imag > 1][8:40]
    distance = modes.real - line.abscissa
    order = np.polyfit(np.log(modes.imag), np.log(np.abs(distance)), 1)[0]
    assert order == pytest.approx(-2, abs=0.01)
    gap = np.diff(modes.imag) - line.spacing
    # The midpoint of two modes, to which the gap belongs, removes the bias of first order.
    middle = (modes.imag[1:] + modes.imag[:-1]) / 2
    order = np.polyfit(np.log(middle), np.log(np.abs(gap)), 1)[0]
    assert order == pytest.approx(-2, abs=0.02)
    # Extrapolated in 1 / Im**2 and 1 / Im**4, Re(lambda) meets the line.
    terms = np.vander(1 / modes.imag**2, 3, increasing=True)
    limit = np.linalg.lstsq(terms, modes.real)[0][0]
    assert abs(limit - line.abscissa) < 1e-9


# Smooth walls.


def smooth_wall_distances(geometry, half_angle):
    """Distances of two low modes, and of the line, to smooth-wall theory."""
    delta, angle = radians(35), radians(half_angle)
    solution = radial(geometry, 35, half_angle)
    if geometry == "wedge":
        exact, _ = smooth_wall.wedge_eigenvalues(delta, angle, 2)
    else:
        mu = smooth_wall.cone_wavenumbers(angle, 2)
        exact = smooth_wall.cone_eigenvalues(delta, mu)
    exact = exact[exact.imag > 0]
    modes, _ = low_modes(solution)
    modes = modes[modes.imag > 0][:2]
    line = asymptotic_line(solution).abscissa - float(smooth_wall.abscissa(geometry, delta))
    return np.array([*np.abs(modes - exact), abs(line)])


@pytest.mark.parametrize(("geometry", "line_order"), [("wedge", 6), ("cone", 2)])
def test_smooth_wall_theory_is_the_limit_of_small_angles(geometry, line_order):
    # psi is of the order of the half angle: modes deviate by its square, the wedge's line by
    # its sixth power.
    wide, middle, narrow = (smooth_wall_distances(geometry, angle) for angle in (10, 5, 2.5))
    np.testing.assert_allclose(np.log2(middle / narrow), [2, 2, line_order], atol=0.03)
    np.testing.assert_allclose(np.log2(wide / middle), [2, 2, line_order], atol=0.1)


# The abscissa.


# The last is one whose modes converge slowly.
@pytest.mark.parametrize("hopper", [*HOPPERS[:7], ("cone", 43.866, 17.142, 0.3372)])
def test_abscissa_is_the_supremum_of_the_spectrum(hopper):
    solution = radial(*hopper)
    found = linear_stability(solution)
    modes = galerkin_modes(solution, 48)
    modes = modes[np.abs(modes) < 8 * found.line.spacing]
    highest = modes.real.max()
    line, _ = line_by_quadrature(solution)
    assert found.governed_by == ("mode" if highest > line else "line")
    assert found.stable == (max(highest, line) < 0)
    size = np.abs(modes[np.argmax(modes.real)])
    # The estimate is relative to |lambda|, and one of order of magnitude.
    error = abs(found.abscissa - max(highest, line))
    assert error <= 10 * found.error_estimate * max(1, size)
    assert error < 1e-9


def test_abscissa_of_random_hoppers():
    random = np.random.default_rng(11)
    checked = 0
    for geometry in 40 * ("wedge", "cone"):
        delta, half_angle, mu = random.uniform([20, 1, 0], [60, 50, 0.36])
        try:
            solution = radial(geometry, delta, half_angle, mu)
            found = linear_stability(solution)
        except (NoRadialSolutionError, TangencyError):
            continue
        modes = galerkin_modes(solution, 48)
        assert partner_distances(found.eigenvalues, modes).max() < 1e-9
        highest = modes[np.abs(modes) < 8 * found.line.spacing].real.max()
        assert abs(found.abscissa - max(highest, found.line.abscissa)) < 1e-9
        checked += 1
    assert checked > 40


@pytest.mark.parametrize("hopper", [*HOPPERS[:4], ("cone", 30, 10, 0.2)])
def test_abscissa_by_the_algorithm_of_the_paper(hopper):
    # Two meshes and the filter, for modes of physical parity; the line is their limit.
    solution = radial(*hopper)
    found = convergence_filter(mesh_spectrum(solution, 400), mesh_spectrum(solution, 200), 1e-3)
    kept = found.fine.eigenvalues[found.kept & (found.fine.half == 0)].real.max()
    result = linear_stability(solution)
    assert abs(max(kept, result.line.abscissa) - result.abscissa) < 1e-9
    assert kept > result.abscissa - 1e-3


@pytest.mark.parametrize(("friction_angle", "delta"), [(0, 33.6739), (10, 26.1404)])
def test_neutral_points_of_the_cone(friction_angle, delta):
    below, above = (
        linear_stability(
            solve_radial(Hopper("cone", radians(d), radians(10)), radians(friction_angle))
        )
        for d in (delta - 1e-4, delta + 1e-4)
    )
    assert below.abscissa > 0 > above.abscissa
    assert not below.stable
    assert above.stable


# Where it stops being defined.


@pytest.mark.parametrize(("delta", "mu"), [(25, 0.325), (30, 0.346), (35, 0.354), (45, 0.333)])
@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_tangency_at_the_wall(geometry, delta, mu):
    tangency = wall_tangency(delta)
    assert tangency == pytest.approx(mu, abs=5e-4)
    hopper = Hopper(geometry, radians(delta), radians(10))
    beyond = solve_radial(hopper, atan(tangency * (1 + 1e-6)))
    for analysis in (asymptotic_line, linear_stability):
        with pytest.raises(TangencyError, match=r"theta = .* deg.* lower the wall friction") as e:
            analysis(beyond)
        # The first such angle: psi rises to its wall value over a last 1e-6 of the way or so.
        assert e.value.theta == pytest.approx(radians(10), rel=1e-5)
        assert beyond.psi_at(e.value.theta)[0] == pytest.approx(pi / 4 - hopper.delta / 2)
    before = solve_radial(hopper, atan(tangency * (1 - 1e-4)))
    found = linear_stability(before)
    assert partner_distances(found.eigenvalues, galerkin_modes(before, 48)).max() < 1e-9


@pytest.mark.parametrize("mu", [0.32, 0.3112, 0.31097])
def test_tangency_inside(mu):
    # delta = 25 deg, half angle 30 deg: max psi passes 32.5 deg at mu = 0.3109606.
    solution = radial("cone", 25, 30, mu)
    assert solution.psi_wall < radians(32.5)
    with pytest.raises(TangencyError, match=r"psi reaches pi/4 - delta/2 = 32\.5 deg") as told:
        linear_stability(solution)
    assert solution.psi_at(told.value.theta)[0] == pytest.approx(radians(32.5), abs=1e-12)
    assert told.value.theta < radians(29)


@pytest.mark.parametrize("remoteness", [1e-5, 1e-7, 1e-9])
@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_just_before_tangency(geometry, remoteness):
    hopper = Hopper(geometry, radians(35), radians(10))
    solution = solve_radial(hopper, atan(wall_tangency(35) * (1 - remoteness)))
    abscissa = asymptotic_line(solution).abscissa
    assert abs(abscissa - line_by_quadrature(solution)[0]) < 1e-6 * max(1, abs(abscissa))
    # Low modes are right, or refused.
    with suppress(ConvergenceError):
        found = linear_stability(solution)
        assert partner_distances(found.eigenvalues, galerkin_modes(solution, 48)).max() < 1e-8


def test_von_mises_is_refused():
    solution = solve_radial(Hopper("cone", radians(30), radians(10), VON_MISES), 0.1)
    with pytest.raises(InvalidParameterError, match="use mohr-coulomb"):
        linear_stability(solution)


def test_a_warm_started_radial_solution_gives_the_same_abscissa():
    hopper = Hopper("cone", radians(35), radians(10))
    neighbour = solve_radial(hopper, atan(0.11))
    warm = linear_stability(solve_radial(hopper, atan(0.1), start=neighbour))
    assert abs(warm.abscissa - linear_stability(radial("cone", 35, 10, 0.1)).abscissa) < 1e-11
