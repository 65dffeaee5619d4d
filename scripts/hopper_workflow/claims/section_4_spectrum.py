"""Section 4: the linearised equations (4.1), their discrete spectra and Figure 4.2."""

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
    limited,
    rounding,
)
from hopper_workflow.claims.results import flagged, meaning, number, some, values

# Decimal digits of a condition number beyond which double precision makes it smaller.
_RESOLVED_DIGITS = 13.0


def equations_as_printed(linear: xr.Dataset, *, small: float) -> Finding:
    ratio = values(linear, "printed_ratio")
    spread = float(values(linear, "printed_spread").max())
    off = np.abs(ratio - 1)
    value = float(ratio.flat[int(np.argmax(off))])
    if off.max() <= small:
        return Finding(value, spread, HOLDS, "All entries of A, B and C agree.")
    upper, lower, diagonal = ratio[:, 0, 1], ratio[:, 1, 0], ratio[:, [0, 1], [0, 1]]
    remark = (
        f"Means over A, B and C: {upper.mean():.6g} in entries 12, {lower.mean():.6g} in entries "
        f"21, {diagonal.mean():.6g} on the diagonals. This is the system for (sigma1, "
        f"psi1/{upper.mean():.6g})."
    )
    return Finding(value, spread, FAILS, remark)


def spectrum_as_printed(linear: xr.Dataset, *, small: float) -> Finding:
    ratio = values(linear, "printed_ratio")
    scale = ratio[0, 0, 1]
    wanted = np.array([[1, scale], [1 / scale, 1]])
    remark = f"(4.1) is the derived system for the unknowns (sigma1, psi1/{scale:g})."
    error = float(values(linear, "printed_spread").max())
    return below(float(np.abs(ratio / wanted - 1).max()), small, error, remark)


def matrix_size(wedge: xr.Dataset, cone: xr.Dataset, *, printed: Printed) -> Finding:
    sizes = {values(data, "eigenvalue").size for data in (wedge, cone)}
    right = sizes == {int(printed.value)}
    return Finding(max(sizes), 0.0, HOLDS if right else FAILS, "Number of eigenvalues, 2 N - 2.")


def figure_wedge_is_unstable(stability: xr.Dataset) -> Finding:
    error = number(stability, "abscissa_error")
    return above(number(stability, "abscissa"), 0.0, error, _governed(stability))


def figure_cone_is_stable(stability: xr.Dataset) -> Finding:
    error = number(stability, "abscissa_error")
    return below(number(stability, "abscissa"), 0.0, error, _governed(stability))


def _governed(stability: xr.Dataset) -> str:
    highest = values(stability, "eigenvalue").real.max()
    line = number(stability, "line")
    governor = meaning(stability, "governed_by")
    return f"Governed by the {governor}: highest low mode {highest:.6f}, line {line:.6f}."


def _agreement(spectrum: xr.Dataset, exact: xr.Dataset, kind: str, same: float) -> Finding:
    kept = flagged(spectrum, "kept", "yes") & flagged(spectrum, "half", "physical")
    computed = some(values(spectrum, "eigenvalue")[kept], "kept eigenvalue")
    theory = values(exact, "eigenvalue")[flagged(exact, "kind", kind)]
    within = np.abs(theory.imag) <= np.abs(computed.imag).max()
    theory = some(theory[within], "eigenvalue of theory within the computed range")
    distance = np.abs(theory[:, None] - computed) / np.abs(theory)[:, None]
    nearest = distance.min(axis=1)
    change = values(spectrum, "change", gaps=True)[kept]
    first, farthest = int(np.argmin(np.abs(theory))), int(np.argmax(nearest))
    partner = distance.argmin(axis=1)
    remark = (
        f"{nearest.size} eigenvalues; Re of the lowest {computed[partner[first]].real:.4f} "
        f"against {theory[first].real:.4f}."
    )
    return below(float(nearest.max()), same, float(change[partner[farthest]]), remark)


def wedge_agrees_with_theory(spectrum: xr.Dataset, exact: xr.Dataset, *, same: float) -> Finding:
    return _agreement(spectrum, exact, "sine", same)


def cone_agrees_with_theory(spectrum: xr.Dataset, exact: xr.Dataset, *, same: float) -> Finding:
    return _agreement(spectrum, exact, "bessel", same)


def _first_250(spectrum: xr.Dataset, printed: Printed, about: float) -> Finding:
    start, stop = (int(number(spectrum, f"run_{end}")) for end in ("start", "stop"))
    kept = flagged(spectrum, "kept_as_worded", "yes")
    remark = (
        f"Unbroken run from number {start + 1} to {stop} by modulus; the filter as worded keeps "
        f"{int(kept.sum())} in all."
    )
    finding = below(abs(stop - start - printed.value), about, 0.0, remark)
    return limited(Finding(stop - start, 0.0, finding.verdict, remark), start > 0)


def first_250_of_the_wedge(spectrum: xr.Dataset, *, printed: Printed, about: float) -> Finding:
    return _first_250(spectrum, printed, about)


def first_250_of_the_cone(spectrum: xr.Dataset, *, printed: Printed, about: float) -> Finding:
    return _first_250(spectrum, printed, about)


def _displayed(spectrum: xr.Dataset) -> np.ndarray:
    start, stop = (int(number(spectrum, f"run_{end}")) for end in ("start", "stop"))
    return np.arange(spectrum.sizes["mode"])[start:stop]


