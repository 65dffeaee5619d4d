"""What the subcommands answer, as text or JSON; files and plots on the way."""

from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from math import degrees, radians
from typing import Any

import numpy as np

from hopper.arrays import Array, Complex
from hopper.assessment.coupled import CoupledStability, assess_coupled, assess_coupled_neutral
from hopper.assessment.limits import assess_limits, tangency_coefficient
from hopper.assessment.march import MarchAssessment, assess_march
from hopper.assessment.neutral import Interval, NeutralPoint, assess_neutral
from hopper.assessment.radial import assess_radial
from hopper.assessment.stability import StabilityAssessment, assess_stability
from hopper.errors import ConvergenceError, NoRadialSolutionError, WallFrictionError
from hopper.problem import as_geometry
from hopper.radial.solution import solve_radial
from hopper.stability.collocation import Parity
from hopper_cli import designs, documents, progress, sentences, text, written
from hopper_cli.errors import UsageError
from hopper_data import assessments, tables
from hopper_data.inputs import Case
from hopper_data.top_files import top_of
from hopper_data.walls import Wall

_NO_TRANSIENT = (
    "no transient growth: the collocation matrix grows in ways that the equations do not"
)
_Pairs = tuple[Complex, Array]  # eigenvalues and their errors


def answer(options: Namespace) -> str:
    """Compute what the parsed options ask for, write the files, and return what to print.

    Raises
    ------
    UsageError
        If the wall is rougher than the material, or a file cannot be written.
    HopperError
        If there is no answer; the message says up to which friction there is one.
    """
    commands = {"radial": _radial, "stability": _stability, "neutral": _neutral, "march": _march}
    return commands[options.command](options)


def _radial(options: Namespace) -> str:
    case = _case(options)
    with _explained(case):
        found = assess_radial(case.hopper, case.wall.friction_angle)
    written.write(options, case, found)
    rows = tables.rows(found, assessments.RADIAL)
    limits = tables.rows(found.limits, assessments.LIMITS)
    end = found.limits.friction and found.limits.friction.end
    if options.json:
        main = [
            row for row in rows + limits if row.variable.name not in ("mu_limit", "mu_tangency")
        ]
        return documents.as_json(
            case.echoed(),
            rows + limits,
            sentence=designs.mass_flow(case),
            limit_end=end,
            error_estimate=max(row.relative_error for row in main),
            notes=[*options.doubts, *found.notes],
        )
    shown = [row for row in limits if row.variable.name != "mu_limit" or end != "fold"]
    return documents.as_text(
        designs.mass_flow(case),
        text.number_cells(rows + shown),
        [f"Radial solution: {case}", *found.notes, sentences.radial_sentence(found)],
    )


def _stability(options: Namespace) -> str:
    case = _case(options)
    if case.model == "von-mises":
        return _coupled(options, case)
    with _explained(case):
        solution = solve_radial(case.hopper, case.wall.friction_angle)
        found = assess_stability(solution, options.disturbances, options.modes)
    written.write(options, case, found)
    rows = tables.rows(found, assessments.STABILITY)
    rows += tables.rows({"tangency": tangency_coefficient(case.hopper)}, assessments.TANGENCY)
    shown, notes = _shown(found, options.modes)
    if options.json:
        return documents.as_json(
            case.echoed(),
            rows,
            sentence=designs.mass_flow(case),
            **{key: _pairs(shown.get(parity)) for parity, key in _JSON.items()},
            governed_by=found.result.governed_by,
            parity=found.result.parity,
            verdict=found.verdict,
            disturbances="any" if "asymmetric" in shown else "symmetric",
            error_estimate=found.abscissa.error,
            notes=[*options.doubts, *notes],
            errors={_JSON[parity]: errors.tolist() for parity, (_, errors) in shown.items()},
        )
    cells = [
        (f"{parity} eigenvalue {number}", text.complex_with_error(value, error))
        for parity, pairs in shown.items()
        for number, (value, error) in enumerate(zip(*pairs, strict=True), start=1)
    ]
    return documents.as_text(
        designs.mass_flow(case),
        cells + text.number_cells(rows),
        [f"Linear stability: {case}", *notes, sentences.stability_sentence(case.geometry, found)],
    )


