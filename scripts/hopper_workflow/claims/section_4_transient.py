"""Section 4: the behaviour in time, (4.11) and Figure 4.3."""

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import FAILS, HOLDS, LIMITED, Finding, above, counted, rounding
from hopper_workflow.claims.results import values

_ALLOWED = 1e-9


def negative_means_stable(wedge: xr.Dataset, cone: xr.Dataset) -> Finding:
    ratios, right = [], []
    for data in (wedge, cone):
        growth, times = values(data, "growth").ravel(), values(data, "elapsed")
        alpha = float(values(data, "abscissa").ravel()[0])
        late = times >= times[-1] / 2
        means = [np.trapezoid(growth[part], times[part]) for part in (late, ...)]
        ratios.append(float(2 * means[0] / means[1]))
        right.append((ratios[-1] > 1) == (alpha > 0))
    remark = f"Mean norm in time, later half over all: wedge {ratios[0]:.3f}, cone {ratios[1]:.3f}."
    return counted(sum(right), len(right), remark)


def norms_obey_the_bounds(
    wedge: xr.Dataset, cone: xr.Dataset, wedge_norms: xr.Dataset, cone_norms: xr.Dataset
) -> Finding:
    inside = total = 0
    for data in (wedge, cone, wedge_norms, cone_norms):
        growth = values(data, "growth", gaps=True)  # at times of other curves
        lower, upper = (values(data, name) for name in ("lower_bound", "upper_bound"))
        outside = (growth < lower * (1 - _ALLOWED)) | (growth > upper * (1 + _ALLOWED))
        # Not times: how many there are depends on rounding.
        curves = outside.reshape(-1, outside.shape[-1]).any(axis=1)
        inside, total = inside + int((~curves).sum()), total + curves.size
    return counted(inside, total, "Curves of wedge and cone, all norms, unknowns and formulations.")


def matrix_is_not_normal(wedge: xr.Dataset, cone: xr.Dataset) -> Finding:
    conditions = [float(values(data, "condition").ravel()[0]) for data in (wedge, cone)]
    remark = (
        f"kappa(V), 1 for a normal matrix: wedge {conditions[0]:.4g}, cone {conditions[1]:.4g}."
    )
    return above(min(conditions), 1.0, rounding(min(conditions)), remark)


def _sustained(linear: xr.Dataset, geometry: str, sustained: float) -> Finding:
    paper, physical = (
        values(linear, "oscillation", geometry=geometry, formulation=name)
        for name in ("paper", "physical")
    )
    index = int(np.argmin(paper))
    errors = values(linear, "oscillation_error", geometry=geometry, formulation="paper")
    everywhere = HOLDS if np.all(physical >= sustained) else LIMITED
    verdict = everywhere if np.all(paper >= sustained) else FAILS
    starts = ", ".join(f"{start:g}" for start in values(linear, "start"))
    remark = (
        f"From -t = {starts}: paper's norm {_listed(paper)}; flow's parity in the L2 norm "
        f"{_listed(physical)}."
    )
    return Finding(float(paper[index]), float(errors[index]), verdict, remark)


def _listed(numbers: np.ndarray) -> str:
    return ", ".join(f"{value:.2f}" for value in numbers)


def unstable_wedge_oscillates(linear: xr.Dataset, *, sustained: float) -> Finding:
    return _sustained(linear, "wedge", sustained)


def stable_cone_oscillates(linear: xr.Dataset, *, sustained: float) -> Finding:
    return _sustained(linear, "cone", sustained)


def convergence_is_not_monotone(cone: xr.Dataset, *, often: float) -> Finding:
    growth, times = values(cone, "growth").ravel(), values(cone, "elapsed")
    rises, coarse = (
        float(np.diff(times[::step])[np.diff(growth[::step]) > 0].sum() / np.ptp(times))
        for step in (1, 2)
    )
    remark = f"It first grows to {growth.max():.1f} and is {growth[-1]:.1f} at -t = {times[-1]:g}."
    return above(rises, often, abs(rises - coarse), remark)
