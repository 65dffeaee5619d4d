"""Low modes, line and spectral abscissa against shooting and a second discretisation."""

from dataclasses import replace
from math import atan, pi, radians

import numpy as np
import pytest

from hopper import Hopper, HopperError, linear_stability, solve_radial
from hopper.errors import ConvergenceError, InvalidParameterError
from hopper.radial.collocation import Closure, newton
from hopper.radial.fields import stacked_fields
from hopper.radial.grid import half_grid
from hopper.stability import smooth_wall
from hopper.stability.asymptotic_line import LINE_SIZES, asymptotic_line, lines_on
from hopper.stability.collocation import mode_grid, parities_of, tilted_matrix
from hopper.stability.convergence_filter import convergence_filter
from hopper.stability.low_modes import (
    Modes,
    low_modes,
    mesh_sizes,
    partner_changes,
    upper_eigenvalues,
)
from hopper.stability.mesh_spectrum import mesh_spectrum
from hopper.stability.modes import LinearStability, linear_stabilities
from hopper.stability.tilted import stacked_on_grids
from hopper.yield_conditions import VON_MISES
from tests.stability.tilted_chebyshev import staggered_modes
from tests.stability.tilted_data import ELSEWHERE, ELSEWHERE_NAMES, as_complex, name, read
from tests.stability.tilted_data import radial as of_case
from tests.stability.witnesses import partner_distances, radial

REFERENCE = read("tilted_reference")
# Solutions beyond the fold are judged by no verdict, and have layers of their own.
PHYSICAL = [case for case in REFERENCE if case["branch"] == "physical"]


def within(modes, case):
    """Those in the rectangle that shooting has searched."""
    return (modes.real > case["lowest_re"]) & (modes.imag < case["highest_im"])


def partners(left, right):
    """Index of the one-to-one partner in the right of each left one; none is left over."""
    assert left.size == right.size
    index = np.abs(left[:, None] - right).argmin(axis=1)
    assert np.unique(index).size == left.size
    return index


# Modes.


@pytest.mark.parametrize("case", PHYSICAL, ids=name)
def test_shot_modes_one_to_one_within_both_errors(case):
    """Up to the largest modulus found none is missing, and none is spurious."""
    solution = of_case(case)
    found = linear_stability(solution, count=6)
    assert list(found.modes) == list(parities_of(solution.hopper.geometry))
    for parity, modes in found.modes.items():
        values, errors = modes.eigenvalues, modes.errors
        assert np.all(values.imag >= 0)
        assert np.all(np.diff(np.abs(values)) >= 0)
        shot, shot_errors = as_complex(case[parity]), np.array(case[f"{parity}_errors"])
        low = np.abs(shot) < np.abs(values[-1]) + errors[-1] + 1e-8
        inside = within(values, case)
        index = partners(values[inside], shot[low])
        distance = np.abs(values[inside] - shot[low][index])
        assert np.all(distance <= errors[inside] + shot_errors[low][index])
        assert inside.sum() >= 3


@pytest.mark.parametrize("case", PHYSICAL, ids=name)
def test_line_and_abscissa_of_the_shot_problem(case):
    found = linear_stability(of_case(case), others=1e-5)
    line = found.line
    assert abs(line.abscissa - case["line"]) <= line.error_estimate + case["line_error"]
    assert line.spacing == pytest.approx(case["spacing"], rel=1e-11)
    known = {parity: as_complex(case[parity]) for parity in found.modes}
    suprema = {parity: max(case["line"], shot.real.max()) for parity, shot in known.items()}
    for parity, supremum in suprema.items():
        value, error = getattr(found, parity)
        assert abs(value - supremum) <= error + 1e-11
    highest = max(suprema.values())
    assert abs(found.abscissa - highest) <= found.error_estimate + 1e-11
    assert found.stable == (highest < 0)
    if highest == case["line"]:
        assert (found.governed_by, found.parity) == ("line", None)
    else:
        assert found.parity is not None
        shot = known[found.parity]
        kind = "complex mode" if shot[shot.real.argmax()].imag else "real mode"
        assert (found.governed_by, suprema[found.parity]) == (kind, highest)


