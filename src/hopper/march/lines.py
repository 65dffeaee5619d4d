"""Characteristics down to a time, as a net to look at."""

from dataclasses import dataclass

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array, Mask
from hopper.brief import brief
from hopper.march.base import Base
from hopper.march.net import TAU, THETA, make_net, rows
from hopper.march.tops import Top, require_admissible, riemann_deviation


@dataclass(frozen=True, eq=False)
class Lines:
    """Pieces of characteristics: tau and theta (radians) of both ends, shape (n, 2).

    ``forward`` is true for C+, which lead to larger theta.
    """

    tau: Array
    theta: Array
    forward: Mask

    __repr__ = brief("tau", "theta deg")


@checked
def characteristics(base: Base, top: Top, cells: int, tau_end: float) -> Lines:
    """Return the net of characteristics with ``cells`` over the angles marched, up to ``tau_end``.

    Of a symmetric stress it is mirrored to the other half.

    Raises
    ------
    InvalidParameterError, TangencyError
        As :func:`hopper.march.outcome.march`.
    """
    require_admissible(base, top)
    net = make_net(base, top.symmetric)
    pieces, previous = [], None
    with np.errstate(all="ignore"):
        for row in rows(net, cells, lambda x: riemann_deviation(base, top, x)):
            now = row[[TAU, THETA]]
            if previous is not None:
                pieces += _pieces(previous, now)
            previous = now
            if not now[0].min() <= tau_end:
                break
    # Shape (tau and theta, pieces, ends).
    ends = np.concatenate([piece for piece, _ in pieces], axis=1)
    forward = np.concatenate([np.full(piece.shape[1], sign) for piece, sign in pieces])
    kept = np.isfinite(ends).all(axis=(0, 2)) & (ends[0] <= tau_end).all(axis=1)
    tau, theta, forward = ends[0, kept], ends[1, kept], forward[kept]
    if top.symmetric:
        tau = np.concatenate([tau, tau])
        theta, forward = np.concatenate([theta, -theta]), np.concatenate([forward, -forward])
    return Lines(tau, theta, forward > 0)


def _pieces(row: Array, following: Array) -> list[tuple[Array, float]]:
    """Return the pieces of C+ and C- between two rows, each (2, n, 2), and their signs."""
    if row.shape < following.shape:
        plus, minus = following[:, 1:], following[:, :-1]
        return [(np.stack([row, plus], axis=2), 1.0), (np.stack([row, minus], axis=2), -1.0)]
    plus, minus = row[:, :-1], row[:, 1:]
    return [
        (np.stack([plus, following], axis=2), 1.0),
        (np.stack([minus, following], axis=2), -1.0),
    ]
