"""Eigenvalues of two meshes, matched."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from hopper.arrays import Array, Complex, Mask
from hopper.errors import InvalidParameterError

Matching = Literal["nearest", "ordinal", "one-to-one"]


def relative_changes(fine: Complex, coarse: Complex, matching: Matching) -> Array:
    """Return each fine eigenvalue's relative distance to its partner on the coarse mesh.

    Parameters
    ----------
    fine, coarse : complex arrays, shapes (n,), (k,), k <= n
        By increasing modulus, conjugates in the same order in both (a stable sort).
    matching : "nearest", "ordinal" or "one-to-one"
        The nearest coarse eigenvalue, which several may share; the one of equal rank; or the
        one-to-one assignment of least total distance.

    Returns
    -------
    array, shape (n,)
        inf where there is no partner.
    """
    distance = np.abs(fine[:, None] - coarse) / np.abs(fine)[:, None]
    if matching == "nearest":
        return distance.min(axis=1)
    change = np.full(fine.size, np.inf)
    if matching == "ordinal":
        rows = columns = np.arange(coarse.size)
    else:
        # Distances beyond 1 count alike: eigenvalues without partner must not pull at others.
        rows, columns = linear_sum_assignment(np.minimum(distance, 1.0))
    change[rows] = distance[rows, columns]
    return change


def by_modulus(values: Complex) -> Complex:
    """Return values by increasing modulus; those of equal modulus keep their order."""
    return values[np.argsort(np.abs(values), kind="stable")]


def unbroken_run(kept: Mask) -> tuple[int, int]:
    """Return (start, stop) of the first unbroken run of kept eigenvalues by modulus.

    Raises
    ------
    InvalidParameterError
        If nothing is kept.
    """
    if not kept.any():
        raise InvalidParameterError("no eigenvalue is kept: there is no run")
    start = int(np.argmax(kept))
    rejected = np.flatnonzero(~kept[start:])
    return start, start + int(rejected[0]) if rejected.size else kept.size


# Largest relative distance between a wanted eigenvalue and the one found on the mesh.
_SAME = 1e-6


def match_kept(kept: Complex, values: Complex) -> NDArray[np.intp]:
    """Return the index among ``values`` of each kept eigenvalue, one to one, shape (k,).

    Raises
    ------
    InvalidParameterError
        If one of them is further away than rounding allows.
    """
    distance = np.abs(kept[:, None] - values) / np.abs(kept)[:, None]
    rows, columns = linear_sum_assignment(np.minimum(distance, 1.0))
    missing = int(np.sum(distance[rows, columns] > _SAME))
    if missing or kept.size > values.size:
        raise InvalidParameterError(
            f"{missing or kept.size - values.size} kept eigenvalues are not on this mesh: filter "
            "the spectrum of the same hopper and mesh again"
        )
    return columns