@pytest.mark.parametrize(("case", "parity", "modes"), ELSEWHERE, ids=ELSEWHERE_NAMES)
def test_spectra_computed_elsewhere_at_24_points(case, parity, modes):
    found = upper_eigenvalues(of_case(case), 24, parity)
    found = found[np.abs(found) < np.abs(modes).max() * (1 + 1e-6)]
    distance = np.abs(modes - found[partners(modes, found)])
    assert np.all(distance <= case["tolerance_relative"] * np.abs(modes))


@pytest.mark.parametrize("case", [c for c in REFERENCE if c["branch"] == "second"], ids=name)
def test_modes_beyond_the_fold(case):
    """One real mode is positive there, and more than one complex pair may be."""
    found = upper_eigenvalues(of_case(case), 80)
    found = found[within(found, case) & (found.real < 40)]
    shot = as_complex(case["symmetric"])
    assert np.abs(found - shot[partners(found, shot)]).max() < 1e-8
    assert np.sum((found.real > 0) & (found.imag == 0)) == 1


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


def test_number_of_modes():
    solution = radial("wedge", 35, 10, 0.2)
    for count in (1, 3, 6, 15):
        found = linear_stability(solution, count=count)
        assert [modes.eigenvalues.size for modes in found.modes.values()] == 2 * [max(3, count)]
    np.testing.assert_array_equal(found.eigenvalues, found.modes["symmetric"].eigenvalues)


def test_no_grid_mode_of_asymmetric_disturbances():
    """On an even number of points -1.6839 comes in: sigma1 = T_(N-1)."""
    solution = radial("wedge", 35, 10)
    for size in (12, 13, 24, 36):
        found = upper_eigenvalues(solution, size, "asymmetric")
        assert not np.any((found.imag == 0) & (np.abs(found) < 10))


def test_partners_are_given_once():
    fine = np.array([1.0, 1.001, 20j])
    changes = partner_changes(fine, np.array([1.0005, 22j]))
    np.testing.assert_allclose(changes, [5e-4, np.inf, 0.1])


# The asymptotic line.


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
    ("delta", "distance", "expected"),
    [(45, 3, -0.99), (45, 1, 0.62), (45, 0.3, 2.07), (45, 0.1, 3.27), (45, 0.03, 4.55)],
)
def test_line_rises_to_infinity_at_a_wall_as_rough_as_the_material(delta, distance, expected):
    hopper = Hopper("wedge", radians(delta), radians(10))
    line = asymptotic_line(solve_radial(hopper, radians(delta - distance)))
    assert line.abscissa == pytest.approx(expected, abs=0.006)
    assert line.error_estimate < 1e-6


@pytest.mark.parametrize(
    ("hopper", "size"),
    [
        (("cone", 38, 17, 0.12), 8),
        (("cone", 45, 10, 0.3), 10),
        (("wedge", 25, 10, 0.3249), 10),
        (("cone", 25, 30, 0.3109), 22),
        (("wedge", 45, 15, 0.58), 14),
    ],
)
def test_error_estimate_of_the_line_covers_the_radial_solution(hopper, size):
    # A radial solution on too few points, with the error it knows of.
    solution = radial(*hopper)
    crude = asymptotic_line(on_few_points(solution, size))
    error = abs(crude.abscissa - asymptotic_line(solution).abscissa)
    assert 1e-12 < error <= crude.error_estimate