def _shown(found: StabilityAssessment, count: int) -> tuple[dict[Parity, _Pairs], list[str]]:
    """Return the first low modes of each parity, and where there are fewer than ``count``."""
    shown = {
        parity: (modes.eigenvalues[:count], modes.errors[:count])
        for parity, modes in found.modes.items()
    }
    notes = [
        f"only {values.size} low {parity} modes are resolved"
        for parity, (values, _) in shown.items()
        if values.size < count
    ]
    return shown, notes


def _coupled(options: Namespace, case: Case) -> str:
    """Answer for von Mises cones; what only Mohr-Coulomb materials have is null."""
    found = assess_coupled(case.hopper, case.wall.friction_angle)
    if found.verdict == "no_radial_solution":
        raise NoRadialSolutionError(found.judged.reason, found.judged.border or None)
    if found.modes is None and (options.profile or options.plot):
        raise ConvergenceError(f"there are no modes to write: {found.judged.reason}")
    written.write(options, case, found)
    modes: _Pairs = np.empty(0, complex), np.empty(0)
    notes: list[str] = []
    if found.modes is not None:
        modes = found.modes.eigenvalues[: options.modes], found.modes.errors[: options.modes]
        if modes[0].size < options.modes:
            notes = [f"only {modes[0].size} low modes are resolved"]
    if options.json:
        return _coupled_json(case, found, modes, [*options.doubts, *notes, _NO_TRANSIENT])
    cells = [("type of the equations", str(found.type))]
    cells += [
        (f"eigenvalue {number}", text.complex_with_error(value, error))
        for number, (value, error) in enumerate(zip(*modes, strict=True), start=1)
    ]
    if (growth := found.judged.growth) is not None:
        for edges in growth.strips.intervals.tolist():
            low, high = (text.rounded(edge, growth.strips.error_estimate) for edge in edges)
            cells.append(("strip of high frequency", f"{low} to {high}"))
    return documents.as_text(
        designs.mass_flow(case),
        cells + text.number_cells(tables.rows(found, assessments.COUPLED)),
        [f"Linear stability: {case}", *notes, sentences.coupled_sentence(found)],
    )


def _coupled_json(case: Case, found: CoupledStability, modes: _Pairs, notes: list[str]) -> str:
    null = tables.rows({}, assessments.STABILITY + assessments.TANGENCY)
    rows = tables.rows(found, assessments.COUPLED)
    kind, growth = found.judged.type, found.judged.growth
    return documents.as_json(
        case.echoed(),
        [*null, *rows],
        sentence=designs.mass_flow(case),
        type=found.type,
        verdict=found.verdict,
        reason=found.judged.reason,
        eigenvalues=_pairs(modes),
        asymmetric_eigenvalues=None,
        flow_rate_mode=0,
        strips=None if growth is None else growth.strips.intervals.tolist(),
        governed_by=found.governed_by,
        parity=None,
        disturbances="symmetric",
        slanted=found.judged.slanted,
        sonic_deg=[degrees(theta) for theta in kind.sonic] if kind else None,
        ring_spacing=kind.ring_spacing if kind else None,
        error_estimate=max((row.error for row in rows if row.error is not None), default=None),
        notes=notes,
        errors={
            "eigenvalues": modes[1].tolist(),
            "strips": None if growth is None else growth.strips.error_estimate,
        },
    )


_JSON: dict[Parity, str] = {"symmetric": "eigenvalues", "asymmetric": "asymmetric_eigenvalues"}


def _pairs(modes: _Pairs | None) -> list[list[float]] | None:
    return modes and [[mode.real, mode.imag] for mode in modes[0].tolist()]


