"""A march down a hopper in numbers: where it breaks down, where it has settled, its fields."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hopper.arguments import checked
from hopper.arrays import Array
from hopper.brief import brief
from hopper.march.base import base_of
from hopper.march.outcome import march
from hopper.march.result import Kind, March
from hopper.march.tops import Top
from hopper.quantity import Quantity
from hopper.radial.solution import RadialSolution

# The distances from the radial field for which radii are given.
LEVELS = (0.05, 0.01)
# Wanted error of log sigma and psi where the stress is smooth.
_TOLERANCE = 1e-6
# Times and angles of a profile.
TIMES, ANGLES = 401, 41


@dataclass(frozen=True)
class StressAt:
    """Stress at one depth; sigma over rho g r, psi in radians.

    Attributes
    ----------
    sigma_axis, sigma_half, sigma_wall : Quantity
        sigma at theta = 0, theta_w / 2 and the right wall.
    psi_half : Quantity
        psi at theta_w / 2.
    """

    sigma_axis: Quantity
    sigma_half: Quantity
    sigma_wall: Quantity
    psi_half: Quantity

    __repr__ = brief("sigma_axis", "sigma_half", "sigma_wall")


@dataclass(frozen=True, eq=False)
class MarchAssessment:
    """A march down a hopper in numbers.

    tau is that of the march, tilted if that of its base is; radii are r / r_top in any case.

    Attributes
    ----------
    result : March
    kind : "crossing", "tangency", "kink" or None
        How it ends before the depth that was asked for.
    breakdown : Quantity or None
        tau of the first crossing.
    breakdown_x : float or None
        theta / theta_w of the first crossing, or of the tangency.
    breakdown_radius : Quantity or None
        r / r_top there.
    tangency : Quantity or None
        tau of a tangency that comes first.
    settled_5_percent, settled_1_percent : Quantity or None
        r / r_top from which on the stress is that close to the radial field, for good.
    end : float
        tau up to which the march is followed.
    error_estimate : float
        Of log sigma and psi up to there.
    at : StressAt or None
        Stress at the depth asked for, where the march gets there.
    notes : tuple of str
    """

    result: March
    breakdown: Quantity | None
    tangency: Quantity | None
    settled_5_percent: Quantity | None
    settled_1_percent: Quantity | None
    error_estimate: float
    at: StressAt | None
    notes: tuple[str, ...]

    __repr__ = brief("kind", "breakdown", "settled_5_percent", "settled_1_percent")

    @property
    def kind(self) -> Kind | None:
        """How the march ends."""
        return self.result.kind

    @property
    def breakdown_x(self) -> float | None:
        """Theta / theta_w where it ends."""
        place = self.result.breakdown
        return None if place is None else place.position

    @property
    def breakdown_radius(self) -> Quantity | None:
        """The r / r_top where it ends."""
        place = self.result.breakdown
        return None if place is None else Quantity(place.radius, place.radius * place.error)

    @property
    def end(self) -> float:
        """Tau up to which the march is followed."""
        return self.result.trusted_tau

    @property
    def residual(self) -> float:
        """Largest residual of the momentum balance, in units of rho g."""
        return self.result.residual

    def profiles(self) -> dict[str, Array]:
        """Return tau (m,), theta (n,) in radians, sigma and psi (m, n), and the distance (m,)."""
        tau = np.linspace(0, self.end, TIMES)
        theta = self.result.base.hopper.half_angle * np.linspace(-1, 1, ANGLES)
        sigma, psi = self.result.fields_over(tau, theta)
        distance = self.result.distance(tau)
        return {"tau": tau, "theta": theta, "sigma": sigma, "psi": psi, "distance": distance}


@checked
def assess_march(
    solution: RadialSolution,
    top: Top,
    depth: float,
    at_tau: float | None = None,
    report: Callable[[str, float], object] | None = None,
) -> MarchAssessment:
    """Return what becomes of a stress at the top of a hopper, in numbers.

    Parameters
    ----------
    solution : RadialSolution
        Of a Mohr-Coulomb material.
    top : Top
        Stress at r_top, or where the tilted time is 0 if psi of the radial field passes a tangency.
    depth : float
        tau = log(r_top / r) to which to march.
    at_tau : float, optional
        Where the stress is wanted.
    report : function, optional
        As that of :func:`hopper.march.outcome.march`.

    Raises
    ------
    HopperError
        As :func:`hopper.march.outcome.march`.
    """
    found = march(base_of(solution), top, depth, _TOLERANCE, LEVELS, report=report)
    end = found.breakdown
    place = None if end is None else Quantity(end.tau, end.error)
    five, one = (
        None if each.radius is None or each.error is None else Quantity(each.radius, each.error)
        for each in found.settled
    )
    return MarchAssessment(
        result=found,
        breakdown=place if found.kind == "crossing" else None,
        tangency=place if found.kind == "tangency" else None,
        settled_5_percent=five,
        settled_1_percent=one,
        error_estimate=found.error_estimate + solution.error_estimate,
        at=_stress_at(found, at_tau),
        notes=tuple(_notes(found, depth, at_tau)),
    )


def _stress_at(found: March, tau: float | None) -> StressAt | None:
    if tau is None or tau > found.trusted_tau:
        return None
    error = found.error_up_to(tau) + found.base.solution.error_estimate
    theta = found.base.hopper.half_angle * np.array([0, 0.5, 1])
    sigma, psi = (values.tolist() for values in found.fields(tau, theta))
    axis, half, wall = (Quantity(value, value * error) for value in sigma)
    return StressAt(axis, half, wall, Quantity(psi[1], error))


def _notes(found: March, depth: float, at_tau: float | None) -> list[str]:
    notes = []
    if found.kinked:
        notes.append(
            "top and wall law do not fit at their corner: a kink of the stress runs down from it"
            + (", is focused on the axis, and may break there" if _is_cone(found) else "")
        )
    if found.kind == "kink":
        notes.append(
            "crossings are seen whose place depends on the mesh: the kink makes them, and none is "
            "given as the breakdown"
        )
    if found.base.tilted:
        notes.append(
            "psi of the radial field passes pi/4 - delta/2: tau is tilted, the top is the surface "
            "r = r_top exp(-h(theta)); radii count from r_top"
        )
    if found.trusted_tau < depth:
        notes.append(f"the march ends at tau = {found.trusted_tau:.6g}: nothing below is computed")
    if at_tau is not None and at_tau > found.trusted_tau:
        notes.append(f"there is no stress at tau = {at_tau:g}: the march ends before")
    return notes


def _is_cone(found: March) -> bool:
    return found.base.hopper.curvature > 0
