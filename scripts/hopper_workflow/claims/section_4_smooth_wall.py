"""Section 4, smooth walls: (4.3) to (4.10) and Figure 4.1."""

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
    limited,
    rounding,
    rounds,
)
from hopper_workflow.claims.results import flagged, number, some, values


def psi_is_small(linear: xr.Dataset, models: xr.Dataset, *, small: float) -> Finding:
    narrow = values(linear, "smooth_psi_max")
    wide = number(models, "psi_max", model="mohr-coulomb", mu=0)
    error = float(values(models, "error_radial").max())
    remark = f"Hopper of Figure 4.2 {narrow.max():.3f} deg, of Figure 3.1 {wide:.3f} deg."
    return below(max(float(narrow.max()), wide), small, error, remark)


def _formula(linear: xr.Dataset, geometry: str, small: float) -> Finding:
    return below(
        number(linear, "formula_error", geometry=geometry),
        small,
        rounding(1),
        "Against (4.3) by collocation, one to one.",
    )


def wedge_formula(linear: xr.Dataset, *, small: float) -> Finding:
    return _formula(linear, "wedge", small)


def cone_formula(linear: xr.Dataset, *, small: float) -> Finding:
    return _formula(linear, "cone", small)


def _all_in_pairs(
    linear: xr.Dataset, smooth: xr.Dataset, geometry: str, delta: float, formula: str
) -> Finding:
    missing = number(linear, "missing", geometry=geometry)
    if not missing:
        return Finding(0, 0.0, HOLDS, "(4.3) has no other eigenvalue.")
    highest = number(linear, "missing_real", geometry=geometry)
    line = number(smooth, "abscissa", geometry=geometry, delta=delta)
    return Finding(
        missing,
        0.0,
        LIMITED if highest < line else FAILS,
        f"Of (4.3) the pairs lack {missing:g}: {formula} = {highest:.4f}, with omega = 0, which is "
        f"lost in reducing to one equation; left of the line at {line:.4f}.",
    )


def wedge_eigenvalues_form_pairs(
    linear: xr.Dataset, smooth: xr.Dataset, *, delta: float
) -> Finding:
    return _all_in_pairs(linear, smooth, "wedge", delta, "(1 - 3s)/(1 - s)")


def cone_eigenvalues_form_pairs(linear: xr.Dataset, smooth: xr.Dataset, *, delta: float) -> Finding:
    return _all_in_pairs(linear, smooth, "cone", delta, "(1 - 5s)/(1 - s)")


def _neutral(smooth: xr.Dataset, linear: xr.Dataset, geometry: str, printed: Printed) -> Finding:
    closed = number(smooth, "neutral_delta", geometry=geometry)
    root = number(linear, "neutral_root", geometry=geometry)
    error = abs(closed - root) + rounding(closed)
    return rounds(printed, closed, error, f"Root of the eigenvalues themselves {root:.6f} deg.")


def neutral_wedge(smooth: xr.Dataset, linear: xr.Dataset, *, printed: Printed) -> Finding:
    return _neutral(smooth, linear, "wedge", printed)


def neutral_cone(smooth: xr.Dataset, linear: xr.Dataset, *, printed: Printed) -> Finding:
    return _neutral(smooth, linear, "cone", printed)


def _signs(smooth: xr.Dataset, geometry: str) -> Finding:
    delta = values(smooth, "delta")
    neutral = number(smooth, "neutral_delta", geometry=geometry)
    unstable = values(smooth, "abscissa", geometry=geometry) > 0
    right = unstable == (delta < neutral)
    remark = f"delta from {delta[0]:g} to {delta[-1]:g} deg."
    return counted(int(right.sum()), right.size, remark)


def wedge_unstable_below(smooth: xr.Dataset) -> Finding:
    return _signs(smooth, "wedge")


def cone_stable_above(smooth: xr.Dataset) -> Finding:
    return _signs(smooth, "cone")


def curves_cross(smooth: xr.Dataset, linear: xr.Dataset, *, printed: Printed) -> Finding:
    closed, root = number(smooth, "crossing_delta"), number(linear, "crossing_root")
    height = number(smooth, "crossing_abscissa")
    error = abs(closed - root) + rounding(closed)
    return rounds(printed, closed, error, f"Both abscissae are {height:.4f} there.")