@pytest.mark.parametrize(
    "hopper", [("cone", 35, 10), ("wedge", 38, 17, 0.12), ("wedge", 40, 20, 0.5)]
)
def test_high_modes_of_each_parity_approach_the_line(hopper):
    solution = radial(*hopper)
    line = asymptotic_line(solution)
    for parity in parities_of(solution.hopper.geometry):
        modes = upper_eigenvalues(solution, 128, parity)
        modes = modes[modes.imag > 1][10:40]
        distance = modes.real - line.abscissa
        order = np.polyfit(np.log(modes.imag), np.log(np.abs(distance)), 1)[0]
        assert order == pytest.approx(-2, abs=0.02)
        gap = np.diff(modes.imag) - line.spacing
        # The midpoint of two modes, to which the gap belongs, removes the bias of first order.
        middle = (modes.imag[1:] + modes.imag[:-1]) / 2
        order = np.polyfit(np.log(middle), np.log(np.abs(gap)), 1)[0]
        assert order == pytest.approx(-2, abs=0.02)
        # Extrapolated in powers of 1 / Im**2, Re(lambda) meets the line.
        terms = np.vander((modes.imag[0] / modes.imag) ** 2, 4, increasing=True)
        limit = np.linalg.lstsq(terms, modes.real)[0][0]
        assert abs(limit - line.abscissa) < 1e-8 * max(1, abs(line.abscissa))


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
    modes = linear_stability(solution).eigenvalues
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


def test_abscissa_of_random_hoppers():
    random = np.random.default_rng(11)
    checked = 0
    for geometry in 9 * ("wedge", "cone"):
        delta, half_angle, mu = random.uniform([20, 1, 0], [60, 50, 0.6])
        try:
            solution = radial(geometry, delta, half_angle, mu)
            found = linear_stability(solution)
        except HopperError:
            continue
        suprema = [found.line.abscissa]
        for parity, modes in found.modes.items():
            fine, coarse = (staggered_modes(solution, size, parity) for size in (64, 48))
            fine = fine[np.abs(fine) < np.abs(modes.eigenvalues[-1]) * (1 + 1e-6) + 1e-9]
            own = np.abs(fine[:, None] - coarse).min(axis=1)
            index = partners(modes.eigenvalues, fine)
            distance = np.abs(modes.eigenvalues - fine[index])
            assert np.all(distance <= modes.errors + own[index])
            assert own.max() < 1e-5
            suprema.append(fine.real.max())
        assert abs(found.abscissa - max(suprema)) <= found.error_estimate + 1e-9
        checked += 1
    assert checked > 9


@pytest.mark.parametrize("hopper", [("wedge", 38, 17, 0.12), ("cone", 35, 10)])
def test_abscissa_by_the_algorithm_of_the_paper(hopper):
    # Two meshes and the filter, for modes of physical parity; the line is their limit.
    solution = radial(*hopper)
    found = convergence_filter(mesh_spectrum(solution, 200), mesh_spectrum(solution, 100), 1e-3)
    kept = found.fine.eigenvalues[found.kept & (found.fine.half == 0)].real.max()
    result = linear_stability(solution, "symmetric")
    assert abs(max(kept, result.line.abscissa) - result.abscissa) < 1e-9
    assert kept > result.abscissa - 1e-3


def test_the_frame_of_the_paper_beyond_the_tangency():
    """Its converged modes are right, among spurious ones that only the filter removes."""
    solution = of_case(ELSEWHERE[0][0])
    found = convergence_filter(mesh_spectrum(solution, 200), mesh_spectrum(solution, 100), 1e-3)
    physical = found.fine.half == 0
    kept = found.fine.eigenvalues[found.kept & physical]
    low = linear_stability(solution, count=6).eigenvalues
    assert partner_distances(low, kept).max() < 1e-6
    assert found.fine.eigenvalues[physical].real.max() > 1e2 > kept.real.max()
    assert upper_eigenvalues(solution, 100).real.max() < 1e2


def on_few_points(solution, size):
    """The solution on ``size`` half-grid points, with the error it knows of."""
    closure = Closure("psi_wall", solution.psi_wall)
    member = solution.member
    for points in (size - 2, size):
        grid = half_grid(points, solution.hopper.half_angle)
        found = newton(solution.hopper, grid, closure, member.on(grid))
        assert found is not None
        member = found
    return replace(solution, member=member)


def test_a_warm_started_radial_solution_gives_the_same_abscissa():
    hopper = Hopper("cone", radians(35), radians(10))
    neighbour = solve_radial(hopper, atan(0.11))
    warm = linear_stability(solve_radial(hopper, atan(0.1), start=neighbour))
    assert abs(warm.abscissa - linear_stability(radial("cone", 35, 10, 0.1)).abscissa) < 1e-11