def _march(options: Namespace) -> str:
    case = _case(options)
    top = top_of(options.top, options.eps, options.factor)
    with _explained(case):
        solution = solve_radial(case.hopper, case.wall.friction_angle)
    with progress.on_terminal() as report:
        found = assess_march(solution, top, options.depth, options.at_tau, report)
    asked = {key: getattr(options, key) for key in ("top", "eps", "factor", "depth", "at_tau")}
    written.write(options, case, found, asked)
    rows = tables.rows(found, assessments.MARCH)
    if options.at_tau is not None:
        rows += tables.rows(found, assessments.STRESS_AT)
    if options.json:
        return documents.as_json(
            case.echoed() | asked,
            rows,
            sentence=designs.mass_flow(case),
            breakdown_kind=found.kind,
            breakdown_error=found.breakdown and found.breakdown.error,
            breakdown_x=found.breakdown_x,
            tilted=found.result.base.tilted,
            end_tau=found.end,
            residual=found.residual,
            error_estimate=found.error_estimate,
            notes=[*options.doubts, *found.notes],
        )
    return documents.as_text(
        designs.mass_flow(case),
        _march_cells(found, rows),
        [
            f"Stress march: {case}, top {top.name}",
            *found.notes,
            sentences.march_sentence(found, options.depth),
        ],
    )


def _march_cells(found: MarchAssessment, rows: list[tables.Row]) -> list[tuple[str, str]]:
    cells = text.number_cells(rows)
    if found.breakdown_x is not None:
        cells.insert(1, ("where that is: theta", f"{found.breakdown_x:.3f} theta_w"))
    return [
        *cells,
        ("marched down to tau", f"{found.end:.6g}"),
        ("error of log(sigma) and psi", f"{found.error_estimate:.0e}"),
        ("residual of the momentum balance", f"{found.residual:.0e} rho g"),
    ]


def _neutral(options: Namespace) -> str:
    geometry, half_angle = as_geometry(options.geometry), radians(options.half_angle)
    wall = Wall.of(options.mu, options.phi)
    if options.model == "von-mises":
        found = assess_coupled_neutral(half_angle, wall.friction_angle)
    else:
        found = assess_neutral(geometry, half_angle, wall.friction_angle, options.disturbances)
    rows = tables.rows(found, assessments.NEUTRAL)
    kind = f"{geometry}, {options.model}"
    given = {"geometry": geometry, "model": options.model, "half_angle_deg": options.half_angle}
    inputs = given | asdict(wall)
    if options.json:
        first = found.points[0] if found.points else None
        return documents.as_json(
            inputs,
            rows,
            sentence=sentences.neutral_sentence(geometry, found),
            neutral_points=[_point(point) for point in found.points],
            stable_intervals_deg=[_interval(interval) for interval in found.intervals],
            governed_by=first and first.governed_by,
            parity=first and first.parity,
            error_estimate=first and rows[0].error,
            notes=options.doubts,
        )
    return documents.as_text(
        sentences.neutral_sentence(geometry, found),
        text.neutral_cells(found),
        [f"Neutral stability: {kind}, half angle {options.half_angle:g} deg, {wall}"],
    )


def _point(point: NeutralPoint) -> dict[str, Any]:
    return {
        "delta_deg": degrees(point.delta.value),
        "error_deg": degrees(point.delta.error),
        "governed_by": point.governed_by,
        "parity": point.parity,
    }


def _interval(interval: Interval) -> dict[str, Any]:
    return {
        "lower": degrees(interval.lower.value),
        "upper": degrees(interval.upper.value),
        "lower_error": degrees(interval.lower.error),
        "upper_error": degrees(interval.upper.error),
        "lower_end": interval.lower_end,
        "upper_end": interval.upper_end,
    }


def _case(options: Namespace) -> Case:
    case = Case(
        options.geometry,
        options.model,
        options.delta,
        options.half_angle,
        Wall.of(options.mu, options.phi),
    )
    try:
        case.hopper.material.wall_angle(case.hopper.delta, case.wall.friction_angle)
    except WallFrictionError as error:
        option = "--mu" if options.phi is None else "--phi"
        raise UsageError(f"argument {option}: {error}") from None
    return case


@contextmanager
def _explained(case: Case) -> Iterator[None]:
    """Add to an error the largest friction that has a radial solution, where that is known."""
    try:
        yield
    except ConvergenceError as error:
        mu = assess_limits(case.hopper).coefficient
        if mu is None:
            raise
        largest = Wall.of(mu.value)
        raise type(error)(
            f"{error}; the largest friction with a radial solution is {largest}"
        ) from None
