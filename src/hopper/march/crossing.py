"""First crossing of characteristics on the net, and its limit for vanishing spacing.

Breakdown is where two lines of one family first cross: slopes of the stress are infinite there
while the stress itself is bounded. It shows in the gap in theta between neighbouring lines, taken
along the lines of the other family; a gap in tau would also vanish at a tangency.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.history import Report
from hopper.march.net import MINUS, PLUS, SLOPES, TAU, THETA, Net, rows

# Rows through whose gaps the crossing of a pair is interpolated, and neighbours of the first pair
# to cross through whose crossings the first time is: both errors are below that of the net.
_ROWS, _NEIGHBOURS = 5, 2
_NEWTON_STEPS = 8
# Rows behind the first crossing in which its neighbours must have crossed, or never will.
_PATIENCE = 12
_SIZES = (64, 128, 256, 512)
# Pairs of rows between two reports.
_BETWEEN = 200
# Quotients of successive changes that count as those of a method of first or second order.
_QUOTIENTS = {1: (1.6, 2.5), 2: (2.8, 5.6)}
# Error relative to tau with which a crossing that involves a kink counts as placed.
_PLACED = 5e-3
# Least error of an extrapolation, over the last change of what is extrapolated.
_LEAST = 1e-3


@dataclass(frozen=True)
class Crossing:
    """Where two characteristics of a family first cross.

    Attributes
    ----------
    tau : float
    theta : float
        Radians; not negative in a symmetric stress.
    family : 1 or -1
        C+ or C-.
    error : float
        Of ``tau``.
    """

    tau: float
    theta: float
    family: Literal[1, -1]
    error: float

    __repr__ = brief("tau", "error", "theta deg", "family")


@dataclass(frozen=True)
class NetVerdict:
    """What nets of several spacings say of a crossing.

    ``crossing`` is None if no net shows one, or if the times on the nets do not converge
    (``converging`` False). ``first_tau`` is the crossing's, or the earliest on any net.
    """

    crossing: Crossing | None
    converging: bool
    first_tau: float | None

    __repr__ = brief("converging", "first_tau")


@dataclass
class _Watch:
    """Gaps of the last rows by pairs of lines, and the crossings found in them.

    Gaps are arrays with the rows gap, tau, theta and family; crossings are (tau, theta, family).
    ``overdue`` counts the rows behind the first crossing.
    """

    last: list[Array] = field(default_factory=list)
    found: dict[int, Array] = field(default_factory=dict)
    overdue: int = 0

    def see(self, gaps: Array) -> None:
        """Take in the gaps after the next row."""
        self.last = [*self.last[1 - _ROWS :], gaps]
        if len(self.last) == _ROWS:
            before, after = self.last[_ROWS // 2 - 1][0], self.last[_ROWS // 2][0]
            for pair in np.flatnonzero((before > 0) & (after <= 0)):
                through = np.array([each[:, pair] for each in self.last])
                self.found.setdefault(int(pair), _zero(through))


def net_verdict(
    net: Net,
    top: Callable[[Array], Array],
    tau_end: float,
    tolerance: float,
    kinked: bool,
    calm: float = 0.0,
    tell: Report | None = None,
    sizes: Sequence[int] = _SIZES,
) -> NetVerdict:
    """Return the first crossing up to ``tau_end``, by nets of ever smaller spacing.

    The result is extrapolated from the finest two nets, its error is the change against that of the
    two before. Nets are refined until it is below ``tolerance``; two in a row that see no crossing
    mean that there is none. Times converge like the square of the spacing, but only like the
    spacing where the lines beside a kink are the first to cross.

    Parameters
    ----------
    net : Net
        From :func:`hopper.march.net.make_net`.
    top : function
        Of theta / theta_w, shape (m,), returning w of C+ and C-, shape (2, m).
    tau_end : float
        Time up to which crossings count.
    tolerance : float
        Wanted error of tau.
    kinked : bool
        Whether the top has a kink at the wall; times that do not converge are then no crossing.
    calm : float
        Slope K = a w_y below which no crossing is to be expected: nets end a loop later.
    tell : function, optional
        Told which net is at work, and its tau.
    sizes : sequence of int
        Cells of the nets, each twice those of the one before.
    """
    seen: list[Array] = []
    missed = 0
    for size in sizes:
        here = first_on_net(net, size, top, tau_end, calm, tell)
        if here is not None:
            seen.append(here)
        missed = 0 if here is not None else missed + 1
        if missed == 2:
            return NetVerdict(None, True, None)
        order = _order(seen, kinked)
        if order and _limit(net, seen, order).error < tolerance:
            break
    if len(seen) >= 3 and (order or not kinked):
        crossing = _limit(net, seen, order or 2)
        # A quotient can be right by chance.
        if crossing.error < _PLACED * crossing.tau or not kinked:
            return NetVerdict(crossing, True, crossing.tau)
    earliest = min((float(each[0]) for each in seen), default=None)
    return NetVerdict(None, earliest is None, earliest)


def first_on_net(
    net: Net,
    n: int,
    top: Callable[[Array], Array],
    tau_end: float,
    calm: float = 0.0,
    tell: Report | None = None,
) -> Array | None:
    """Return (tau, theta, family) of the first crossing on the net of ``n`` cells, or None.

    ``top``, ``calm`` and ``tell`` as in :func:`net_verdict`.
    """
    watch, steps, turns = _Watch(), list[tuple[Array, Array, int]](), 0
    calm_turns = 0
    previous: Array | None = None
    with np.errstate(all="ignore"):
        for row in rows(net, n, top):
            earliest = float(row[TAU].min())
            # Behind a tangency lines lead back in time.
            if not (earliest <= tau_end and row[SLOPES].min() > 0):
                break
            if previous is not None:
                turns += row.shape[1] > n
                if tell and turns % _BETWEEN == 0:
                    tell(f"net of {n} cells", earliest)
                steps = [*steps[1 - _ROWS :], (previous, row, turns)]
                if watch.last:
                    watch.see(_gaps(net, *steps[-1]))
                elif _out_of_order(previous, row):
                    for each in steps:
                        watch.see(_gaps(net, *each))
                if watch.found and _decided(watch, 2 * n, earliest):
                    break
                if row.shape[1] > n:
                    calm_turns = calm_turns + 1 if _steepest(row) < calm else 0
                    if calm_turns > 2 * n and not watch.found:
                        break
            previous = row
    return _first(watch.found, 2 * n, tau_end)


def _steepest(row: Array) -> float:
    """Return the largest K = a w_y between neighbouring lines of a family on a row."""
    step, middle = np.diff(row, axis=1), (row[:, 1:] + row[:, :-1]) / 2
    largest = -np.inf
    for sign, w, slope in ((1, PLUS, 4), (-1, MINUS, 5)):
        along = sign * step[THETA]
        # From line to line at the same tau: the way along them is taken back.
        later = middle[slope] * along - step[TAU]
        rise = step[w] - middle[slope + 2] * step[TAU] / middle[slope]
        largest = max(largest, float(np.where(sign * later > 0, rise / later, np.inf).max()))
    return largest


def _out_of_order(row: Array, following: Array) -> bool:
    """Whether a point of the shorter row is not between its neighbours of the longer one."""
    short, long = (row, following) if row.shape < following.shape else (following, row)
    return not ((short[THETA] > long[THETA, :-1]).all() and (short[THETA] < long[THETA, 1:]).all())


def _gaps(net: Net, row: Array, following: Array, turns: int) -> Array:
    """Return gap, tau, theta and family of neighbouring lines along those that cross them.

    Shape (4, 2 n): pairs of C-, which C+ crosses, from the right end on, then those of C+. Two
    rows move all pairs by one place on the loop: ``turns`` such moves are taken back.
    """
    short, long = (row, following) if row.shape < following.shape else (following, row)
    inner, outer = short[[THETA, TAU]], long[[THETA, TAU]]
    if net.left > 0:
        outer[0, 0] = 0.0  # the axis itself
    lower, upper = (outer[:, :-1], inner), (inner, outer[:, 1:])
    along = (upper, lower) if row is short else (lower, upper)
    families = []
    for sign, (low, high) in zip((-1.0, 1.0), along, strict=True):
        middle = (low + high) / 2
        gap = high[0] - low[0]
        families.append(np.stack([gap, middle[1], middle[0], np.full_like(gap, sign)]))
    return np.roll(np.concatenate([families[0][:, ::-1], families[1]], axis=1), -turns, axis=1)


def _zero(through: Array) -> Array:
    """Return (tau, theta, family) where the gap vanishes between the rows before the middle one.

    ``through``: gap, tau, theta and family in successive rows, shape (_ROWS, 4).
    """
    place = np.arange(_ROWS) - _ROWS // 2
    powers = np.polyfit(place, through[:, :3], _ROWS - 1)
    before, after = through[_ROWS // 2 - 1, 0], through[_ROWS // 2, 0]
    guess = after / (before - after)
    root = guess
    for _ in range(_NEWTON_STEPS):
        root -= np.polyval(powers[:, 0], root) / np.polyval(np.polyder(powers[:, 0]), root)
    if not -1 <= root <= 0:
        root = guess
    return np.array([*(np.polyval(powers[:, i], root) for i in (1, 2)), through[_ROWS // 2, 3]])


def _decided(watch: _Watch, pairs: int, earliest: float) -> bool:
    """Whether no later row, from time ``earliest`` on, can change the first crossing."""
    first = min(watch.found, key=lambda pair: watch.found[pair][0])
    if earliest <= watch.found[first][0]:
        return False
    around = range(-_NEIGHBOURS, _NEIGHBOURS + 1)
    watch.overdue += 1
    return all((first + i) % pairs in watch.found for i in around) or watch.overdue > _PATIENCE


def _first(found: dict[int, Array], pairs: int, tau_end: float) -> Array | None:
    """Return the first (tau, theta, family), between the pairs as well, up to ``tau_end``."""
    found = {pair: each for pair, each in found.items() if each[0] <= tau_end}
    if not found:
        return None
    first = min(found, key=lambda pair: found[pair][0])
    return lowest(found, first, pairs)


def lowest(found: dict[int, Array], first: int, pairs: int) -> Array:
    """Return the crossing of least tau by a polynomial through neighbours, as far as there are.

    Parameters
    ----------
    found : dict
        (tau, theta, family) by number on a loop of ``pairs``.
    first : int
        That of least tau.
    pairs : int
        Length of the loop.
    """
    for reach in range(_NEIGHBOURS, 0, -1):
        places = range(-reach, reach + 1)
        if all((first + i) % pairs in found for i in places):
            values = np.array([found[(first + i) % pairs] for i in places])
            powers = np.polyfit(places, values, 2 * reach)
            slope = np.polyder(powers[:, 0])
            place = 0.0
            for _ in range(_NEWTON_STEPS):
                place -= np.polyval(slope, place) / np.polyval(np.polyder(slope), place)
            if abs(place) <= 1:
                tau, theta = (np.polyval(powers[:, i], place) for i in (0, 1))
                return np.array([tau, theta, found[first][2]])
    return found[first]


def _order(seen: list[Array], kinked: bool) -> int | None:
    """Return the order at which the times of the last three nets converge, if they do."""
    if len(seen) < 3:
        return None
    first, second, third = (each[0] for each in seen[-3:])
    quotient = (first - second) / (second - third)
    orders = (1, 2) if kinked else (2,)
    return next((p for p in orders if _QUOTIENTS[p][0] < quotient < _QUOTIENTS[p][1]), None)


def _limit(net: Net, seen: list[Array], order: int) -> Crossing:
    """Return the limit of crossings whose error falls like the spacing to the power ``order``."""
    before, last = (
        fine + (fine - coarse) / (2**order - 1) for coarse, fine in (seen[-3:-1], seen[-2:])
    )
    theta = float(np.clip(last[1], net.left, net.right))
    change = abs(float(last[0] - before[0]))
    # Two extrapolations can agree by chance.
    error = max(change, _LEAST * abs(float(seen[-1][0] - seen[-2][0])))
    family: Literal[1, -1] = 1 if seen[-1][2] > 0 else -1
    return Crossing(float(last[0]), theta, family, error)