# The verdict.


@pytest.mark.parametrize(
    ("hopper", "verdict", "governor", "parity"),
    [
        (("wedge", 35, 10, 0.0), "unstable", "complex mode", "asymmetric"),
        (
            ("wedge", 40, 20, np.tan(radians(25))),
            "stable_symmetric_only",
            "complex mode",
            "asymmetric",
        ),
        (("wedge", 45, 30, np.tan(radians(15))), "stable", "complex mode", "asymmetric"),
        (
            ("wedge", 63.03, 66.71, np.tan(radians(4.86))),
            "stable_symmetric_only",
            "real mode",
            "asymmetric",
        ),
        (("wedge", 68.32, 31.92, np.tan(radians(46.946))), "unstable", "complex mode", "symmetric"),
        (("cone", 35, 10, 0.0), "stable", "line", None),
        (("cone", 35, 30, 0.325), "stable", "complex mode", "symmetric"),
    ],
)
def test_verdicts(hopper, verdict, governor, parity):
    found = linear_stability(radial(*hopper))
    assert (found.verdict, found.governed_by) == (verdict, governor)
    assert found.parity == (None if governor == "line" else parity)
    assert found.stable == (verdict == "stable")
    symmetric = linear_stability(radial(*hopper), "symmetric")
    assert symmetric.asymmetric is None
    assert symmetric.verdict == verdict.removesuffix("_symmetric_only")
    assert symmetric.symmetric == pytest.approx(found.symmetric, rel=1e-9)


def test_no_verdict_within_the_error():
    found = linear_stability(radial("cone", 35, 10))

    def judged(abscissa, error):
        return replace(found, abscissa=abscissa, error_estimate=error).verdict

    assert [judged(1e-9 * sign, 2e-9) for sign in (-1, 1)] == 2 * ["neutral"]
    # The line of symmetric disturbances lies at -0.2.
    assert [judged(3e-9 * sign, 2e-9) for sign in (-1, 1)] == ["stable", "stable_symmetric_only"]


def test_no_mode_resolved_is_no_verdict():
    """w -> 0 inside at 23.5 degrees: modes crowd and polynomials fail."""
    with pytest.raises(ConvergenceError, match="lower the wall friction"):
        linear_stability(solve_radial(Hopper("cone", radians(25), radians(30)), radians(23.45)))


def test_properties_of_a_result():
    line = asymptotic_line(radial("wedge", 35, 10))
    modes = Modes(np.array([-1.0, 2 + 3j, 5j]), np.array([1e-9, 2e-9, 3e-9]))
    assert modes.highest == 1
    found = LinearStability({"symmetric": modes}, line, 2.0, "complex mode", "symmetric", 2e-9)
    assert found.symmetric == (2.0, 2e-9)
    below = replace(modes, eigenvalues=modes.eigenvalues - 8)
    found = replace(found, modes={"symmetric": below})
    assert found.symmetric == (line.abscissa, line.error_estimate)


# Refusals.


def test_von_mises_is_refused():
    solution = solve_radial(Hopper("cone", radians(30), radians(10), VON_MISES), 0.1)
    with pytest.raises(InvalidParameterError, match="use mohr-coulomb"):
        linear_stability(solution)


def test_asymmetric_disturbances_of_cones_are_refused():
    with pytest.raises(InvalidParameterError, match="singular at the apex of a cone: use symm"):
        linear_stability(radial("cone", 35, 10), "any")
    with pytest.raises(InvalidParameterError, match="disturbances = 'all' is unknown: use symm"):
        linear_stability(radial("cone", 35, 10), "all")  # type: ignore[arg-type]


