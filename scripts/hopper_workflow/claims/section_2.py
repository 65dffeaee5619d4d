"""Section 2: yield conditions, flow rules and the law of the wall."""

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import Finding, above, below, rounding, upper_bound
from hopper_workflow.claims.results import values

_RESIDUALS = "Largest residual of the fields with mu = {}."


def _residual(models: xr.Dataset, name: str, model: str, bound: float) -> Finding:
    residual = values(models, name, model=model)
    remark = _RESIDUALS.format(", ".join(f"{mu:g}" for mu in values(models, "mu")))
    return below(float(residual.max()), bound, rounding(1), remark)


def principal_stress_ratio(models: xr.Dataset, *, small: float) -> Finding:
    return _residual(models, "ratio_residual", "mohr-coulomb", small)


def mohr_coulomb_yields(models: xr.Dataset, *, small: float) -> Finding:
    return _residual(models, "yield_residual", "mohr-coulomb", small)


def von_mises_yields(models: xr.Dataset, *, small: float) -> Finding:
    return _residual(models, "yield_residual", "von-mises", small)


def hoop_stress_is_major(models: xr.Dataset, *, small: float) -> Finding:
    return _residual(models, "hoop_residual", "mohr-coulomb", small)


def levy_factor_is_positive(models: xr.Dataset, *, small: float) -> Finding:
    factors = values(models, "levy_least", model="von-mises")
    defect = float(values(models, "levy_defect", model="von-mises").max())
    least = float(factors.min())
    remark = f"Part of V that is not proportional to T - pI: {upper_bound(defect)}."
    if defect > small:
        return below(defect, small, 0.0, remark)
    return above(least, 0.0, defect * least, remark)


def _wall_law(models: xr.Dataset, model: str, small: float) -> Finding:
    mu = values(models, "mu")
    difference = np.abs(values(models, "wall_mu", model=model) - mu)
    return below(
        float(difference.max()),
        small,
        float(values(models, "error_radial", model=model).max()),
        "Difference between tangential over normal stress at the wall and mu.",
    )


def wall_angle_of_mohr_coulomb(models: xr.Dataset, *, small: float) -> Finding:
    return _wall_law(models, "mohr-coulomb", small)


def wall_angle_of_von_mises(models: xr.Dataset, *, small: float) -> Finding:
    return _wall_law(models, "von-mises", small)
