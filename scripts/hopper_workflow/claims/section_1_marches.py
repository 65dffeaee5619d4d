"""Section 1: what becomes of stresses that are not radial."""

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import Finding, counted
from hopper_workflow.claims.results import flagged, values


def non_radial_solutions_break_down(marches: xr.Dataset) -> Finding:
    broken = flagged(marches, "breakdown_kind", "crossing")
    eps = values(marches, "eps")
    least = [
        f"{name} from eps = {eps[row].min():g} on" if row.any() else f"{name} at none"
        for name, row in zip(values(marches, "hopper"), broken, strict=True)
    ]
    return counted(
        int(broken.sum()), broken.size, f"Of the amplitudes looked at: {', '.join(least)}."
    )


def flow_is_approximately_radial(marches: xr.Dataset, *, half_way: float) -> Finding:
    near = values(marches, "settled", gaps=True, level=0.05) >= half_way
    ends = {
        word: int(np.sum(flagged(marches, "breakdown_kind", kind)))
        for word, kind in (("break down", "crossing"), ("break at a kink", "kink"))
    }
    told = " and ".join(f"{count} {word}" for word, count in ends.items())
    tops = values(marches, "top")
    always = [str(top) for top, column in zip(tops, near.T, strict=True) if column.all()]
    return counted(
        int(near.sum()),
        near.size,
        f"Of the others {told}. In all hoppers for these tops: {', '.join(always) or 'none'}.",
    )