@pytest.mark.parametrize("geometry", ["wedge", "cone"])
def test_stability_goes_smoothly_through_the_tangency(geometry):
    """A parabola through values around it: nothing happens to modes and line there."""
    hopper = Hopper(geometry, radians(35), radians(10))
    tangency = atan(np.sin(radians(35)) * np.cos(radians(35)) / (1 + np.sin(radians(35)) ** 2))
    angles = tangency * (1 + np.array([-3e-3, -1e-3, 0, 1e-3, 3e-3]))
    found = [linear_stability(solve_radial(hopper, angle)) for angle in angles]
    assert found[2].error_estimate < 1e-8
    for values in (
        [one.abscissa for one in found],
        [one.line.abscissa for one in found],
        [one.eigenvalues[1].imag for one in found],
    ):
        fit = np.polyfit(angles - tangency, values, 3)
        assert np.abs(np.polyval(fit, angles - tangency) - values).max() < 1e-6
    assert found[0].line.spacing > found[4].line.spacing / 2 > pi / 4


def test_solutions_together_are_judged_as_one_by_one():
    """On different grids, with and without layers, of both parities."""
    for geometry in ("cone", "wedge"):
        hopper = Hopper(geometry, radians(40), radians(30))
        solutions = [solve_radial(hopper, radians(phi)) for phi in (0, 3, 9, 14, 17.5)]
        assert len({solution.member.grid.size for solution in solutions}) > 1
        for solution, together in zip(solutions, linear_stabilities(solutions), strict=True):
            single = linear_stability(solution)
            assert not isinstance(together, ConvergenceError)
            assert together.modes.keys() == single.modes.keys()
            for parity, modes in together.modes.items():
                other = single.modes[parity]
                error = modes.errors + other.errors
                assert np.all(np.abs(modes.eigenvalues - other.eigenvalues) <= error)
            assert abs(together.line.abscissa - single.line.abscissa) <= (
                together.line.error_estimate + single.line.error_estimate
            )


@pytest.mark.parametrize(("geometry", "phi"), [("cone", 1), ("cone", 13), ("wedge", 1)])
def test_the_coarsest_mesh_is_for_smooth_fields_and_modes_that_do_not_govern(geometry, phi):
    solution = solve_radial(Hopper(geometry, radians(40), radians(30)), radians(phi))
    fine, few = mesh_sizes(solution, 1e-10), solution.member.grid.size < 24
    assert mesh_sizes(solution, 1e-5) == ((9, *fine) if few else fine)


def test_more_meshes_to_begin_with_give_the_same_modes():
    """Some solutions are done on the second mesh, others go on: rows stay with their solutions."""
    hopper = Hopper("cone", radians(40), radians(30))
    solutions = [solve_radial(hopper, radians(phi)) for phi in (0, 3, 9, 14)]
    lines = np.array([asymptotic_line(solution).abscissa for solution in solutions])
    stacks = [
        np.stack([np.linalg.eigvals(tilted_matrix(one, size, "symmetric")) for one in solutions])
        for size in mesh_sizes(solutions[0], 1e-12)[:4]
    ]
    few, many = (
        low_modes(solutions, "symmetric", stacks[:count], lines, 3, 1e-12, 1e-12)
        for count in (2, 4)
    )
    for one, other in zip(few, many, strict=True):
        assert isinstance(one, Modes)
        assert isinstance(other, Modes)
        np.testing.assert_array_equal(one.eigenvalues, other.eigenvalues)


def test_solutions_of_several_hoppers_do_not_go_together():
    solutions = [radial("wedge", 35, 10), radial("wedge", 36, 10)]
    with pytest.raises(InvalidParameterError, match="not of one hopper"):
        linear_stabilities(solutions)
    assert linear_stabilities([]) == []
    with pytest.raises(InvalidParameterError, match="empty"):
        stacked_fields([], [])


def test_line_of_a_coarse_grid_is_refined_where_it_does_not_suffice():
    solution = solve_radial(Hopper("wedge", radians(20), radians(30)), radians(19.9))
    grid = mode_grid(solution, LINE_SIZES[0], "symmetric")
    (first,) = lines_on([solution], grid, stacked_on_grids([solution], [grid])[0])
    line = asymptotic_line(solution, first)
    assert first.tail > 1e-13 >= line.tail or line.error_estimate < first.error_estimate
    assert abs(first.abscissa - line.abscissa) <= first.error_estimate
