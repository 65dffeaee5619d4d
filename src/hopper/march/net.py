"""The net of characteristics, row by row: the second method, whose lines show their crossings.

Rows of N + 1 points, on both ends a wall or the axis, and rows of N points alternate; each point
is where a C+ and a C- line from the row before meet. Along a line d tau = (D / A) dy and
dw = (N / A - N0 / A0) dy by the trapezoidal rule: errors are a series in the square of the spacing
and the radial field is an exact solution. As functions of the lines' labels all fields stay smooth
where lines cross.

At the axis of a cone N has a pole. No line starts or ends there: one step leads from the last point
before the axis to the first behind it, and the trapezoidal rule takes both sides of the pole alike.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.base import Base, BaseTable, base_table
from hopper.march.equations import both_families, psi_factor, tilt

# Rows are arrays (8, n): tau, theta, then for C+ and C-: w, the slope of tau, and that of w. Slopes
# are those by y, which is theta along C+ and -theta along C-.
TAU, THETA, PLUS, MINUS = 0, 1, 2, 3
SLOPES, _SOURCES, _RATES = slice(4, 6), slice(6, 8), slice(4, 8)
# Change of w below which a point counts as found, and the largest number of iterations.
_CHANGE, _ITERATIONS = 1e-10, 10
# The end of the rows at the axis of a cone, over theta_w: a place for it, from which nothing goes.
_AXIS = 1e-9


@dataclass(frozen=True, eq=False)
class Net:
    """A net over theta in [``left``, ``right``], radians; ``through`` if lines pass a pole."""

    base: Base
    table: BaseTable
    left: float
    right: float
    through: bool

    __repr__ = brief("left deg", "right deg", "through")


def make_net(base: Base, symmetric: bool) -> Net:
    """Return the net of one half of a symmetric stress, or of a whole wedge."""
    through = symmetric and base.hopper.curvature > 0
    right = base.hopper.half_angle
    left = (_AXIS * right if through else 0.0) if symmetric else -right
    return Net(base, base_table(base), left, right, through)


def rows(net: Net, n: int, top: Callable[[Array], Array]) -> Iterator[Array]:
    """Yield the rows of a net with ``n`` cells, of n + 1 points and of n in turn, for ever.

    ``top`` returns w of C+ and C- at theta / theta_w, shape (2, m). Rows cease to be numbers some
    way behind a crossing.
    """
    theta = np.linspace(net.left, net.right, n + 1)
    long = _evaluated(net, np.zeros(n + 1), theta, top(theta / net.right))
    behind, short = long[:, :1], None
    while True:
        yield long
        plus, minus = long[:, :-1], long[:, 1:]
        if net.through:
            plus = np.concatenate([behind, plus[:, 1:]], axis=1)
        corner = 0.5 * (plus + minus) if short is None else short
        guess = (plus + minus - corner)[_RATES]
        if net.through:
            guess[:, 0] = corner[_RATES, 0]
        short = _meet(net, plus, minus, guess)
        yield short
        plus = np.concatenate([short[:, :1], short], axis=1)
        minus = np.concatenate([short, short[:, -1:]], axis=1)
        guess = (plus + minus - long)[_RATES]
        guess[:, [0, -1]] = long[_RATES, :][:, [0, -1]]
        long = _meet(net, plus, minus, guess, ends=True)
        # What arrives at the axis as C- leaves it as C+, at -theta.
        behind = short[[TAU, THETA, MINUS, PLUS, 5, 4, 7, 6], :1]
        behind[THETA] *= -1


def _meet(net: Net, plus: Array, minus: Array, guess: Array, ends: bool = False) -> Array:
    """Return the points where C+ from ``plus`` and C- from ``minus`` meet, (8, n).

    ``guess`` has their slopes, (4, n). With ``ends`` the first and last are on the boundaries,
    where w of C+ and C- agree: C- from the first of ``minus``, C+ from the last of ``plus``.
    """
    start, origin = np.stack([plus[2], minus[3]]), np.stack([plus[4:7:2], minus[5:8:2]])
    point = np.concatenate([np.zeros((4, guess.shape[1])), guess])
    w = None
    for _ in range(_ITERATIONS):
        forth = 0.5 * (plus[4] + point[4])
        back = 0.5 * (minus[5] + point[5])
        theta = (minus[TAU] - plus[TAU] + forth * plus[THETA] + back * minus[THETA]) / (
            forth + back
        )
        if ends:
            theta[0], theta[-1] = net.left, net.right
        way = np.stack([theta - plus[THETA], minus[THETA] - theta])
        tau = plus[TAU] + forth * way[0]
        found = start + 0.5 * (origin[:, 1] + point[_SOURCES]) * way
        if ends:
            tau[0] = minus[TAU, 0] + back[0] * way[1, 0]
            found[0, 0], found[1, -1] = found[1, 0], found[0, -1]
        if w is not None:
            if net.through:
                _across_pole(found, w, way / np.tan(theta), ends)
            if not np.abs(found - w).max() > _CHANGE:
                break
        w = found
        point = _evaluated(net, tau, theta, w)
    return point


def _across_pole(found: Array, w: Array, way: Array, ends: bool) -> None:
    """Take the pole's part of the slopes of w, -(w+ - w-) cot(theta) / 2, as it will be.

    Plain iteration would converge by a factor of 3/4 only. ``way`` is that along y times cot.
    """
    change = -0.25 * way
    if ends:
        change[:, [0, -1]] = 0.0
    gap = (found[0] - found[1]) - (w[0] - w[1])
    found += change * (gap / (1 - change[0] + change[1]))


def _evaluated(net: Net, tau: Array, theta: Array, w: Array) -> Array:
    """Return the row of points (tau, theta) with w, shape (2, n)."""
    hopper = net.base.hopper
    # Behind a crossing lines may lead outside.
    psi, radial = net.table(np.minimum(np.abs(theta), net.right))
    if net.left < 0:
        psi = np.copysign(1.0, theta) * psi
    # The radial field and the march side by side, by the same arithmetic.
    t, light = np.empty_like(w), np.empty_like(w)
    t[0], t[1] = psi, psi + psi_factor(hopper) * (w[0] - w[1])
    np.tan(t, out=t)
    light[0], light[1] = radial, radial * np.exp(-0.5 * (w[0] + w[1]))
    forth, back, plus, minus = both_families(hopper, theta, t, light)
    slope = tilt(hopper, psi) if net.base.tilted else 0.0
    row = np.empty((8, theta.size))
    row[TAU], row[THETA], row[2:4] = tau, theta, w
    row[4], row[5] = forth[1] - slope, back[1] + slope
    row[6], row[7] = plus[1] - plus[0], minus[1] - minus[0]
    return row
