"""Section 4: (4.1) as printed, smooth-wall deductions, d/dx for comparison, lasting oscillation."""

import logging
from collections.abc import Sequence
from math import radians, sin
from typing import Any

import numpy as np

from hopper_workflow import artifacts, jobs, ranges
from hopper.evidence import first_derivative, smooth_operator
from hopper.evidence.folds import FoldMode, fold_mode
from hopper.evidence.printed import compare_linearised
from hopper.problem import Geometry
from hopper.spectral.transient import oscillation
from hopper.stability import smooth_wall
from hopper.stability.transient import modal_basis
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.inputs import hopper_of, solution_of
from hopper_data.tables import angle, in_degrees, number, text, within
from hopper_workflow.kept_modes import by_half


def compute_linear_checks(
    wedge: str,
    cone: str,
    *,
    delta_deg: float,
    half_angle_deg: float,
    mu: float,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
    printed_at: dict[str, Any],
    smooth: dict[str, Any],
    folds: dict[str, Any],
    windows: dict[str, Any],
    norms: dict[str, dict[str, Any]],
) -> CfDataset:
    """Check the deductions of section 4; ``wedge`` and ``cone`` are filtered spectra."""
    case = (delta_deg, half_angle_deg)
    result = {
        "printed": compare_linearised(
            solution_of("cone", *case, printed_at["mu"]), printed_at["points"]
        ),
        "smooth": _smooth(*case, **smooth),
        "folds": _folds(**folds),
        "derivative": _first_derivative(nodes, coarse_nodes, tolerance),
        "oscillation": _oscillation((*case, mu), nodes, (wedge, cone), norms, windows),
        "matrix": ["A", "B", "C"],
        "entry": [1, 2],
        "formulation": list(norms),
        "start": windows["starts"],
        "geometry": list(_GEOMETRIES),
    }
    return dataset(result, TABLE, AXES)


def _smooth(
    delta_deg: float,
    half_angle_deg: float,
    *,
    modes: int,
    nodes: int,
    half_angles_deg: dict[str, Any],
    delta_points: int,
) -> dict[str, Any]:
    half_angle, angles = radians(half_angle_deg), ranges.spaced(0, **half_angles_deg)
    hoppers = [hopper_of(geometry, delta_deg, half_angle_deg) for geometry in _GEOMETRIES]
    onset = smooth_operator.real_onset(radians(angles[-1]))
    below = np.linspace(0, onset, delta_points + 1)[1:-1]
    real = [smooth_operator.real_eigenvalues(below, radians(a), modes) for a in angles[1:]]
    wavenumber = smooth_wall.cone_wavenumbers(half_angle, 1, "kummer")[0]
    return {
        "psi_max": [
            solution_of(geometry, delta_deg, half_angle_deg, 0).psi_maximum()[1]
            for geometry in _GEOMETRIES
        ],
        "formula": [smooth_operator.check_formula(hopper, modes, nodes) for hopper in hoppers],
        "neutral_root": [smooth_operator.neutral_delta(g, half_angle) for g in _GEOMETRIES],
        "crossing_root": smooth_operator.crossing_delta(half_angle),
        "threshold": smooth_wall.oscillation_threshold(np.radians(angles)),
        "half_angle": angles,
        "onset": onset,
        "onset_sine": sin(onset),
        "real_below_onset": sum(real),
        "kummer_residual": smooth_operator.kummer_residual(wavenumber, half_angle, nodes),
    }


def _folds(half_angles_deg: Sequence[float], deltas_deg: dict[str, float]) -> list[FoldMode]:
    """Return the neutral modes of all hoppers that have a fold."""
    hoppers = [
        hopper_of("cone", delta, half_angle)
        for half_angle in half_angles_deg
        for delta in ranges.steps(**deltas_deg)
    ]
    return [mode for mode in map(fold_mode, hoppers) if mode]


def _first_derivative(nodes: int, coarse_nodes: int, tolerance: float) -> dict[str, float]:
    fine, coarse = (first_derivative.digits_lost(size) for size in (nodes, coarse_nodes))
    return {
        "size": nodes - 1,
        "digits_lost": fine,
        "digits_lost_error": abs(fine - coarse),
        "agreeing": first_derivative.agreeing_eigenvalues(nodes, coarse_nodes, tolerance),
    }


