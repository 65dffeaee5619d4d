"""Section 3: radial fields of both models, Figures 3.1 and 3.2."""

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import (
    FAILS,
    HOLDS,
    LIMITED,
    Finding,
    Printed,
    above,
    below,
    counted,
    rounding,
    rounds,
)
from hopper_workflow.claims.results import number, values


def von_mises_hoop_stress(models: xr.Dataset, *, small: float) -> Finding:
    residual = values(models, "hoop_residual", model="von-mises")
    return below(float(residual.max()), small, rounding(1), "For all frictions.")


def _exponent(models: xr.Dataset, model: str, printed: Printed) -> Finding:
    exponents = values(models, "exponent", model=model)
    spread = float(values(models, "exponent_spread", model=model).max())
    farthest = exponents[np.argmax(np.abs(exponents - printed.value))]
    return rounds(printed, float(farthest), spread, "From the flow rule and v = -u r^-2 e_r.")


def exponent_of_mohr_coulomb(models: xr.Dataset, *, printed: Printed) -> Finding:
    return _exponent(models, "mohr-coulomb", printed)


def exponent_of_von_mises(models: xr.Dataset, *, printed: Printed) -> Finding:
    return _exponent(models, "von-mises", printed)


def _singular_angle(models: xr.Dataset, model: str, small: float) -> Finding:
    found = values(models, "singular_psi", model=model)
    difference = np.abs(found - values(models, "printed_limit", model=model))
    delta = values(models, "delta")
    return below(
        float(difference.max()),
        small,
        rounding(90),
        f"Zero of det A against the printed limit, delta = {delta[0]:g} to {delta[-1]:g} deg.",
    )


def mohr_coulomb_is_nonsingular(models: xr.Dataset, *, small: float) -> Finding:
    return _singular_angle(models, "mohr-coulomb", small)


def von_mises_is_nonsingular(models: xr.Dataset, *, small: float) -> Finding:
    return _singular_angle(models, "von-mises", small)


def von_mises_condition_is_more_stringent(models: xr.Dataset) -> Finding:
    gap = values(models, "singular_psi", model="mohr-coulomb") - values(
        models, "singular_psi", model="von-mises"
    )
    delta = values(models, "delta")
    remark = f"Least at delta = {delta[int(np.argmin(gap))]:g} deg; it vanishes with delta."
    return above(float(gap.min()), 0.0, rounding(90), remark)


def _difference(data: xr.Dataset, name: str, mu: float) -> float:
    """Return the largest difference between the models over the larger model's maximum."""
    coulomb, von_mises = (
        values(data, name, mu=mu, model=model) for model in ("mohr-coulomb", "von-mises")
    )
    size = max(np.abs(coulomb).max(), np.abs(von_mises).max())
    return float(np.abs(coulomb - von_mises).max() / size)


def _error(data: xr.Dataset) -> float:
    return float(values(data, "error_velocity").max())


def comparable_at_moderate_roughness(
    moderate: xr.Dataset, *, comparable: float, smooth_mu: float, moderate_mu: float
) -> Finding:
    table = {
        (name, mu): _difference(moderate, name, mu)
        for name in ("sigma", "u")
        for mu in (smooth_mu, moderate_mu)
    }
    axis = [
        number(moderate, "sigma_axis", mu=moderate_mu, model=model)
        for model in ("mohr-coulomb", "von-mises")
    ]
    text = ", ".join(f"{name} at mu = {mu:g} {d:.3f}" for (name, mu), d in table.items())
    return below(
        max(table.values()),
        comparable,
        _error(moderate),
        f"{text}. On the axis alone the stresses differ by {abs(axis[0] / axis[1] - 1):.0%} at mu "
        f"= {moderate_mu:g}.",
    )


def different_at_large_roughness(
    moderate: xr.Dataset,
    rough: xr.Dataset,
    *,
    comparable: float,
    moderate_mu: float,
    rough_mu: float,
) -> Finding:
    large = {name: _difference(rough, name, rough_mu) for name in ("sigma", "u")}
    grown = all(large[name] > _difference(moderate, name, moderate_mu) for name in large)
    remark = (
        f"sigma {large['sigma']:.3f}, u {large['u']:.3f}; both larger than at "
        f"mu = {moderate_mu:g}: {'yes' if grown else 'no'}."
    )
    finding = above(min(large.values()), comparable, _error(rough), remark)
    return finding if grown else Finding(finding.computed, finding.error, FAILS, remark)


def velocity_differs_most(rough: xr.Dataset, *, rough_mu: float) -> Finding:
    differences = {name: _difference(rough, name, rough_mu) for name in ("u", "sigma", "psi")}
    others = max(differences["sigma"], differences["psi"])
    remark = ", ".join(f"{name} {value:.3f}" for name, value in differences.items())
    return above(differences["u"] / others, 1.0, _error(rough), f"{remark}.")


