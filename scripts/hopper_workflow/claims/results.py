"""Numbers out of artifacts; what is missing or not finite leaves a claim undecided."""

import json
from typing import Any

import numpy as np
import xarray as xr

from hopper_workflow.claims.finding import UndecidedError

_SAME = 1e-9


def values(data: xr.Dataset, name: str, *, gaps: bool = False, **labels: Any) -> np.ndarray:
    """Return a variable at the given coordinates, all of it finite unless ``gaps`` are allowed.

    Raises
    ------
    UndecidedError
        If the variable, a coordinate or a value is missing.
    """
    if name not in data:
        raise UndecidedError(f"the artifact has no {name}")
    array = data[name]
    for dimension, label in labels.items():
        array = array.isel({dimension: _position(data, dimension, label)})
    found = np.asarray(array.to_numpy())
    usable = np.isfinite(found) if found.dtype.kind in "fc" else np.ones(found.shape, dtype=bool)
    if not (usable.any() if gaps else usable.all()):
        raise UndecidedError(f"{name} has no value{_at(labels)}")
    return found


def number(data: xr.Dataset, name: str, **labels: Any) -> float:
    """Return one value, as :func:`values`."""
    return float(values(data, name, **labels))


def flagged(data: xr.Dataset, name: str, meaning: str) -> np.ndarray:
    """Return where a flag variable has the given meaning.

    Raises
    ------
    UndecidedError
        If the variable is missing.
    """
    return values(data, name) == meaning


def some(array: np.ndarray, what: str) -> np.ndarray:
    """Return an array that is not empty.

    Raises
    ------
    UndecidedError
        If it is.
    """
    if not array.size:
        raise UndecidedError(f"the artifact has no {what}")
    return array


def meaning(data: xr.Dataset, name: str) -> str:
    """Return the meaning of a flag that is a single value, as :func:`flagged`."""
    return str(values(data, name))


def parameters(data: xr.Dataset) -> dict[str, Any]:
    """Return what an artifact was made with; a hopper's parameters stand among the others."""
    made_with = json.loads(data.attrs["parameters"])
    return {**made_with, **made_with.get("hopper", {})}


def _position(data: xr.Dataset, dimension: str, label: Any) -> int:
    coordinate = data[dimension].to_numpy()
    if isinstance(label, str):
        found = np.flatnonzero(coordinate == label)
    else:
        found = np.flatnonzero(np.abs(coordinate - label) < _SAME)
    if not found.size:
        raise UndecidedError(f"the artifact has no {dimension} = {label}")
    return int(found[0])


def _at(labels: dict[str, Any]) -> str:
    return "".join(f", {name} = {label}" for name, label in labels.items())