def _oscillation(
    case: tuple[float, float, float],
    nodes: int,
    spectra: tuple[str, str],
    norms: dict[str, dict[str, Any]],
    windows: dict[str, Any],
) -> dict[str, np.ndarray]:
    """Return amplitudes and their errors over geometry, formulation and start."""
    table = np.empty((len(spectra), len(norms), len(windows["starts"]), 2))
    for i, (geometry, path) in enumerate(zip(_GEOMETRIES, spectra, strict=True)):
        solution, spectrum = solution_of(geometry, *case), by_half(path)
        for j, (formulation, norm) in enumerate(norms.items()):
            bases = [
                modal_basis(solution, nodes, half, kept, **norm)
                for half, kept in spectrum[formulation].items()
            ]
            table[i, j] = [
                oscillation(bases, start, windows["length"], windows["points"])
                for start in windows["starts"]
            ]
            name = f"{geometry}, {formulation} formulation"
            logging.info("%s: oscillation %s", name, table[i, j, :, 0])
    return {"amplitude": table[..., 0], "error": table[..., 1]}


_GEOMETRIES: tuple[Geometry, Geometry] = ("wedge", "cone")
_ENTRIES = "matrix row column"
TABLE = (
    number("printed_ratio", "printed over derived entry of (4.1)", _ENTRIES, "printed.ratio"),
    number("printed_spread", "range of the ratio over the hopper", _ENTRIES, "printed.spread"),
    text("matrix", "matrix of (4.1)", "matrix"),
    number("row", "row", "row", "entry"),
    number("column", "column", "column", "entry"),
    *within(
        "smooth",
        (
            angle(
                "smooth_psi_max", "largest Sokolovskii angle, smooth wall", "geometry", "psi_max"
            ),
            number(
                "formula_error",
                "relative error of the pairs of (4.7), (4.9)",
                "geometry",
                "formula.error",
            ),
            number(
                "missing",
                "number of eigenvalues of (4.3) that are not among the pairs",
                "geometry",
                "formula.missing.size",
            ),
            number(
                "missing_real", "largest real part of these", "geometry", "formula.highest_missing"
            ),
            angle("neutral_root", "delta at which the first pair crosses Re = 0", "geometry"),
            angle(
                "crossing_root",
                "delta at which the first pairs of wedge and cone have equal real parts",
            ),
            number("threshold", "f(theta_w)", "half_angle"),
            in_degrees("half_angle", "half opening angle", "half_angle"),
            angle("onset", "least delta with a real eigenvalue of (4.9), widest hopper"),
            number("onset_sine", "sine of it"),
            number(
                "real_below_onset",
                "number of real eigenvalues of (4.9) below it, at any half angle",
            ),
            number("kummer_residual", "residual of (4.10)"),
        ),
    ),
    *within(
        "folds",
        (
            number("fold_modulus", "least |lambda| at a fold", "fold", "modulus"),
            number("fold_modulus_error", "error of it", "fold", "error"),
            number(
                "fold_before", "growing real modes at more stress on the axis", "fold", "before"
            ),
            number("fold_behind", "growing real modes at less", "fold", "behind"),
        ),
    ),
    *within(
        "derivative",
        (
            number("derivative_size", "order of the matrix of d/dx", source="size"),
            number(
                "derivative_digits_lost",
                "decimal digits that rounding costs its worst conditioned eigenvalue",
                source="digits_lost",
            ),
            number(
                "derivative_digits_lost_error",
                "change of it from the coarse mesh",
                source="digits_lost_error",
            ),
            number(
                "derivative_agreeing",
                "number of its eigenvalues that two meshes agree on",
                source="agreeing",
            ),
        ),
    ),
    *within(
        "oscillation",
        (
            number(
                "oscillation",
                "relative variation of exp(t alpha) times the norm of exp(-t M) over a window of "
                "-t",
                "geometry formulation start",
                "amplitude",
            ),
            number(
                "oscillation_error",
                "its change from half of the sampled times",
                "geometry formulation start",
                "error",
            ),
        ),
    ),
    text("formulation", "formulation and its norm", "formulation"),
    number("start", "start of the window of -t", "start"),
)
AXES = (text("geometry", "shape of the hopper", "geometry"),)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_linear_checks,
            "Checks of the linearised equations and of smooth-wall theory",
            "(4.1)-(4.11)",
        )
    )
