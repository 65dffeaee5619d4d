"""Section 4: (4.1) as printed, smooth-wall deductions, d/dx for comparison, lasting oscillation."""

import logging
from math import degrees, radians, sin
from typing import Any

import numpy as np
import xarray as xr

from hopper.evidence import first_derivative, smooth_operator
from hopper.evidence.printed import compare_linearised
from hopper.problem import Geometry
from hopper.spectral.transient import oscillation
from hopper.stability import smooth_wall
from hopper.stability.transient import modal_basis
from support import artifacts, fields, hoppers, jobs, modes


def compute_linear_checks(
    wedge: str,
    cone: str,
    artifact: str,
    provenance: str,
    *,
    delta_deg: float,
    half_angle_deg: float,
    mu: float,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
    printed_at: dict[str, Any],
    smooth: dict[str, Any],
    windows: dict[str, Any],
    kept_modes: dict[str, dict[str, Any]],
) -> None:
    """Check the deductions of section 4; ``wedge`` and ``cone`` are filtered spectra."""
    case: dict[str, Any] = {"delta_deg": delta_deg, "half_angle_deg": half_angle_deg}
    spectra = {"wedge": wedge, "cone": cone}
    dataset = xr.Dataset(
        {
            **_printed(case, **printed_at),
            **_smooth(**case, **smooth),
            **_first_derivative(nodes, coarse_nodes, tolerance),
            **_oscillation({**case, "mu": mu}, nodes, spectra, kept_modes, **windows),
        },
        coords={
            "geometry": ("geometry", list(_GEOMETRIES), {"long_name": "shape of the hopper"}),
        },
    )
    artifacts.write(
        dataset,
        artifact,
        provenance,
        title="Checks of the linearised equations and of smooth-wall theory",
        equations="(4.1)-(4.11)",
        parameters={
            **case,
            "mu": mu,
            "nodes": nodes,
            "coarse_nodes": coarse_nodes,
            "tolerance": tolerance,
            "printed_at": printed_at,
            "smooth": smooth,
            "windows": windows,
            "kept_modes": kept_modes,
        },
    )


def _printed(case: dict[str, float], *, mu: float, points: int) -> dict[str, fields.Variable]:
    found = compare_linearised(hoppers.radial_solution("cone", **case, mu=mu), points)
    over = ("matrix", "row", "column")
    return {
        "printed_ratio": fields.number(over, found.ratio, "printed over derived entry of (4.1)"),
        "printed_spread": fields.number(over, found.spread, "range of the ratio over the hopper"),
        "matrix": ("matrix", ["A", "B", "C"], {"long_name": "matrix of (4.1)"}),
        "row": fields.number("row", [1, 2], "row"),
        "column": fields.number("column", [1, 2], "column"),
    }