def _velocity_beyond(rough: xr.Dataset, model: str, mu: float, angle: float) -> np.ndarray:
    zone = np.abs(values(rough, "theta")) >= angle
    return values(rough, "u", mu=mu, model=model)[zone]


def stagnant_zone_of_mohr_coulomb(
    rough: xr.Dataset, *, rough_mu: float, edge: float, stagnant: float
) -> Finding:
    fastest = float(_velocity_beyond(rough, "mohr-coulomb", rough_mu, edge).max())
    wall = number(rough, "u_wall", mu=rough_mu, model="mohr-coulomb")
    remark = f"At the wall {wall:.2e}."
    return below(fastest, stagnant, fastest * _error(rough), remark)


def no_stagnant_zone_of_von_mises(
    rough: xr.Dataset, *, rough_mu: float, edge: float, stagnant: float
) -> Finding:
    speeds = _velocity_beyond(rough, "von-mises", rough_mu, edge)
    remark = f"From {speeds.max():.3f} at {edge:g} deg to {speeds.min():.3f} at the wall."
    return above(float(speeds.min()), stagnant, _error(rough), remark)


def psi_comes_close_to_quarter_pi(
    rough: xr.Dataset, *, printed: Printed, rough_mu: float, close: float
) -> Finding:
    largest = number(rough, "psi_max", mu=rough_mu, model="mohr-coulomb")
    other = number(rough, "psi_max", mu=rough_mu, model="von-mises")
    gap = (printed.value - largest) / printed.value
    finding = below(
        abs(gap), close, number(rough, "error_radial", mu=rough_mu, model="mohr-coulomb"), ""
    )
    remark = f"{gap:.1%} below pi/4; von Mises {other:.4f}."
    return Finding(largest, finding.error, finding.verdict, remark)


def psi_peaks_at_the_edge(
    rough: xr.Dataset, *, rough_mu: float, edge: float, stagnant: float, roughly: float
) -> Finding:
    peak = number(rough, "theta_psi_max", mu=rough_mu, model="mohr-coulomb")
    theta = values(rough, "theta")
    velocity, psi = (values(rough, n, mu=rough_mu, model="mohr-coulomb") for n in ("u", "psi"))
    slow, on_grid = velocity <= stagnant, theta[int(np.argmax(psi))]
    from_velocity = float(np.abs(theta)[slow].min()) if slow.any() else np.inf
    verdict = FAILS
    if abs(peak - from_velocity) <= roughly:
        verdict = LIMITED
    if abs(peak - edge) <= roughly:
        verdict = HOLDS
    remark = (
        f"The velocity falls below {stagnant:g} of that on the axis at {from_velocity:.2f} deg."
    )
    return Finding(peak, float(abs(peak - on_grid)), verdict, remark)


def one_field_for_each_friction(models: xr.Dataset) -> Finding:
    counts = values(models, "solutions")
    mu = values(models, "mu")
    several = [f"{mu[j]:g}" for _, j in np.argwhere(counts > 1)]
    remark = "No case has more than one."
    if several:
        fold = number(models, "limit_mu", model="mohr-coulomb")
        second = np.nanmax(values(models, "psi_max_second", gaps=True))
        remark = (
            f"{counts.max():g} at mu = {', '.join(several)}, just below the fold of Mohr-Coulomb "
            f"at mu = {fold:.4f}; in the second psi reaches {second:.1f} deg, and the velocity is "
            "singular at 45 deg."
        )
    return counted(int(np.sum(counts == 1)), counts.size, remark)


def solutions_can_be_linearised(models: xr.Dataset) -> Finding:
    largest = values(models, "psi_max", model="mohr-coulomb")
    tangency, singular = number(models, "tangency_psi"), number(models, "mohr_coulomb_singular_psi")
    text = ", ".join(
        f"mu = {mu:g}: {psi:.2f} deg" for mu, psi in zip(values(models, "mu"), largest, strict=True)
    )
    return counted(
        int(np.sum(largest < singular)),
        largest.size,
        f"Largest psi at {text}; singular is {singular:.2f} deg. Beyond {tangency:.2f} deg t = log "
        "r is no time, but a tilted time is, with the same eigenvalues.",
    )


def mohr_coulomb_is_more_conservative(
    moderate: xr.Dataset, rough: xr.Dataset, models: xr.Dataset
) -> Finding:
    coulomb, von_mises = (
        np.concatenate([values(data, "u_wall", model=model) for data in (moderate, rough)])
        for model in ("mohr-coulomb", "von-mises")
    )
    limits = [number(models, "limit_mu", model=model) for model in ("mohr-coulomb", "von-mises")]
    pairs = ", ".join(f"{a:.4g}/{b:.4g}" for a, b in zip(coulomb, von_mises, strict=True))
    return counted(
        int(np.sum(coulomb < von_mises)),
        coulomb.size,
        f"u at the wall, Mohr-Coulomb/von Mises: {pairs}. Radial flow is possible up to mu = "
        f"{limits[0]:.3f}/{limits[1]:.3f}.",
    )
