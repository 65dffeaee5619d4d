"""Curves of one hopper on given axes; the look is the caller's."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

Array = NDArray[np.float64]


def draw_fields(axes: Sequence[Axes], delta_deg: float, fields: Mapping[str, Array]) -> None:
    """Draw stress, psi and velocity over the polar angle, on three axes.

    ``fields`` holds theta (degrees), sigma, psi (radians) and, where it is known, u. Lines mark
    the psi at which r = const is characteristic for ``delta_deg``, and at which the velocity is
    singular.
    """
    theta, psi = fields["theta"], np.degrees(fields["psi"])
    stress, angle, velocity = axes
    for axis in axes:
        axis.set_xlim(theta[0], theta[-1])
        axis.set_xlabel(r"angle $\vartheta$ (degrees)")
    stress.plot(theta, fields["sigma"], color="C0")
    stress.set_ylim(bottom=0)
    stress.set_ylabel(r"average stress $\sigma/(\rho g r)$")
    angle.plot(theta, psi, color="C0")
    highest = 1.5 * psi.max()
    for level, name, style in (
        (45 - delta_deg / 2, r"$\pm(\pi/4 - \delta/2)$", "--"),
        (45, r"$\pm\pi/4$", ":"),
    ):
        if level < highest:
            angle.axhline(level, color="0.4", linewidth=0.8, linestyle=style, label=name)
            angle.axhline(-level, color="0.4", linewidth=0.8, linestyle=style)
            angle.legend(loc="lower right", bbox_to_anchor=(1, 0.1))
    angle.set_ylabel(r"Sokolovskii angle $\psi$ (degrees)")
    velocity.set_ylabel(r"velocity $u(\vartheta)/u(0)$")
    if "u" in fields:
        velocity.plot(theta, fields["u"], color="C0")
        velocity.set_ylim(bottom=0)
    else:
        say(velocity, "not known: $\\psi$ reaches\nor nearly reaches $\\pi/4$")


def draw_spectrum(axis: Axes, upper: NDArray[np.complex128], line: float) -> None:
    """Draw modes, given by those with Im >= 0, and the asymptotic line."""
    modes = np.concatenate([upper, upper.conj()])
    axis.axvline(0, color="0.5", linewidth=0.6)
    axis.axvline(line, color="black", linewidth=0.8, linestyle="--", label=r"line $\Lambda$")
    axis.plot(modes.real, modes.imag, "o", markersize=2.6, color="C0", label="modes")
    axis.set_xlabel(r"Re $\lambda$")
    axis.set_ylabel(r"Im $\lambda$")
    axis.margins(x=0.12)
    axis.legend(loc="lower left")


def say(axis: Axes, words: str) -> None:
    """Write words in the middle of axes that have nothing to show."""
    axis.set(xticks=[], yticks=[])
    axis.text(0.5, 0.5, words, transform=axis.transAxes, ha="center", va="center", wrap=True)
