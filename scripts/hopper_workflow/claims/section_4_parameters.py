"""Section 4: wall friction, internal friction and opening angle, Figures 4.4 and 4.5."""

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import (
    FAILS,
    HOLDS,
    LIMITED,
    Finding,
    below,
    counted,
    limited,
    upper_bound,
)
from hopper_workflow.claims.results import flagged, meaning, number, values


def _curves(*artifacts: xr.Dataset) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Return name, abscissa and its error of every curve, up to where it ends."""
    curves = []
    for data in artifacts:
        table, error = (values(data, name, gaps=True) for name in ("abscissa", "abscissa_error"))
        delta = values(data, "delta")
        for i, row in enumerate(table):
            known = np.isfinite(row)
            curves.append((f"{delta[i]:g} deg", row[known], error[i][known]))
    return curves


def _named(good: list[bool], *artifacts: xr.Dataset) -> str:
    names = [
        f"{label}, delta = {delta:g} deg"
        for label, data in zip(_HOPPERS, artifacts, strict=True)
        for delta in values(data, "delta")
    ]
    missing = [name for name, right in zip(names, good, strict=True) if not right]
    return f"Not for: {'; '.join(missing)}." if missing else "For all."


_HOPPERS = ("wedge 10 deg", "cone 10 deg", "wedge 30 deg", "cone 30 deg")


def small_friction_stabilises(
    wedge_10: xr.Dataset, cone_10: xr.Dataset, wedge_30: xr.Dataset, cone_30: xr.Dataset
) -> Finding:
    artifacts = (wedge_10, cone_10, wedge_30, cone_30)
    good = [
        bool(curve[1] < curve[0] - error[0] - error[1]) for _, curve, error in _curves(*artifacts)
    ]
    return counted(sum(good), len(good), _named(good, *artifacts))


def large_friction_destabilises(
    wedge_10: xr.Dataset, cone_10: xr.Dataset, wedge_30: xr.Dataset, cone_30: xr.Dataset
) -> Finding:
    artifacts = (wedge_10, cone_10, wedge_30, cone_30)
    good = [bool(curve[-1] > curve.min() + error.max()) for _, curve, error in _curves(*artifacts)]
    return counted(
        sum(good),
        len(good),
        f"{_named(good, *artifacts)} Curves end at the limit of friction or at mu = "
        f"{values(wedge_10, 'mu').max():g}.",
    )


def friction_range_is_regular(
    wedge_10: xr.Dataset, cone_10: xr.Dataset, wedge_30: xr.Dataset, cone_30: xr.Dataset
) -> Finding:
    artifacts = (wedge_10, cone_10, wedge_30, cone_30)
    last = float(values(wedge_10, "mu").max())
    ends = np.concatenate([values(data, "limit_mu") for data in artifacts])
    rows = [row for data in artifacts for row in _abscissae(data)]
    good = [
        bool(np.isfinite(row).all() and end > last) for row, end in zip(rows, ends, strict=True)
    ]
    return counted(
        sum(good),
        len(good),
        f"{_named(good, *artifacts)} Range plotted: mu up to {last:g}; the "
        f"earliest limit of friction is mu = {ends.min():.3f}.",
    )


def log_r_is_a_time_for_all(
    wedge_10: xr.Dataset, cone_10: xr.Dataset, wedge_30: xr.Dataset, cone_30: xr.Dataset
) -> Finding:
    artifacts = (wedge_10, cone_10, wedge_30, cone_30)
    last = float(values(wedge_10, "mu").max())
    ends = np.concatenate([values(data, "limit_mu") for data in artifacts])
    tangencies = np.concatenate([values(data, "tangency_mu", gaps=True) for data in artifacts])
    good = [not tangency < min(end, last) for tangency, end in zip(tangencies, ends, strict=True)]
    return counted(
        sum(good),
        len(good),
        f"{_named(good, *artifacts)} The earliest tangency is at mu = {np.nanmin(tangencies):.3f}, "
        "where A of (4.1) is singular. It is a defect of the coordinate: eigenvalues go through it "
        "smoothly.",
    )


def _abscissae(data: xr.Dataset) -> np.ndarray:
    return values(data, "abscissa", gaps=True)


def symmetric_disturbances_suffice(wedge_10: xr.Dataset, wedge_30: xr.Dataset) -> Finding:
    same = total = turned = 0
    for data in (wedge_10, wedge_30):
        known = _abscissae(data)
        gap = known - values(data, "abscissa_symmetric", gaps=True)
        same += int(np.sum(gap <= values(data, "abscissa_error", gaps=True)))
        total += int(np.isfinite(known).sum())
        turned += int(flagged(data, "region", "stable_symmetric_only").sum())
    remark = (
        "Elsewhere an asymmetric disturbance (sigma1 odd, psi1 even) has the larger Re(lambda); it "
        f"makes {turned} points unstable that are stable to symmetric ones."
    )
    return counted(same, total, remark)


def wedge_is_less_stable(
    wedge_10: xr.Dataset,
    cone_10: xr.Dataset,
    wedge_30: xr.Dataset,
    cone_30: xr.Dataset,
    smooth: xr.Dataset,
    *,
    much: float,
) -> Finding:
    least, where, points, reversed_, error = np.inf, 0.0, 0, 0, 0.0
    for wedge, cone in ((wedge_10, cone_10), (wedge_30, cone_30)):
        gap = values(wedge, "abscissa_symmetric", gaps=True) - _abscissae(cone)
        row = np.unravel_index(int(np.nanargmin(gap)), gap.shape)[0]
        points += int(np.isfinite(gap).sum())
        reversed_ += int(np.sum(_abscissae(wedge) < _abscissae(cone)))
        if np.nanmin(gap) < least:
            least, where = float(np.nanmin(gap)), float(values(wedge, "delta")[row])
            error = float(np.nanmax(values(wedge, "abscissa_error", gaps=True)))
    crossing = number(smooth, "crossing_delta")
    remark = (
        f"Least difference of the abscissae over {points} points of both maps, symmetric "
        f"disturbances of both, at delta = {where:.2f} deg; with asymmetric ones the wedge is the "
        f"more stable at {reversed_} points. Smooth-wall theory reverses the order below "
        f"{crossing:.2f} deg, where the smooth wedge has no radial solution of positive stress."
    )
    verdict = HOLDS if least >= much else LIMITED if _mostly(points, reversed_) else FAILS
    return Finding(least, error, verdict, remark)


def _mostly(points: int, exceptions: int) -> bool:
    return exceptions < points / 2


def figure_wedge_is_less_stable(
    wedge_10: xr.Dataset,
    cone_10: xr.Dataset,
    wedge_30: xr.Dataset,
    cone_30: xr.Dataset,
    *,
    much: float,
) -> Finding:
    gap = np.concatenate([_excess(wedge_10, cone_10), _excess(wedge_30, cone_30)])
    gap = gap[np.isfinite(gap)]
    less = int(np.sum(gap < much))
    remark = (
        f"At {less} of {gap.size} points of the curves, half angles 10 and 30 deg, it is not: next "
        "to a fold of the cone's solutions, where a real mode of the cone rises to 0."
    )
    error = float(np.nanmax(values(wedge_10, "abscissa_error", gaps=True)))
    verdict = HOLDS if not less else LIMITED if _mostly(gap.size, less) else FAILS
    return Finding(float(gap.min()), error, verdict, remark)


def _excess(wedge: xr.Dataset, cone: xr.Dataset) -> np.ndarray:
    """Return by how much the wedge's abscissa exceeds the cone's at the cone's frictions."""
    at = values(cone, "mu")
    rows = zip(at, values(wedge, "mu"), _abscissae(wedge), strict=True)
    return np.concatenate([np.interp(*row) for row in rows]) - _abscissae(cone).ravel()


