"""The largest wall friction over a box, interpolated: whether a radial solution can exist.

To find that there is none costs more than to find one, and a search along the border of existence
asks often. The limit is smooth over (delta, half angle) but for where another end of the family
takes over; how far the interpolant is off is tested, and within that nothing is claimed.
"""

from itertools import product

import numpy as np

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.errors import HopperError
from hopper.radial.friction_limit import friction_limit
from hopper.roots import root_between
from hopper.uncertainty.box import Box
from hopper.uncertainty.interpolation import interpolated, interpolation_nodes
from hopper.uncertainty.sampling import points_in_box

# Nodes in one range and in two, points of the test (a power of 2), and what is claimed beside it.
_NODES, _TESTS, _SAFETY, _LEAST = {0: 1, 1: 9, 2: 5}, 0, 3.0, 1e-8


class FrictionLimits:
    """An interpolant of the largest friction angle over the ranges of delta and half angle."""

    def __init__(self, box: Box) -> None:
        self.box = box
        self.own = [i for i, name in enumerate(box.ranged) if name != "wall"]
        count = _NODES[len(self.own)]
        grid = product(interpolation_nodes(count), repeat=len(self.own))
        found = np.array([self._limit(np.array(node)) for node in grid])
        # Of friction angles, and of log(tau) at the end of the branch.
        self.tables = found.T.reshape([2, *[count] * len(self.own)])
        self.margin, self.tau_margin = _LEAST, _LEAST
        if self.own:
            tests = points_in_box(len(self.own), _TESTS).reshape(-1, len(self.own))
            between = [[self._interpolated(table, test) for table in self.tables] for test in tests]
            off = np.abs(np.subtract([self._limit(test) for test in tests], between))
            self.margin, self.tau_margin = _LEAST + _SAFETY * off.max(axis=0)

    @checked
    def exclude(self, point: RealRow) -> bool:
        """Whether the wall at a point of the box is surely too rough for a radial solution."""
        place = np.asarray(point, dtype=float)
        if np.any((place < 0) | (place > 1)):
            return False
        # NaN, where a node is not resolved, excludes nothing.
        return self._below(place) < -self.margin

    @checked
    def thickest(self, point: RealRow) -> float:
        """Return a tau that the physical branch surely reaches at a point of the box, or 0."""
        place = np.asarray(point, dtype=float)
        if np.any((place < 0) | (place > 1)):
            return 0.0
        log_tau = self._interpolated(self.tables[1], place[self.own]) - self.tau_margin
        return float(np.exp(log_tau)) if np.isfinite(log_tau) else 0.0

    @checked
    def border(self, rest: RealRow, margins: float = 1.0) -> Array | None:
        """Return the point where radial solutions end, that many margins before it.

        The last of the wall, the half angle and delta that has a range is followed, at the other
        coordinates ``rest``. None where there are solutions all along it, or nowhere.
        """
        names = [name for name in ("wall", "half_angle", "delta") if name in self.box.ranged]
        axis = self.box.ranged.index(names[0])

        def below(place: float) -> float:
            at = np.insert(np.asarray(rest, dtype=float), axis, place)
            return self._below(at) - margins * self.margin

        ends = below(0.0), below(1.0)
        if not ends[0] * ends[1] < 0:
            return None
        place = root_between(below, 0.0, 1.0, xtol=1e-12)
        return np.insert(np.asarray(rest, dtype=float), axis, place)

    def _below(self, place: Array) -> float:
        """Return how far the wall at a point is below the largest friction angle."""
        material, _ = self.box.hopper(place)
        return self._interpolated(self.tables[0], place[self.own]) - material.friction_angle

    def _limit(self, part: Array) -> tuple[float, float]:
        """Return the largest friction angle, and log(tau) there where it is a fold."""
        point = self.box.middle.copy()
        point[self.own] = part
        material, half_angle = self.box.hopper(point)
        try:
            found = friction_limit(material.hopper(half_angle))
        except HopperError:
            return np.nan, np.nan
        return found.friction_angle, np.log(found.tau) if found.end == "fold" else np.nan

    @staticmethod
    def _interpolated(table: Array, part: Array) -> float:
        if np.isnan(table).any():
            return np.nan
        return float(interpolated(table, part[None])[0])
