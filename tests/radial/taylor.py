"""The radial equations shot outwards by Taylor series in extended precision, many at a time.

Nothing here comes from the package. Each step expands log(sigma / sigma_0) and psi to order 30, on
the axis too, where the equations are regular for the solution sought. numpy's longdouble carries 64
bits of mantissa on x86, so that the rounding is 1e-19.
"""

from dataclasses import dataclass

import numpy as np

Long = np.longdouble
ORDER = 30
# Truncation of a step, relative to the solution.
SMALL = Long(10) ** -21
MOST_STEPS = 400
SECTIONS = 100


@dataclass
class Batch:
    """Hoppers as arrays, shape (n,): k = d - 2, s = sin(delta), the wall and the yield condition.

    T_rr = 1 - radial cos, T_tt = 1 + angular cos, T_pp = hoop + hoop_cosine cos, T_rt = -s sin, all
    over sigma and of 2 psi.
    """

    k: np.ndarray
    s: np.ndarray
    half_angle: np.ndarray
    radial: np.ndarray
    angular: np.ndarray
    hoop: np.ndarray
    hoop_cosine: np.ndarray

    def of(self, chosen):
        return Batch(*(value[chosen] for value in vars(self).values()))


def batch(hoppers):
    """Describe Hoppers, whose angles are exact as given."""
    s = np.sin(np.array([hopper.delta for hopper in hoppers], dtype=Long))
    von_mises = np.array([hopper.material.name == "von Mises" for hopper in hoppers])
    third = s / np.sqrt(Long(3))
    return Batch(
        np.array([hopper.geometry == "cone" for hopper in hoppers], dtype=Long),
        s,
        np.array([hopper.half_angle for hopper in hoppers], dtype=Long),
        np.where(von_mises, 2 * third, s),
        np.where(von_mises, third, s),
        np.where(von_mises, Long(1), 1 + s),
        np.where(von_mises, third, Long(0)),
    )


def wall_angle(hoppers, friction_angles):
    """Return psi_w, shape (n,): 2 psi_w = Phi + arcsin(sin Phi / b), tan Phi = (b / s) tan phi.

    b is T_tt's factor of cos 2psi; from T_rt = -tan(phi) T_tt.
    """
    at = batch(hoppers)
    inclination = np.arctan(at.angular / at.s * np.tan(np.asarray(friction_angles, dtype=Long)))
    ratio = np.minimum(np.sin(inclination) / at.angular, 1)
    return (inclination + np.arcsin(ratio)) / 2


def friction_angle(at, psi):
    """Return phi with T_rt = -tan(phi) T_tt, shape (n,)."""
    return np.arctan(at.s * np.sin(2 * psi) / (1 + at.angular * np.cos(2 * psi)))


def _convolution(a, b, n):
    return (a[: n + 1] * b[n::-1]).sum(axis=0) if n >= 0 else 0


def _angles(theta):
    """Return series of cos, sin and cot about ``theta``, each (ORDER + 2, n); cot times theta at 0.

    theta is either 0 everywhere or nowhere.
    """
    cos, sin, cot = (np.zeros((ORDER + 2, theta.size), dtype=Long) for _ in range(3))
    cos[0], sin[0] = np.cos(theta), np.sin(theta)
    for n in range(1, ORDER + 2):
        cos[n], sin[n] = -sin[n - 1] / n, cos[n - 1] / n
    if theta[0] == 0:
        for n in range(ORDER + 1):  # theta cos = (theta cot) sin
            cot[n] = cos[n] - (cot[:n] * sin[n + 1 : 1 : -1]).sum(axis=0)
    else:
        cot[0] = cos[0] / sin[0]
        for n in range(1, ORDER + 2):
            cot[n] = -((n == 1) + _convolution(cot, cot, n - 1)) / n
    return cos, sin, cot


