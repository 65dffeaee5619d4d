"""Eigenvalues of two meshes, matched."""

from typing import Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from hopper.arguments import ComplexRow, checked
from hopper.arrays import Array, Complex, Mask
from hopper.errors import InvalidParameterError
from hopper.spectral.scaling import times_power
from hopper.values import require_row

Matching = Literal["nearest", "ordinal", "one-to-one"]


@checked
def relative_changes(fine: ComplexRow, coarse: ComplexRow, matching: Matching) -> Array:
    """Return each fine eigenvalue's relative distance to its partner on the coarse mesh.

    Parameters
    ----------
    fine, coarse : complex arrays, shapes (n,), (k,)
        By increasing modulus, conjugates in the same order in both (a stable sort).
    matching : "nearest", "ordinal" or "one-to-one"
        The nearest coarse eigenvalue, which several may share; the one of equal rank; or the
        one-to-one assignment of least total distance.

    Returns
    -------
    array, shape (n,)
        inf where there is no partner.

    Raises
    ------
    InvalidParameterError
        If the eigenvalues are not two rows of finite numbers, or the matching is unknown.

    Examples
    --------
    >>> from numpy import array
    >>> from hopper.spectral.matching import relative_changes
    >>> relative_changes(array([1.0 + 0j, 2.0]), array([1.0 + 0j, 2.1]), "nearest")
    array([0.  , 0.05])
    """
    distance = _relative_distances(fine, coarse)
    if matching == "nearest":
        return distance.min(axis=1, initial=np.inf)
    change = np.full(fine.size, np.inf)
    if matching == "ordinal":
        rows = columns = np.arange(min(fine.size, coarse.size))
    else:
        # Distances beyond 1 count alike: eigenvalues without partner must not pull at others.
        rows, columns = scipy.optimize.linear_sum_assignment(np.minimum(distance, 1.0))
    change[rows] = distance[rows, columns]
    return change


def _relative_distances(values: Complex, partners: Complex) -> Array:
    """Return |values - partners| / |values|, shape (n, k); 0 where both are 0."""
    # A quarter of each, so that no modulus exceeds the largest number.
    values, partners = times_power(values, -2), times_power(partners, -2)
    distance = np.abs(values[:, None] - partners)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.where(distance == 0, 0.0, distance / np.abs(values)[:, None])


@checked
def by_modulus(values: ComplexRow) -> Complex:
    """Return values by increasing modulus; those of equal modulus keep their order.

    Raises
    ------
    InvalidParameterError
        If the values are not a row of finite numbers.
    """
    return values[np.argsort(np.abs(times_power(values, -1)), kind="stable")]


@checked
def unbroken_run(kept: Mask) -> tuple[int, int]:
    """Return (start, stop) of the first unbroken run of kept eigenvalues by modulus.

    Raises
    ------
    InvalidParameterError
        If nothing is kept, or that is not a row of truth values.
    """
    if not require_row("kept", kept).any():
        raise InvalidParameterError("no eigenvalue is kept: there is no run")
    start = int(np.argmax(kept))
    rejected = np.flatnonzero(~kept[start:])
    return start, start + int(rejected[0]) if rejected.size else kept.size


# Largest relative distance between a wanted eigenvalue and the one found on the mesh.
_SAME = 1e-6


@checked
def match_kept(kept: ComplexRow, values: ComplexRow) -> NDArray[np.intp]:
    """Return the index among ``values`` of each kept eigenvalue, one to one, shape (k,).

    Raises
    ------
    InvalidParameterError
        If one of them is further away than rounding allows.
    """
    distance = _relative_distances(kept, values)
    rows, columns = scipy.optimize.linear_sum_assignment(np.minimum(distance, 1.0))
    missing = int(np.sum(distance[rows, columns] > _SAME))
    if missing or kept.size > values.size:
        raise InvalidParameterError(
            f"{missing or kept.size - values.size} kept eigenvalues are not on this mesh: filter "
            "the spectrum of the same hopper and mesh again"
        )
    return columns
