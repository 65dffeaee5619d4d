"""Abstract and section 1: what kind of solutions and equations these are."""

from math import sqrt

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import Finding, above, below, counted, upper_bound
from hopper_workflow.claims.results import number, parameters, values


def solutions_exist(
    moderate: xr.Dataset,
    rough: xr.Dataset,
    chart: xr.Dataset,
    models: xr.Dataset,
    *,
    largest_error: float,
) -> Finding:
    fields = [values(data, "error_radial").ravel() for data in (moderate, rough)]
    errors = np.concatenate([*fields, values(chart, "error_estimate")])
    limit, limit_von_mises = (
        number(models, "limit_mu", model=model) for model in ("mohr-coulomb", "von-mises")
    )
    return counted(
        int(np.sum(errors < largest_error)),
        errors.size,
        f"Largest error estimate {upper_bound(errors.max())}. In the hopper of the figures they "
        f"exist up to mu = {limit:.4f} (Mohr-Coulomb) and {limit_von_mises:.4f} (von Mises) only.",
    )


def stress_falls_and_particles_accelerate(moderate: xr.Dataset, rough: xr.Dataset) -> Finding:
    least = {
        name: min(float(values(data, name).min()) for data in (moderate, rough))
        for name in ("sigma", "u")
    }
    error = max(float(values(data, "error_velocity").max()) for data in (moderate, rough))
    lowest = min(least.values())
    return above(
        lowest, 0.0, error * lowest, f"Least sigma {least['sigma']:.4f}, least u {least['u']:.3g}."
    )


def radial_stress_is_autonomous(models: xr.Dataset, *, rounding: float) -> Finding:
    reaction = values(models, "coupling_radial")
    error = float(values(models, "error_radial").max())
    return below(float(reaction.max()), rounding, error, "For both models and all frictions.")


def stress_decouples_for_mohr_coulomb_only(models: xr.Dataset, *, rounding: float) -> Finding:
    coulomb = values(models, "coupling", model="mohr-coulomb").max()
    von_mises = values(models, "coupling", model="von-mises").min()
    error = float(values(models, "error_radial").max()) * von_mises
    remark = f"Mohr-Coulomb {upper_bound(coulomb)}, von Mises {von_mises:.3g}."
    if coulomb > rounding:
        return below(coulomb, rounding, error, remark)
    return above(von_mises, rounding, error, remark)


def mohr_coulomb_is_hyperbolic(models: xr.Dataset) -> Finding:
    counts = values(models, "real_characteristics", model="mohr-coulomb")
    four = int(np.sum(counts == 4))
    return counted(four, counts.size, f"States of delta and psi; least number {counts.min():g}.")


def log_r_is_like_time(
    wedge_10: xr.Dataset,
    cone_10: xr.Dataset,
    wedge_30: xr.Dataset,
    cone_30: xr.Dataset,
    friction: xr.Dataset,
) -> Finding:
    maps = (wedge_10, cone_10, wedge_30, cone_30)
    inside, solved = _with_time(maps, 1)
    coarse_inside, coarse_solved = _with_time(maps, 2)
    tangencies = zip(values(friction, "tangency_mu"), values(friction, "delta"), strict=True)
    text = ", ".join(f"{mu:.3f} (delta = {delta:g} deg)" for mu, delta in tangencies)
    verdict = counted(inside, solved, "").verdict
    share, coarse_share = inside / solved, coarse_inside / coarse_solved
    return Finding(
        share,
        abs(share - coarse_share),
        verdict,
        "Elsewhere a characteristic is tangent to an arc r = const, which the paper does not "
        f"mention: in a 10 deg cone beyond mu = {text}. There t + h(theta), a tilted time, is one: "
        "it is time-like for every radial solution.",
    )


def _with_time(maps: tuple[xr.Dataset, ...], step: int) -> tuple[int, int]:
    """Count points of maps where t is like time, and those that have a verdict."""
    inside = solved = 0
    for data in maps:
        psi = values(data, "psi_max", gaps=True)[::step, ::step]
        tangency = 45 - values(data, "delta")[::step, None] / 2
        inside += int(np.sum(psi < tangency))
        solved += int(np.isfinite(psi).sum())
    return inside, solved


def von_mises_is_not_always_hyperbolic(models: xr.Dataset) -> Finding:
    counts = values(models, "real_characteristics", model="von-mises")
    share, coarse = (float(np.mean(c < 4)) for c in (counts, counts[::2, ::2]))
    delta, psi = values(models, "delta"), values(models, "psi")
    on_axis = delta[counts[:, int(np.argmin(psi))] == 4]
    all_four = f"from {on_axis.min():g} to {on_axis.max():g} deg" if on_axis.size else "nowhere"
    verdict = above(share, 0.0, 0.0, "").verdict
    remark = f"On the axis (psi = 0) hyperbolic for delta {all_four} only."
    return Finding(share, abs(share - coarse), verdict, remark)


def sharp_and_reliable(wedge: xr.Dataset, cone: xr.Dataset, *, same: float) -> Finding:
    worded, physical, reference = (
        np.concatenate([values(data, name).ravel() for data in (wedge, cone)])
        for name in ("check_as_worded", "check_physical", "check_abscissa")
    )
    close, sound = (
        np.abs(found - reference) <= same * np.abs(reference) for found in (worded, physical)
    )
    signs = int(np.sum(np.sign(worded) == np.sign(reference)))
    return counted(
        int(close.sum()),
        close.size,
        f"Largest deviation {np.abs(worded - reference).max():.2f}, from modes of the other "
        f"parity that pass the filter; with the flow's parity alone {sound.sum()} agree. The sign, "
        f"so the verdict of stability, is right at {signs} points.",
    )


def thresholds_carry_over(
    smooth: xr.Dataset, wedge: xr.Dataset, cone: xr.Dataset, domain: xr.Dataset, *, close: float
) -> Finding:
    theory = {g: number(smooth, "neutral_delta", geometry=g) for g in ("wedge", "cone")}
    full = {"wedge": _smooth_neutral(wedge), "cone": _smooth_neutral(cone)}
    error = max(number(data, "neutral_error") for data in (wedge, cone))
    largest = max(abs(full[g] - theory[g]) for g in theory)
    widest = float(values(domain, "half_angle").max())
    at_widest = number(domain, "neutral_delta", half_angle=widest, phi=0)
    return below(
        largest,
        close,
        error,
        f"Without small angles: wedge {full['wedge']:.3f} deg, cone {full['cone']:.3f} deg. For "
        f"cones of half angle {widest:g} deg the neutral delta is {at_widest:.2f} deg.",
    )


def _smooth_neutral(borders: xr.Dataset) -> float:
    return float(values(borders, "neutral_delta", point=0))


def jenike_tabulated_them(chart: xr.Dataset, *, reading_error: float) -> Finding:
    deviation = number(chart, "rms_deviation")
    computed = float(values(chart, "error_estimate").max())
    count = int(np.sum(values(chart, "point_phi") >= parameters(chart)["least_friction_deg"]))
    remark = (
        f"Flow factors at {count} points of a published chart. The error is that of reading them; "
        f"that of the computation is {upper_bound(computed)}."
    )
    # The mean square of so many independent errors is uncertain by sqrt(2 / count) of itself.
    return below(deviation, reading_error, reading_error / sqrt(2 * count), remark)
