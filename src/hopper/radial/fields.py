"""Stress fields of several radial solutions at once."""

from collections.abc import Sequence

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.errors import InvalidParameterError
from hopper.radial.collocation import Member, moved
from hopper.radial.equations import slopes
from hopper.radial.grid import Grid


@checked
def stacked_fields(
    members: Sequence[Member], grids: Sequence[Grid]
) -> tuple[Array, Array, Array, Array]:
    """Return sigma, psi and their slopes by theta of members of one hopper, on half grids.

    Each of shape (members, points), the points of one grid after the other; as
    :meth:`hopper.radial.solution.RadialSolution.fields`.

    Raises
    ------
    InvalidParameterError
        If there is no member or no grid, or the members are not of one hopper.
    """
    if not grids or not members:
        raise InvalidParameterError("members or grids is empty: give one at least")
    hopper = members[0].hopper
    together: dict[Grid, list[int]] = {}
    for row, member in enumerate(members):
        if member.hopper != hopper:
            raise InvalidParameterError("members are not of one hopper: give those of one")
        together.setdefault(member.grid, []).append(row)
    angles = np.concatenate([grid.theta for grid in grids])
    log_sigma, psi = np.empty((2, len(members), angles.size))
    for own, rows in together.items():
        u = np.array([members[row].u for row in rows])
        on = [(grid.size, moved(u, own, grid)) for grid in grids]
        log_sigma[rows] = np.concatenate([part[:, :m] for m, part in on], axis=1)
        log_sigma[rows] -= np.log(u[:, -1:])
        psi[rows] = np.concatenate([part[:, m:-1] for m, part in on], axis=1)
    sigma = np.exp(log_sigma)
    found = slopes(hopper, np.tile(angles, len(members)), sigma.ravel(), psi.ravel())
    dlog, dpsi = (slope.reshape(psi.shape) for slope in found)
    return sigma, psi, sigma * dlog, dpsi