def _expand(at, tau, theta, log_ratio, psi):
    """Return the series of log(sigma / sigma_0) and psi about ``theta``, each (ORDER + 1, n)."""
    cos, sin, cot = _angles(theta)
    axis = theta[0] == 0
    c, s, light, dlog, dpsi = (np.zeros((ORDER + 1, theta.size), dtype=Long) for _ in range(5))
    c[0], s[0], light[0] = np.cos(2 * psi), np.sin(2 * psi), np.exp(-log_ratio)
    excess = at.angular - at.hoop_cosine  # T_tt - T_pp = excess (cos - 1)
    normal = (2 + at.k) * at.radial + at.angular + at.k * at.hoop_cosine
    # [shear, shear_psi; normal stress, its slope] (L', psi') = -(radial, angular).
    shear, shear_psi = -at.s * s[0], -2 * at.s * c[0]
    angular, angular_psi = 1 + at.angular * c[0], -2 * at.angular * s[0]
    for n in range(ORDER):
        if n:
            c[n] = -2 * _convolution(s, dpsi, n - 1) / n
            s[n] = 2 * _convolution(c, dpsi, n - 1) / n
            light[n] = -_convolution(light, dlog, n - 1) / n
        # Known parts of the products with the slopes, whose n-th coefficients are still 0.
        slope = _convolution(c, dpsi, n), _convolution(s, dpsi, n)
        if axis:
            # The next coefficients of sin and 1 - cos; that of sin contains psi' unknown.
            following = np.concatenate([s[1 : n + 1], [2 * slope[0] / (n + 1)]])
            cot_sin = (cot[: n + 1] * following[::-1]).sum(axis=0)
            following = np.concatenate([-c[1 : n + 1], [2 * slope[1] / (n + 1)]])
            cot_versine = (cot[: n + 1] * following[::-1]).sum(axis=0)
        else:
            cot_sin = _convolution(cot, s, n)
            cot_versine = cot[n] - _convolution(cot, c, n)
        one = 1.0 if n == 0 else 0.0
        first = one * (1 + at.k - at.k * at.hoop) - normal * c[n] - at.k * at.s * cot_sin
        first = first + tau * _convolution(light, cos, n)
        first = first - at.s * (_convolution(s, dlog, n) + 2 * slope[0])
        second = -(3 + at.k) * at.s * s[n] - at.k * excess * cot_versine
        second = second - tau * _convolution(light, sin, n)
        second = second + at.angular * (_convolution(c, dlog, n) - 2 * slope[1])
        steep = shear_psi - 2 * at.k * at.s * c[0] / (n + 1) if axis else shear_psi
        determinant = shear * angular_psi - steep * angular
        dlog[n] = (steep * second - angular_psi * first) / determinant
        dpsi[n] = (angular * first - shear * second) / determinant
    order = np.arange(1, ORDER + 1, dtype=Long)[:, None]
    return (
        np.concatenate([[log_ratio], dlog[:ORDER] / order]),
        np.concatenate([[psi], dpsi[:ORDER] / order]),
    )


def _step(*series):
    """Return the step, shape (n,), at which the last two terms are SMALL."""
    steps = []
    for values in series:
        for n in (ORDER - 1, ORDER):
            last = np.maximum(np.abs(values[n]), Long(10) ** -3000)
            steps.append((SMALL / last) ** (Long(1) / n))
    return np.min(steps, axis=0)


def _evaluate(series, h):
    value = series[-1]
    for coefficient in series[-2::-1]:
        value = value * h + coefficient
    return value


def shoot(at, tau, points=1):
    """Return log(sigma / sigma_0) and psi at j theta_w / points, j = 1 ... points: (points, n).

    nan beyond where psi becomes singular.
    """
    tau = np.asarray(tau, dtype=Long)
    log_ratio, psi, theta = (np.zeros(tau.size, dtype=Long) for _ in range(3))
    places = np.arange(1, points + 1, dtype=Long)[:, None] / points * at.half_angle
    found = np.full((2, points, tau.size), np.nan, dtype=Long)
    active = np.arange(tau.size)
    with np.errstate(all="ignore"):
        for _ in range(MOST_STEPS):
            here = theta[active]
            series = _expand(at.of(active), tau[active], here, log_ratio[active], psi[active])
            h = np.minimum(_step(*series), at.half_angle[active] - here)
            ahead = places[:, active] - here
            inside = (ahead > 0) & (ahead <= h * (1 + Long(2) ** -60))
            for values, one in zip(found, series, strict=True):
                values[:, active] = np.where(inside, _evaluate(one, ahead), values[:, active])
            log_ratio[active], psi[active] = (_evaluate(one, h) for one in series)
            theta[active] += h
            going = np.isfinite(psi[active]) & (np.abs(psi[active]) < 2) & (h > 1e-17)
            active = active[going & (theta[active] < at.half_angle[active] * (1 - Long(2) ** -60))]
            if not active.size:
                break
    return found[0], found[1]


