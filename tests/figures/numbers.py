"""Layer 1: artifacts against stored references, within the tolerances of tolerances.yaml.

``PYTHONPATH=scripts python -m tests.figures.numbers OTHER/results`` prints how far the artifacts of
another machine or BLAS kernel are from those in results/, rule by rule: what ``measured`` records.
"""

import json
import sys
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
import xarray as xr
import yaml
from scipy.optimize import linear_sum_assignment

from hopper_workflow import reading
from tests.figures.registry import ROOT, plots

HERE = Path(__file__).parent
REFERENCES = HERE / "references"
Rule = dict[str, Any]
KINDS = ("absolute", "relative", "below")
_COORDINATES: Rule = {"relative": 1e-12}
_EXACT: Rule = {"absolute": 0.0}


@lru_cache(maxsize=1)
def tolerances() -> dict[str, dict[str, Any]]:
    """Return tolerances.yaml: for patterns of paths, what is thinned, left out, and compared."""
    loaded = yaml.safe_load((HERE / "tolerances.yaml").read_text(encoding="utf-8"))
    assert isinstance(loaded, dict)
    return loaded


def entry_of(artifact: str) -> dict[str, Any]:
    """Return the entry of tolerances.yaml for an artifact, a path below results/."""
    for pattern, entry in tolerances().items():
        if PurePosixPath(artifact).match(pattern):
            return entry
    raise KeyError(
        f"{artifact} feeds a figure: give its tolerances in tests/figures/tolerances.yaml"
    )


def compared_artifacts() -> list[str]:
    """Return the artifacts that feed a figure and are compared, as paths below results/."""
    feeding = {
        path.removeprefix("results/") for plot in plots().values() for path in plot.artifacts
    }
    return sorted(path for path in feeding if "left_out" not in entry_of(path))


def reference(data: xr.Dataset, entry: dict[str, Any]) -> xr.Dataset:
    """Return what is stored of an artifact: large arrays thinned, beside their means or counts."""
    thin = entry.get("thin", {})
    kept = data.isel({dimension: slice(None, None, step) for dimension, step in thin.items()})
    for name, values in data.data_vars.items():
        if not thin.keys() & set(values.dims):
            continue
        if values.dtype.kind == "f":
            finite = values.where(np.isfinite(values))
            kept[f"{name}_mean"] = finite.mean()
        else:
            kept[f"{name}_counts"] = (f"{name}_code", np.bincount(values.to_numpy().ravel()))
    return kept


def store(data: xr.Dataset, path: Path) -> None:
    """Write a reference. The classic format takes half the space for so many short arrays."""
    path.parent.mkdir(parents=True, exist_ok=True)
    encoding = {name: {"_FillValue": None} for name in data.variables}
    data.to_netcdf(path, engine="netcdf4", format="NETCDF3_64BIT", encoding=encoding)


def stored(artifact: str) -> xr.Dataset:
    """Return the reference of an artifact, a path below results/."""
    return xr.load_dataset(REFERENCES / artifact, engine="netcdf4")


def differences(data: xr.Dataset, expected: xr.Dataset, entry: dict[str, Any]) -> list[str]:
    """Return, a line each, where an artifact leaves its reference; an empty list if nowhere."""
    drawn_from, wanted = (json.loads(each.attrs["parameters"]) for each in (data, expected))
    changed = [key for key in drawn_from | wanted if drawn_from.get(key) != wanted.get(key)]
    if changed:
        return [f"made with other parameters than the reference: {', '.join(sorted(changed))}"]
    found = []
    for rule, name, deviation in deviations(data, expected, entry):
        (kind,) = rule.keys() & set(KINDS)
        if deviation == np.inf:
            found.append(f"{name}: shape, gaps, units or values that must be equal differ")
        elif not deviation <= rule[kind]:
            found.append(f"{name}: {kind} {deviation:.3g}, tolerance {rule[kind]:.3g}")
    return found