def _no_artefacts(spectrum: xr.Dataset, few: float) -> Finding:
    eigenvalues, shown = values(spectrum, "eigenvalue"), _displayed(spectrum)
    resolved = flagged(spectrum, "kept", "yes")[shown]
    mirrored = flagged(spectrum, "half", "mirrored")[shown]
    bad = int(np.sum(~resolved))
    share = bad / shown.size
    verdict = HOLDS if not bad else LIMITED if share <= few else FAILS
    moduli = np.abs(eigenvalues[shown][~resolved])
    other = int(np.sum(~resolved & mirrored))
    remark = f"{bad} of {shown.size} displayed have eigenvectors that the mesh does not resolve"
    if bad:
        remark += (
            f", {other} of these of the parity that is not the flow's; "
            f"|lambda| {moduli.min():.1f} to {moduli.max():.1f}"
        )
    return Finding(bad, 0.0, verdict, f"{remark}.")


def displayed_wedge_is_converged(spectrum: xr.Dataset, *, few: float) -> Finding:
    return _no_artefacts(spectrum, few)


def displayed_cone_is_converged(spectrum: xr.Dataset, *, few: float) -> Finding:
    return _no_artefacts(spectrum, few)


def filter_removes_false_growth(
    spectrum: xr.Dataset, stability: xr.Dataset, *, close: float
) -> Finding:
    eigenvalues = values(spectrum, "eigenvalue")
    true = number(stability, "abscissa")
    highest = float(eigenvalues[_displayed(spectrum)].real.max())
    kept = flagged(spectrum, "kept_as_worded", "yes")
    rejected = eigenvalues[~kept].real.max(initial=-np.inf)
    remark = f"Displayed {highest:.5f}, true {true:.5f}; largest one rejected {rejected:.3f}."
    return below(abs(highest - true), close, number(stability, "abscissa_error"), remark)


def first_derivative_is_sensitive(linear: xr.Dataset, *, extraordinary: float) -> Finding:
    digits = number(linear, "derivative_digits_lost")
    error = number(linear, "derivative_digits_lost_error")
    if digits - error > _RESOLVED_DIGITS:
        remark = "At least: double precision does not resolve larger condition numbers."
        return above(_RESOLVED_DIGITS, extraordinary, 0.0, remark)
    return above(digits, extraordinary, error, "The error is the change from the coarse mesh.")


def first_derivative_has_no_eigenvalues(linear: xr.Dataset, *, few: float) -> Finding:
    agreeing, size = number(linear, "derivative_agreeing"), number(linear, "derivative_size")
    share = agreeing / size
    verdict = below(share, few, 0.0, "").verdict
    # Rounding decides which neighbours agree by chance: no digit of the share is known.
    return Finding(share, max(share, 1 / size), verdict, f"Of {size:g}; as neighbours may.")


def like_a_second_order_operator(
    wedge: xr.Dataset, cone: xr.Dataset, *, resolved: float, about: float, nodes: float
) -> Finding:
    shares = [
        (number(data, "run_stop") - number(data, "run_start")) / nodes for data in (wedge, cone)
    ]
    farthest = max(shares, key=lambda share: abs(share - resolved))
    remark = f"Wedge {shares[0]:.3f}, cone {shares[1]:.3f}."
    finding = below(abs(farthest - resolved), about, 1 / nodes, remark)
    return Finding(farthest, 1 / nodes, finding.verdict, remark)


def _mildly_sensitive(paper: xr.Dataset, physical: xr.Dataset, mild: float) -> Finding:
    condition, sound = (float(values(data, "condition").max()) for data in (paper, physical))
    distance = number(paper, "distance")
    remark = (
        f"With the flow's parity alone, in the L2 norm, {sound:.3g}. The least perturbation that "
        f"puts an eigenvalue on the imaginary axis has size {distance:.3g}."
    )
    return below(condition, mild, rounding(condition), remark)


def wedge_is_mildly_sensitive(paper: xr.Dataset, physical: xr.Dataset, *, mild: float) -> Finding:
    return _mildly_sensitive(paper, physical, mild)


def cone_is_mildly_sensitive(paper: xr.Dataset, physical: xr.Dataset, *, mild: float) -> Finding:
    return _mildly_sensitive(paper, physical, mild)


def _aligned(spectrum: xr.Dataset, roughly: float) -> Finding:
    shown = values(spectrum, "eigenvalue")[_displayed(spectrum)]
    alpha = float(shown.real.max())
    off = alpha - shown.real > roughly
    waves = some(shown[shown.imag != 0], "complex eigenvalue displayed")
    change = values(spectrum, "change", gaps=True)[_displayed(spectrum)]
    spread = float(alpha - waves.real.min())
    remark = (
        f"alpha(M) = {alpha:.4f}; {int(off.sum())} of {shown.size} lie further left: "
        f"{', '.join(f'{x.real:.4f}' for x in shown[off]) or 'none'}."
    )
    error = float(np.min(np.abs(waves)) * np.median(change))
    return limited(below(spread, roughly, error, remark), bool(off.any()))


def wedge_spectrum_is_vertical(spectrum: xr.Dataset, *, roughly: float) -> Finding:
    return _aligned(spectrum, roughly)


def cone_spectrum_is_vertical(spectrum: xr.Dataset, *, roughly: float) -> Finding:
    return _aligned(spectrum, roughly)