def _smooth(
    *,
    delta_deg: float,
    half_angle_deg: float,
    modes: int,
    nodes: int,
    half_angles_deg: dict[str, Any],
    delta_points: int,
) -> dict[str, fields.Variable]:
    half_angle, angles = radians(half_angle_deg), fields.axis(0, **half_angles_deg)
    found = [hoppers.mohr_coulomb(g, delta_deg, half_angle_deg) for g in _GEOMETRIES]
    checks = [smooth_operator.check_formula(hopper, modes, nodes) for hopper in found]
    smooth_walls = [hoppers.radial_solution(g, delta_deg, half_angle_deg, 0) for g in _GEOMETRIES]
    roots = [smooth_operator.neutral_delta(g, half_angle) for g in _GEOMETRIES]
    onset = smooth_operator.real_onset(radians(angles[-1]))
    below = np.linspace(0, onset, delta_points + 1)[1:-1]
    real = [smooth_operator.real_eigenvalues(below, radians(a), modes) for a in angles[1:]]
    wavenumber = smooth_wall.cone_wavenumbers(half_angle, 1, "kummer")[0]
    return {
        "smooth_psi_max": fields.angle(
            "geometry", [degrees(s.psi_maximum()[1]) for s in smooth_walls],
            "largest Sokolovskii angle, smooth wall",
        ),
        "formula_error": fields.number(
            "geometry", [c.error for c in checks], "relative error of the pairs of (4.7), (4.9)"
        ),
        "missing": fields.number(
            "geometry", [c.missing.size for c in checks],
            "number of eigenvalues of (4.3) that are not among the pairs",
        ),
        "missing_real": fields.number(
            "geometry", [c.missing.real.max(initial=-np.inf) for c in checks],
            "largest real part of these",
        ),
        "neutral_root": fields.angle(
            "geometry", np.degrees(roots), "delta at which the first pair crosses Re = 0"
        ),
        "crossing_root": fields.angle(
            (), degrees(smooth_operator.crossing_delta(half_angle)),
            "delta at which the first pairs of wedge and cone have equal real parts",
        ),
        "threshold": fields.number(
            "half_angle", smooth_wall.oscillation_threshold(np.radians(angles)), "f(theta_w)"
        ),
        "half_angle": fields.angle("half_angle", angles, "half opening angle"),
        "onset": fields.angle(
            (), degrees(onset), "least delta with a real eigenvalue of (4.9), widest hopper"
        ),
        "onset_sine": fields.number((), sin(onset), "sine of it"),
        "real_below_onset": fields.number(
            (), sum(real), "number of real eigenvalues of (4.9) below it, at any half angle"
        ),
        "kummer_residual": fields.number(
            (), smooth_operator.kummer_residual(wavenumber, half_angle, nodes), "residual of (4.10)"
        ),
    }  # fmt: skip


def _first_derivative(
    nodes: int, coarse_nodes: int, tolerance: float
) -> dict[str, fields.Variable]:
    agreeing = first_derivative.agreeing_eigenvalues(nodes, coarse_nodes, tolerance)
    fine, coarse = (first_derivative.digits_lost(size) for size in (nodes, coarse_nodes))
    return {
        "derivative_size": fields.number((), nodes - 1, "order of the matrix of d/dx"),
        "derivative_digits_lost": fields.number(
            (), fine, "decimal digits that rounding costs its worst conditioned eigenvalue"
        ),
        "derivative_digits_lost_error": fields.number(
            (), abs(fine - coarse), "change of it from the coarse mesh"
        ),
        "derivative_agreeing": fields.number(
            (), agreeing, "number of its eigenvalues that two meshes agree on"
        ),
    }


def _oscillation(
    case: dict[str, float],
    nodes: int,
    spectra: dict[str, str],
    kept_modes: dict[str, dict[str, Any]],
    *,
    starts: list[float],
    length: float,
    points: int,
) -> dict[str, fields.Variable]:
    table = np.empty((len(spectra), len(kept_modes), len(starts), 2))
    for i, (geometry, path) in enumerate(spectra.items()):
        solution, spectrum = hoppers.radial_solution(geometry, **case), artifacts.read(path)
        for j, (mode, weighting) in enumerate(kept_modes.items()):
            bases = [
                modal_basis(solution, nodes, half, kept, **weighting)
                for half, kept in modes.kept_by_half(spectrum, mode).items()
            ]
            table[i, j] = [oscillation(bases, start, length, points) for start in starts]
            logging.info("%s, %s mode: oscillation %s", geometry, mode, table[i, j, :, 0])
    over = ("geometry", "mode", "start")
    return {
        "oscillation": fields.number(
            over, table[..., 0],
            "relative variation of exp(t alpha) times the norm of exp(-t M) over a window of -t",
        ),
        "oscillation_error": fields.number(
            over, table[..., 1], "its change from half as many times"
        ),
        "mode": ("mode", list(kept_modes), {"long_name": "kept modes and their norm"}),
        "start": fields.number("start", starts, "start of the window of -t"),
    }  # fmt: skip


_GEOMETRIES: tuple[Geometry, Geometry] = ("wedge", "cone")

if __name__ == "__main__":
    jobs.run(compute_linear_checks, snakemake)  # type: ignore[name-defined]  # noqa: F821
