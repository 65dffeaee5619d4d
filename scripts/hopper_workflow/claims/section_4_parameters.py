"""Section 4: wall friction, internal friction and opening angle, Figures 4.4 and 4.5."""

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import FAILS, HOLDS, LIMITED, Finding, below, counted, limited
from hopper_workflow.claims.results import number, values


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
        f"{_named(good, *artifacts)} Curves end at the tangency or at mu = "
        f"{values(wedge_10, 'mu')[-1]:g}.",
    )


def friction_range_is_regular(
    wedge_10: xr.Dataset, cone_10: xr.Dataset, wedge_30: xr.Dataset, cone_30: xr.Dataset
) -> Finding:
    artifacts = (wedge_10, cone_10, wedge_30, cone_30)
    last = float(values(wedge_10, "mu")[-1])
    ends = np.concatenate([values(data, "tangency_mu") for data in artifacts])
    return counted(
        int(np.sum(ends > last)),
        ends.size,
        f"Range plotted: mu up to {last:g}. The earliest tangency is at mu = {ends.min():.3f}.",
    )


def wedge_is_less_stable(
    wedge_10: xr.Dataset,
    cone_10: xr.Dataset,
    wedge_30: xr.Dataset,
    cone_30: xr.Dataset,
    smooth: xr.Dataset,
    *,
    much: float,
) -> Finding:
    least, where, points, error = np.inf, 0.0, 0, 0.0
    for wedge, cone in ((wedge_10, cone_10), (wedge_30, cone_30)):
        gap = values(wedge, "abscissa", gaps=True) - values(cone, "abscissa", gaps=True)
        row = np.unravel_index(int(np.nanargmin(gap)), gap.shape)[0]
        points += int(np.isfinite(gap).sum())
        if np.nanmin(gap) < least:
            least, where = float(np.nanmin(gap)), float(values(wedge, "delta")[row])
            error = float(np.nanmax(values(wedge, "abscissa_error", gaps=True)))
    crossing = number(smooth, "crossing_delta")
    remark = (
        f"Least difference of the abscissae over {points} points of both maps, at delta = "
        f"{where:.2f} deg. Smooth-wall theory reverses the order below {crossing:.2f} deg, where "
        "the smooth wedge has no radial solution of positive stress."
    )
    verdict = HOLDS if least >= much else LIMITED if least > error else FAILS
    return Finding(least, error, verdict, remark)


def figure_wedge_is_less_stable(
    wedge_10: xr.Dataset,
    cone_10: xr.Dataset,
    wedge_30: xr.Dataset,
    cone_30: xr.Dataset,
    *,
    much: float,
) -> Finding:
    gaps = [
        values(wedge, "abscissa", gaps=True) - values(cone, "abscissa", gaps=True)
        for wedge, cone in ((wedge_10, cone_10), (wedge_30, cone_30))
    ]
    known = [gap[np.isfinite(gap)] for gap in gaps]
    least = min(float(gap.min()) for gap in known)
    remark = (
        f"Over {sum(gap.size for gap in known)} points of the curves, half angles 10 and 30 deg."
    )
    error = float(np.nanmax(values(wedge_10, "abscissa_error", gaps=True)))
    turned = below(-least, -much, error, remark)
    return Finding(least, error, turned.verdict, remark)


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
    start = [float(values(data, "neutral_delta", point=0)) for data in (narrow, wide)]
    falling = bool(np.all(np.diff(values(domain, "area")) < 0))
    remark = (
        f"Area {large:.0f} and {small:.0f} square degrees, delta up to 60 deg; falls over all half "
        f"angles computed: {'yes' if falling else 'no'}. Not everywhere: on smooth walls the wider "
        f"hopper is stable from {start[1]:.2f} deg, the narrower from {start[0]:.2f} deg."
    )
    finding = below(ratio, 1 - considerable, error, remark)
    return limited(finding, start[1] < start[0] or not falling)


def domain_is_inside_the_curve(narrow: xr.Dataset, wide: xr.Dataset, *, close: float) -> Finding:
    ends, gaps = [], []
    for data in (narrow, wide):
        delta, phi = (values(data, f"neutral_{name}")[-1] for name in ("delta", "phi"))
        tangency = np.interp(delta, values(data, "delta"), values(data, "tangency_phi", gaps=True))
        ends.append(float(phi))
        gaps.append(float(abs(tangency - phi)))
    closed = all(end == 0 for end in ends)
    verdict = HOLDS if closed else LIMITED if max(gaps) <= close else FAILS
    remark = (
        f"The neutral curves end at phi = {ends[0]:.2f} and {ends[1]:.2f} deg, on the tangency; "
        "from there the tangency, not neutral stability, bounds the domain."
    )
    return Finding(max(ends), max(gaps), verdict, remark)