def deviations(
    data: xr.Dataset, stored: xr.Dataset, entry: dict[str, Any]
) -> Iterator[tuple[Rule, str, float]]:
    """Yield for every variable its rule and how far it is from the reference, in its measure.

    Infinite where shapes, gaps or exact values differ, or where no rule covers the variable.
    """
    rules = {name: rule for rule in entry["rules"] for name in names_of(rule)}
    drawn = reference(data, entry)
    for rule in entry["rules"]:
        if "spectrum" in rule:
            drawn = _matched(drawn, stored, rule["spectrum"])
        if "curve" in rule and rule["curve"][0] in stored:
            yield (
                rule,
                " over ".join(rule["curve"]),
                _distance_of_curves(drawn, stored, *rule["curve"]),
            )
    for name in map(str, {**drawn.variables, **stored.variables}):
        rule = _EXACT if name not in stored.coords else _COORDINATES
        rule = rules.get(name.removesuffix("_mean"), rule)
        if name not in drawn or name not in stored:
            yield rule, f"{name} (missing on one side)", np.inf
        elif rule is _EXACT and stored[name].dtype.kind == "f":
            yield rule, f"{name} (not in tolerances.yaml)", np.inf
        elif "curve" not in rule:
            yield rule, name, _deviation(rule, drawn[name], stored[name])


def names_of(rule: Rule) -> list[str]:
    """Return the variables a rule is for."""
    if "spectrum" in rule:
        return [f"{rule['spectrum']}_{part}" for part in ("real", "imag")]
    names: list[str] = rule.get("curve") or rule["variables"]
    return names


def _deviation(rule: Rule, drawn: xr.DataArray, stored: xr.DataArray) -> float:
    """Return the largest deviation of one variable; attributes and exact values count as well."""
    a, b = drawn.to_numpy(), stored.to_numpy()
    meaning = [
        {key: str(each.attrs.get(key)) for key in ("units", "flag_meanings")}
        for each in (drawn, stored)
    ]
    if a.shape != b.shape or meaning[0] != meaning[1]:
        return np.inf
    if b.dtype.kind != "f":
        return 0.0 if np.array_equal(a, b) else np.inf
    same = (a == b) | (np.isnan(a) & np.isnan(b))
    if not np.array_equal(np.isfinite(a) | same, np.isfinite(b) | same):
        return np.inf
    if "below" in rule:
        return float(np.max(np.abs(a[~np.isnan(a)]), initial=0.0))
    with np.errstate(divide="ignore"):
        change = np.abs(a[~same] - b[~same]) / (np.abs(b[~same]) if "relative" in rule else 1.0)
    return float(np.max(change, initial=0.0))


def _matched(drawn: xr.Dataset, stored: xr.Dataset, name: str) -> xr.Dataset:
    """Return the artifact with its modes in the order of the reference's, matched one to one.

    The order of an artifact's eigenvalues depends on rounding; so does any comparison by index.
    """
    if f"{name}_real" not in stored:
        return drawn
    (dimension,) = drawn[f"{name}_real"].dims
    if drawn.sizes[dimension] != stored.sizes[dimension]:
        return drawn
    distance = np.abs(_complex(stored, name)[:, None] - _complex(drawn, name))
    _, order = linear_sum_assignment(distance)
    return drawn.isel({dimension: order})


def _complex(data: xr.Dataset, name: str) -> np.ndarray:
    return np.asarray(data[f"{name}_real"].to_numpy() + 1j * data[f"{name}_imag"].to_numpy())


def _distance_of_curves(drawn: xr.Dataset, stored: xr.Dataset, x: str, y: str) -> float:
    """Return the Hausdorff distance of two polylines: where a curve has its points may differ."""
    p, q = (np.column_stack([each[x], each[y]]) for each in (drawn, stored))
    return float(max(_distance(p, q).max(), _distance(q, p).max()))


def _distance(points: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """Return the distance of each point from a polyline."""
    start, step = curve[:-1], np.diff(curve, axis=0)
    offset = points[:, None] - start
    along = np.clip((offset * step).sum(-1) / (step * step).sum(-1), 0, 1)
    nearest: np.ndarray = np.linalg.norm(offset - along[..., None] * step, axis=-1).min(axis=1)
    return nearest


def _print_spread(other: Path) -> None:
    largest: dict[str, float] = {}
    for artifact in compared_artifacts():
        entry = entry_of(artifact)
        key = next(key for key, value in tolerances().items() if value is entry)
        data, reading = (
            reading.read(root / artifact, stored=True) for root in (other, ROOT / "results")
        )
        for rule, name, deviation in deviations(data, reference(reading, entry), entry):
            if rule is not _COORDINATES and rule is not _EXACT:
                label = f"{key}: {name.removesuffix('_mean')}"
                largest[label] = max(deviation, largest.get(label, 0.0))
    for label, deviation in largest.items():
        print(f"{label}: {deviation:.1e}")


if __name__ == "__main__":
    _print_spread(Path(sys.argv[1]))