def domain_shrinks_with_opening(
    domain: xr.Dataset,
    narrow: xr.Dataset,
    wide: xr.Dataset,
    *,
    considerable: float,
    narrow_angle: float,
    wide_angle: float,
) -> Finding:
    small, large = (number(domain, "area", half_angle=a) for a in (wide_angle, narrow_angle))
    errors = [number(domain, "area_error", half_angle=a) for a in (wide_angle, narrow_angle)]
    ratio = small / large
    error = ratio * (errors[0] / small + errors[1] / large)
    start = [float(values(data, "neutral_delta")[0]) for data in (narrow, wide)]
    outside, total = _outside(wide, narrow), values(wide, "neutral_delta").size
    falling = bool(np.all(np.diff(values(domain, "area")) < 0))
    remark = (
        f"Area {large:.0f} and {small:.0f} square degrees, delta up to 60 deg; falls over all half "
        f"angles computed: {'yes' if falling else 'no'}. Not everywhere: on smooth walls the wider "
        f"hopper is stable from {start[1]:.2f} deg, the narrower from {start[0]:.2f} deg; "
        f"{outside} of {total} points of the wider one's neutral curve lie outside the narrower's."
    )
    finding = below(ratio, 1 - considerable, error, remark)
    return limited(finding, bool(outside) or not falling)


def _outside(curve: xr.Dataset, other: xr.Dataset) -> int:
    """Count points of a neutral curve at a smaller delta than another's, at the same friction."""
    delta, phi = (values(other, f"neutral_{name}") for name in ("delta", "phi"))
    rising = np.concatenate([[True], np.diff(np.maximum.accumulate(phi)) > 0])
    there = np.interp(values(curve, "neutral_phi"), phi[rising], delta[rising])
    return int(np.sum(values(curve, "neutral_delta") < there))


def domain_is_inside_the_curve(narrow: xr.Dataset, wide: xr.Dataset) -> Finding:
    ends = [
        "delta = {:.4f}, phi = {:.4f} deg".format(
            *(values(data, f"neutral_{name}")[-1] for name in ("delta", "phi"))
        )
        for data in (narrow, wide)
    ]
    closed = [meaning(data, "neutral_end") == "fold" for data in (narrow, wide)]
    remark = (
        f"The neutral curves end in corners on the fold of the solutions: {'; '.join(ends)}. "
        "From there the fold bounds the domain, where a real mode is neutral. Towards large delta "
        "it is open as far as looked."
    )
    return counted(sum(closed), len(closed), remark)


def folds_are_neutral(linear: xr.Dataset, *, zero: float) -> Finding:
    modulus, error = (values(linear, f"fold_modulus{suffix}") for suffix in ("", "_error"))
    passed = np.abs(values(linear, "fold_before") - values(linear, "fold_behind")) == 1
    good = (modulus <= zero + error) & passed
    # Errors allow for more than the threshold: digits of rounding are none of the ledger's.
    bound = 10.0 ** np.ceil(np.log10(max(modulus.max(), zero)))
    remark = (
        f"Largest |lambda| {upper_bound(modulus.max(), bound)}; the number of growing real modes "
        "differs by one on the two sides. Such hoppers bound the domain without being on the curve "
        "that crosses it."
    )
    return counted(int(good.sum()), good.size, remark)