def _cone_minus_wedge(smooth: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    wedge, cone = (values(smooth, "abscissa", geometry=g) for g in ("wedge", "cone"))
    return cone, cone - wedge


def both_unstable_cone_more(smooth: xr.Dataset, wedge_10: xr.Dataset) -> Finding:
    delta = values(smooth, "delta")
    crossing = number(smooth, "crossing_delta")
    wedge = values(smooth, "abscissa", geometry="wedge")
    cone, excess = _cone_minus_wedge(smooth)
    mine = delta < crossing
    right = (wedge > 0) & (cone > 0) & (excess > 0)
    no_stress = flagged(wedge_10, "region", "non_positive_stress")[:, 0]
    rows = values(wedge_10, "delta") < crossing
    finding = counted(
        int(right[mine].sum()),
        int(mine.sum()),
        f"But a smooth wedge has no radial solution of positive stress at {no_stress[rows].sum()} "
        f"of the {rows.sum()} such delta of the wedge's map.",
    )
    return limited(finding, bool(no_stress[rows].any()))


def both_stable_cone_more(smooth: xr.Dataset) -> Finding:
    delta = values(smooth, "delta")
    mine = delta > number(smooth, "neutral_delta", geometry="wedge")
    cone, excess = _cone_minus_wedge(smooth)
    right = (cone < 0) & (cone - excess < 0) & (excess < 0)
    remark = f"delta up to {delta[-1]:g} deg."
    return counted(int(right[mine].sum()), int(mine.sum()), remark)


def only_sine_modes_are_physical(wedge: xr.Dataset, exact: xr.Dataset) -> Finding:
    eigenvalues, kept = values(wedge, "eigenvalue"), flagged(wedge, "kept", "yes")
    physical = flagged(wedge, "half", "physical")
    lines, sine = values(exact, "eigenvalue"), flagged(exact, "kind", "sine")
    highest = some(eigenvalues[kept], "kept eigenvalue").imag.max()
    within = (lines.imag > 0) & (lines.imag <= highest)
    right = 0
    for value, odd in zip(lines[within], sine[within], strict=True):
        nearest = int(np.argmin(np.where(kept, np.abs(eigenvalues - value), np.inf)))
        right += int(physical[nearest] == odd)
    remark = "The nearest of M has sigma even and psi odd for a sine, the reverse for a cosine."
    return counted(right, int(within.sum()), remark)


def only_regular_bessel_modes_are_physical(cone: xr.Dataset) -> Finding:
    kept, mirrored = flagged(cone, "kept", "yes"), flagged(cone, "half", "mirrored")
    eigenvalues = values(cone, "eigenvalue")[kept]
    other = int(np.sum(kept & mirrored))
    remark = f"Of {eigenvalues.size} kept by the sound filter."
    return Finding(other, 0.0, FAILS if other else HOLDS, remark)


def _change(smooth: xr.Dataset, half_angle: float, variant: str) -> float:
    bessel, other = (
        values(smooth, "wavenumber", half_angle=half_angle, variant=name)
        for name in ("bessel", variant)
    )
    return float(np.max(np.abs(other / bessel - 1)))


def virtually_unchanged(
    smooth: xr.Dataset, linear: xr.Dataset, *, same: float, half_angle: float
) -> Finding:
    widest = float(values(smooth, "half_angle").max())
    remark = f"At half angle {widest:g} deg {_change(smooth, widest, 'kummer'):.1e}."
    error = number(linear, "formula_error", geometry="cone")
    return below(_change(smooth, half_angle, "kummer"), same, error, remark)


def cotangent_may_be_approximated(
    smooth: xr.Dataset, linear: xr.Dataset, *, same: float, half_angle: float
) -> Finding:
    widest = float(values(smooth, "half_angle").max())
    remark = (
        "Against Legendre functions, which solve (4.5) exactly; at half angle "
        f"{widest:g} deg {_change(smooth, widest, 'legendre'):.1e}."
    )
    error = number(linear, "formula_error", geometry="cone")
    return below(_change(smooth, half_angle, "legendre"), same, error, remark)


def confluent_hypergeometric_solution(linear: xr.Dataset, *, small: float) -> Finding:
    remark = "With the factor theta, which the scanned text seems to have lost."
    residual = number(linear, "kummer_residual")
    return Finding(residual, residual, below(residual, small, 0.0, "").verdict, remark)


def zeros_of_the_discriminant(linear: xr.Dataset, *, small: float) -> Finding:
    onset = number(linear, "onset_sine")
    printed = values(linear, "threshold")[-1]
    remark = f"Both {printed:.6f} at half angle {values(linear, 'half_angle')[-1]:g} deg."
    return below(abs(onset - printed), small, rounding(1), remark)


def largest_half_angle_in_radians(smooth: xr.Dataset, *, printed: Printed) -> Finding:
    angle = float(np.radians(number(smooth, "largest_half_angle")))
    return rounds(printed, angle, rounding(angle), "x_1 / sqrt(2).")


def largest_half_angle_in_degrees(smooth: xr.Dataset, *, printed: Printed) -> Finding:
    angle = number(smooth, "largest_half_angle")
    remark = "Half opening angles are below 90 deg, so it is never reached."
    return rounds(printed, angle, rounding(angle), remark)


def f_at_zero(linear: xr.Dataset, *, printed: Printed) -> Finding:
    return rounds(printed, number(linear, "threshold", half_angle=0), rounding(1), "Exactly 1.")


def f_at_quarter_pi(linear: xr.Dataset, *, printed: Printed) -> Finding:
    value = number(linear, "threshold", half_angle=45)
    error = abs(value - number(linear, "onset_sine")) + rounding(1)
    return rounds(printed, value, error, "Error from bisection on the eigenvalues.")


def f_decreases(linear: xr.Dataset) -> Finding:
    steps = np.diff(values(linear, "threshold"))
    angle = values(linear, "half_angle")
    remark = f"Largest step on {angle.size} angles from {angle[0]:g} to {angle[-1]:g} deg."
    return below(float(steps.max()), 0.0, rounding(1), remark)


def real_eigenvalues_only_above(linear: xr.Dataset, *, printed: Printed) -> Finding:
    onset = number(linear, "onset")
    return rounds(printed, onset, rounding(onset), "First real eigenvalue at half angle 45 deg.")


def all_complex_below(linear: xr.Dataset) -> Finding:
    found = number(linear, "real_below_onset")
    remark = f"For delta below {number(linear, 'onset'):.2f} deg and half angles up to 45 deg."
    return Finding(found, 0.0, HOLDS if found == 0 else FAILS, remark)


def smooth_wedge_at_35_is_unstable(smooth: xr.Dataset, *, delta: float) -> Finding:
    value = number(smooth, "abscissa", geometry="wedge", delta=delta)
    return above(value, 0.0, rounding(value), "(2 - 3s)/(1 - s).")


def smooth_cone_at_35_is_stable(smooth: xr.Dataset, *, delta: float) -> Finding:
    value = number(smooth, "abscissa", geometry="cone", delta=delta)
    return below(value, 0.0, rounding(value), "(5 - 9s)/(2(1 - s)).")
