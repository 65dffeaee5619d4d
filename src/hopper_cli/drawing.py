"""Curves of one hopper on given axes; the look is the caller's."""

from collections.abc import Mapping, Sequence
from math import atan, degrees
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

Array = NDArray[np.float64]
STYLE = Path(__file__).with_name("paper.mplstyle")
_MODELS = {"mohr-coulomb": "Mohr-Coulomb", "von-mises": "von Mises"}
_SMALL: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7}


def title(
    verdict: str, *, geometry: str, model: str, delta_deg: float, half_angle_deg: float, mu: float
) -> str:
    """Return hopper, material, wall and verdict in one line, in the signs of print."""
    angles = rf"$\delta$ = {delta_deg:.6g}°, $\vartheta_w$ = {half_angle_deg:.6g}°"
    wall = rf"$\mu$ = {mu:.6g} ($\phi$ = {degrees(atan(mu)):.4g}°)"
    return f"{geometry}, {_MODELS[model]}, {angles}, {wall}: {verdict}"


def typeset(number: str) -> str:
    """Return a number with true signs."""
    return number.replace("+-", "±").replace("-", "\N{MINUS SIGN}")


def draw_fields(axes: Sequence[Axes], delta_deg: float, fields: Mapping[str, Array]) -> None:
    """Draw stress, psi and, where it is known, velocity over the polar angle, on two or three axes.

    ``fields`` holds theta (degrees), sigma, psi (radians) and perhaps u. Lines mark the psi at
    which r = const is characteristic for ``delta_deg``, and at which the velocity is singular.
    """
    theta, psi = fields["theta"], np.degrees(fields["psi"])
    stress, angle, *velocity = axes
    for axis in axes:
        axis.set_xlim(theta[0], theta[-1])
        axis.set_xlabel(r"angle $\vartheta$ (degrees)")
    stress.plot(theta, fields["sigma"], color="C0")
    stress.set_ylim(bottom=0)
    stress.set_ylabel(r"average stress $\sigma/(\rho g r)$")
    angle.plot(theta, psi, color="C0")
    highest = 1.5 * psi.max()
    for level, name, style in (
        (45 - delta_deg / 2, r"$\pi/4 - \delta/2$", "--"),
        (45, r"$\pi/4$", ":"),
    ):
        if level < highest:
            for sign in (-1, 1):
                angle.axhline(sign * level, color="0.4", linewidth=0.8, linestyle=style)
            # psi is odd: above it, left of the axis, there is room.
            angle.annotate(name, (theta[0], level), (3, -3), va="top", **_SMALL)
    angle.set_ylabel(r"Sokolovskii angle $\psi$ (degrees)")
    for axis in velocity:
        axis.plot(theta, fields["u"], color="C0")
        axis.set_ylim(bottom=0)
        axis.set_ylabel(r"velocity $u(\vartheta)/u(0)$")


def draw_depth_plane(axis: Axes, march: Mapping[str, Array], end: tuple[float, float]) -> Any:
    """Draw psi over angle and depth; return what a colour bar of it needs.

    ``march`` holds tau, theta (degrees) and psi (radians, over both); ``end`` is the place of a
    breakdown, (theta, tau), NaN without one.
    """
    drawn = axis.pcolormesh(
        march["theta"], march["tau"], np.degrees(march["psi"]), cmap="cividis", shading="gouraud"
    )
    mark_breakdown(axis, end, max(march["tau"][-1], np.nan_to_num(end[1])))
    return drawn


def mark_breakdown(axis: Axes, end: tuple[float, float], deepest: float) -> None:
    """Label axes of angle and depth, and mark the place of a breakdown, (theta, tau)."""
    axis.plot(*end, "x", color="C1", markersize=7, markeredgewidth=1.6, clip_on=False)
    axis.set_xlabel(r"angle $\vartheta$ (degrees)")
    axis.set_ylabel(r"depth $\tau = \log(r_\mathrm{top}/r)$")
    axis.set_ylim(deepest, 0)


def draw_distance(axis: Axes, march: Mapping[str, Array]) -> None:
    """Draw the distance from the radial field, in per cent, over the depth on the other axis."""
    axis.plot(100 * march["distance"], march["tau"], color="C0")
    axis.set_xscale("log")
    for level in (5, 1):
        axis.axvline(level, color="0.4", linewidth=0.8, linestyle="--")
        axis.annotate(f"{level} %", (level, 0), (2, 3), **_SMALL)
    axis.set_xlabel(r"distance from the radial field (% of $\sigma$)")


def draw_spectrum(axis: Axes, upper: NDArray[np.complex128], line: float) -> None:
    """Draw modes, given by those with Im >= 0, and the asymptotic line."""
    _draw_modes(axis, upper)
    axis.axvline(line, color="black", linewidth=0.8, linestyle="--")
    axis.set_title(rf"modes, and the line $\Lambda$ = {typeset(f'{line:.4g}')} (dashed)")


def draw_coupled_spectrum(
    axis: Axes, upper: NDArray[np.complex128], strips: Array | None = None
) -> None:
    """Draw modes of a von Mises cone, given by those with Im >= 0, and strips, shape (k, 2)."""
    _draw_modes(axis, upper)
    for low, high in () if strips is None else strips:
        axis.axvspan(low, high, color="0.75", linewidth=1, zorder=0)
    axis.set_title("modes" if strips is None else "modes, and strips of high frequency (grey)")


def _draw_modes(axis: Axes, upper: NDArray[np.complex128]) -> None:
    modes = np.concatenate([upper, upper.conj()])
    axis.axvline(0, color="0.5", linewidth=0.6)
    axis.plot(modes.real, modes.imag, "o", markersize=2.2, color="C0")
    axis.set_xlabel(r"Re $\lambda$")
    axis.set_ylabel(r"Im $\lambda$")
    axis.margins(x=0.12)