def solve(hoppers, friction_angles, tau, step, points=8):
    """Return tau of the radial solution next to ``tau`` (n,), and :func:`shoot` there.

    The root of a parabola through psi_w at log(tau) - step, log(tau), log(tau) + step, twice: folds
    do no harm. ``step`` (n,) is of the size of the error of tau, or larger.
    """
    at, target = batch(hoppers), wall_angle(hoppers, friction_angles)
    tau, step = np.asarray(tau, dtype=Long), np.asarray(step, dtype=Long)
    three = at.of(np.tile(np.arange(len(hoppers)), 3))
    for _ in range(3):
        trial = np.concatenate([tau, tau * np.exp(step), tau * np.exp(-step)])
        middle, right, left = shoot(three, trial)[1][-1].reshape(3, -1) - target
        slope, curvature = (right - left) / 2, (right + left) / 2 - middle
        with np.errstate(invalid="ignore"):
            root = np.sqrt(np.maximum(slope**2 - 4 * curvature * middle, 0))
        # The root nearer to 0, without cancellation.
        move = -2 * middle / (slope + np.copysign(root, slope))
        move = np.where(np.abs(slope) < np.abs(curvature) / 1e4, 0, move)
        tau = tau * np.exp(np.clip(move, -20, 20) * step)
        step = np.minimum(step, np.maximum(np.abs(move) * step / 10, step / 100))
    return tau, *shoot(at, tau, points)


def solve_at_an_end(hoppers, friction_angles, tau, width, points=8):
    """Return the same on the physical branch where psi is close to singular.

    There psi_w may change by more than the rounding of tau allows to follow in double precision,
    and a little more tau leads into the singular angle: the largest tau that leads to less than
    psi_w, within ``width`` (n,) of log(tau), by sections.
    """
    at, target = batch(hoppers), wall_angle(hoppers, friction_angles)
    parts = np.arange(SECTIONS + 1, dtype=Long) / SECTIONS
    many = at.of(np.repeat(np.arange(len(hoppers)), parts.size))
    low, high = (np.asarray(tau, dtype=Long) * np.exp(side * width) for side in (-1, 1))
    for _ in range(int(np.ceil(np.log(np.max(width) / 1e-20) / np.log(SECTIONS)))):
        trial = low[:, None] + (high - low)[:, None] * parts
        psi = shoot(many, trial.ravel())[1][-1].reshape(trial.shape)
        beyond = ~(psi <= target[:, None])
        beyond[:, 0], beyond[:, -1] = False, True
        first = beyond.argmax(axis=1)[:, None]
        low, high = (np.take_along_axis(trial, first + i, 1)[:, 0] for i in (-1, 0))
    return low, *shoot(at, low, points)


def fold(hoppers, tau):
    """Return the tau near the given ones, shape (n,), where psi_w is largest, and phi there.

    By parabolas through psi_w at three log(tau), closer and closer.
    """
    at = batch(hoppers)
    three = at.of(np.tile(np.arange(len(hoppers)), 3))
    tau = np.asarray(tau, dtype=Long)
    for step in Long(10) ** -np.array([3, 3, 4, 4]):
        trial = np.concatenate([tau, tau * np.exp(step), tau * np.exp(-step)])
        middle, right, left = shoot(three, trial)[1][-1].reshape(3, -1)
        vertex = (left - right) / (right + left - 2 * middle) / 2
        tau = tau * np.exp(np.clip(vertex, -5, 5) * step)
    return tau, friction_angle(at, shoot(at, tau)[1][-1])
