"""A march as its result: where it ends, how far it is trusted, its fields, settled radii."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from hopper.arguments import RealRow, checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.errors import InvalidParameterError
from hopper.march.base import Base, radial_fields
from hopper.march.fields import deviations, interpolated, state_at
from hopper.march.history import History
from hopper.march.settling import distances
from hopper.march.tops import Top

Kind = Literal["crossing", "tangency", "kink"]

# Cells between the angles at which fields are compared.
ANGLES = 40


@dataclass(frozen=True)
class Settled:
    """r / r_top from which on the stress is within ``level`` of the radial field's, for good.

    That is to say: to the end of the trusted march, at least three loop times below. None where it
    is not reached, not trusted, or small deviations grow.
    """

    level: float
    radius: float | None
    error: float | None

    __repr__ = brief("level", "radius", "error")


@dataclass(frozen=True)
class Breakdown:
    """Where a march breaks down.

    Attributes
    ----------
    tau : float
        tau, or tilted tau if the base is tilted.
    error : float
        Of ``tau``.
    position : float
        theta / theta_w; not negative in a symmetric stress.
    radius : float
        r / r_top.
    """

    tau: float
    error: float
    position: float
    radius: float

    __repr__ = brief("tau", "error", "position", "radius")


@dataclass(frozen=True, eq=False)
class March:
    """What becomes of a stress.

    Attributes
    ----------
    base : Base
    top : Top
    kind : "crossing", "tangency", "kink" or None
        How it ends: characteristics cross; one becomes tangent to the lines of constant tau; a kink
        of the top, focused on the axis of a cone, makes crossings that no mesh places; not at all.
    breakdown : Breakdown or None
        Of the crossing or the tangency.
    tangency_tau : float or None
        tau of the first tangency, if there is one before a crossing.
    trusted_tau : float
        tau up to which two meshes agree to 1 %; fields are given up to there.
    error_estimate : float
        What two meshes differ by in log sigma and psi up to ``trusted_tau``.
    residual : float
        Largest residual of the momentum balance at a few times, in units of rho g; not in the
        last fifth before a breakdown, which no mesh resolves.
    settled : tuple of Settled
    differences : array, shape (2, n)
        Times up to ``trusted_tau``, and what two meshes differ by up to each of them.
    kinked : bool
        Whether a kink of the stress leaves the corner of top and wall.
    history : History
    """

    base: Base
    top: Top
    kind: Kind | None
    breakdown: Breakdown | None
    tangency_tau: float | None
    trusted_tau: float
    error_estimate: float
    residual: float
    settled: tuple[Settled, ...]
    differences: Array
    kinked: bool
    history: History

    __repr__ = brief("top.name", "kind", "trusted_tau", "error_estimate")

    @checked
    def error_up_to(self, tau: float) -> float:
        """Return what two meshes differ by in log sigma and psi up to a time."""
        times, errors = self.differences
        return float(errors[min(int(np.searchsorted(times, tau)), times.size - 1)])

    @checked
    def fields(self, tau: float, theta: RealRow) -> tuple[Array, Array]:
        """Return sigma (over rho g r) and psi (radians) at a time and angles, shape (n,) each.

        Raises
        ------
        InvalidParameterError
            If tau is not within the trusted part of the march, or an angle not in the hopper.
        """
        self._require_trusted("tau", tau)
        return self._fields(state_at(self.history, tau), np.asarray(theta))

    @checked
    def fields_over(self, tau: RealRow, theta: RealRow) -> tuple[Array, Array]:
        """Return sigma and psi at times and angles as :meth:`fields`, shape (m, n) each.

        Between the steps of the march they are interpolated: an error far below its own.
        """
        self._require_trusted("tau", *np.asarray(tau))
        return self._fields(interpolated(self.history, np.asarray(tau)), np.asarray(theta))

    @checked
    def distance(self, tau: RealRow) -> Array:
        """Return the distance from the radial field at times, shape (m,).

        The largest |T_ij - T0_ij| / sigma0 over the hopper and the components.

        Raises
        ------
        InvalidParameterError
            If a time is not within the trusted part of the march.
        """
        self._require_trusted("tau", *np.asarray(tau))
        x = np.linspace(0 if self.top.symmetric else -1, 1, ANGLES + 1)
        return distances(self.history, np.asarray(tau), x).max(axis=1)

    def _require_trusted(self, name: str, *times: float) -> None:
        for tau in times:
            if not 0 <= tau <= self.trusted_tau:
                raise InvalidParameterError(
                    f"{name} = {float(tau)!r} is not within the march, which can be trusted up to "
                    f"tau = {self.trusted_tau:.6g}: no smooth stress is known there"
                )

    def _fields(self, w: Array, theta: Array) -> tuple[Array, Array]:
        sigma, psi = radial_fields(self.base, theta)
        even, odd = deviations(self.history.loop, w, theta / self.base.hopper.half_angle)
        return sigma * np.exp(even), psi + odd
