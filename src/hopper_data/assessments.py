"""What an answer about one hopper consists of: one list for text, JSON, files and figures."""

from typing import Any, get_args

import numpy as np

from hopper.assessment.coupled import CoupledStability
from hopper.assessment.march import MarchAssessment
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper.assessment.summary import OUTCOMES, Assessment
from hopper.march.result import Kind
from hopper.radial.friction_limit import End
from hopper_data.radial import STRESS, THETA, angles
from hopper_data.stability import COUPLED_FLAGS, GOVERNED_BY, PARITY, eigenvalues
from hopper_data.tables import Table, angle, flag, number, within

Part = RadialAssessment | StabilityAssessment | CoupledStability | MarchAssessment

RADIAL: Table = (
    number("sigma_axis", "average stress on the axis", scale="rho g r"),
    number("sigma_wall", "average stress at the wall", scale="rho g r"),
    number("psi_wall", "Sokolovskii angle psi at the wall", units="radian"),
    number("psi_max", "largest psi", units="radian"),
    angle("theta_psi_max_deg", "polar angle of the largest psi", source="theta_psi_max"),
    number("u_wall", "velocity at the wall", scale="u(0)"),
    number("flow_factor", "flow factor"),
    number("solutions", "number of radial solutions for this wall"),
)
PROFILES: Table = (*THETA, *STRESS, number("u", "radial velocity", "theta", scale="u(0)"))
TANGENCY: Table = (
    number("mu_tangency", "mu beyond which r = const is no surface for data", source="tangency"),
)
LIMITS: Table = (
    number("mu_fold", "mu at the fold", source="fold"),
    number("mu_limit", "largest mu with a radial solution", source="coefficient"),
    angle("mass_flow_limit_deg", "mass-flow limit of phi", source="mass_flow"),
    *TANGENCY,
)
STABILITY: Table = (
    number("line", "asymptotic line of Re(lambda)"),
    number("abscissa", "supremum of Re(lambda)"),
    number("abscissa_symmetric", "the same, symmetric disturbances", source="symmetric"),
    number("abscissa_asymmetric", "the same, asymmetric disturbances", source="asymmetric"),
    number(
        "transient_amplification",
        "amplification, tilted time, L2",
        source="transient.amplification",
        scale="exp(-t abscissa)",
    ),
    number(
        "transient_growth", "largest norm of exp(-tM), tilted time, L2", source="transient.growth"
    ),
    number("kappa", "condition of the modes, tilted time, L2", source="transient.condition"),
    number("transient_modes", "number of symmetric modes followed", source="transient.modes"),
)
COUPLED: Table = (
    number("abscissa", "supremum of Re(lambda), without the flow rate"),
    number("decay_down", "least exponent of r, disturbances of the top"),
    number("decay_up", "least exponent of 1/r, disturbances of the outlet"),
)
SPECTRUM: Table = within("spectrum", eigenvalues("symmetric"))
NEUTRAL: Table = (
    angle("delta_neutral_deg", "smallest neutral angle of internal friction", source="delta"),
)
DESIGN: Table = (
    angle(
        "half_angle_classical_deg",
        "largest half angle, classical mass flow",
        source="half_angles.classical",
    ),
    angle(
        "half_angle_limit_deg",
        "largest half angle with a radial solution",
        source="half_angles.limit",
    ),
    angle(
        "half_angle_velocity_deg",
        "largest half angle, radial flow reaches the wall",
        source="half_angles.velocity",
    ),
    angle(
        "half_angle_stability_deg",
        "largest half angle that is stable",
        source="half_angles.stability",
    ),
    angle(
        "half_angle_stable_from_deg",
        "least half angle that is stable",
        source="half_angles.stable_from",
    ),
    angle("half_angle_recommended_deg", "recommended half angle", source="recommended"),
    number("flow_factor", "flow factor there"),
    number("velocity_ratio", "velocity at the wall there", scale="u(0)"),
    number("critical_stress_kpa", "critical stress", source="outlet.stress", units="kPa"),
    number("outlet_m", "smallest outlet", source="outlet.width", units="m"),
)
MARCH: Table = (
    number("breakdown_tau", "first crossing: tau = log(r_top / r)", source="breakdown"),
    number("tangency_tau", "tangency before a crossing: tau", source="tangency"),
    number("breakdown_radius", "where that is: r", scale="r_top"),
    number("settled_5_percent", "within 5 % of the radial field from this r on", scale="r_top"),
    number("settled_1_percent", "within 1 % of the radial field from this r on", scale="r_top"),
)
STRESS_AT: Table = within(
    "at",
    (
        number("sigma_axis", "average stress on the axis", scale="rho g r"),
        number("sigma_half", "average stress at theta_w / 2", scale="rho g r"),
        number("sigma_wall", "average stress at the right wall", scale="rho g r"),
        number("psi_half", "psi at theta_w / 2", units="radian"),
    ),
)
MARCH_FIELDS: Table = (
    number("tau", "log(r_top / r)", "tau"),
    angle("theta", "polar angle", "theta"),
    number("sigma", "average stress", "tau theta", scale="rho g r"),
    number("psi", "Sokolovskii angle", "tau theta", units="radian"),
    number("distance", "largest difference from the radial stress", "tau", scale="sigma"),
)
MARCH_WHOLE: Table = (
    *within("profiles", MARCH_FIELDS),
    *within("march", MARCH),
    flag("breakdown_kind", "how the march ends", get_args(Kind), source="march.kind"),
    number("breakdown_x", "polar angle of that", source="march.breakdown_x", scale="theta_w"),
    number("residual", "momentum residual", source="march.residual", scale="rho g"),
    number("error_estimate", "error of log(sigma) and psi", source="march.error_estimate"),
)
# The governor's names are those of the result within.
STABILITY_WHOLE: Table = (
    *SPECTRUM,
    *within("modes.asymmetric", eigenvalues("low asymmetric", "asymmetric_")),
    *within("result", (GOVERNED_BY, PARITY)),
    *STABILITY,
)
COUPLED_MODES: Table = within("modes", eigenvalues("coupled"))
COUPLED_WHOLE: Table = (
    *COUPLED_MODES,
    *COUPLED_FLAGS,
    number("strips", "edges of the strips of Re(lambda) of high frequency", "strip edge"),
    *COUPLED,
)
WHOLE: Table = (
    flag("outcome", "verdict of stability, or why there is none", OUTCOMES),
    *within("profiles", PROFILES),
    *within("radial", RADIAL),
    *within("stability", STABILITY_WHOLE),
    *within("coupled", COUPLED_WHOLE),
    flag(
        "limit_end",
        "what ends the solutions at mu_limit",
        get_args(End),
        source="limits.friction.end",
    ),
    *within("limits", LIMITS),
)


def profiles(radial: RadialAssessment) -> dict[str, Any]:
    """Return theta (radians), sigma, psi (radians) and u of a radial solution, by these names.

    Over [-theta_w, theta_w], of one shape; u is None where the velocity is not known.
    """
    theta = angles(radial.solution.hopper.half_angle)
    return dict(zip(("theta", "sigma", "psi", "u"), (theta, *radial.profiles(theta)), strict=True))


def arrays(found: Part) -> tuple[Any, Table]:
    """Return the arrays of a part of an assessment and the table that describes them."""
    if isinstance(found, RadialAssessment):
        return profiles(found), PROFILES
    if isinstance(found, MarchAssessment):
        fields = found.profiles()
        tau, theta = np.meshgrid(fields["tau"], fields["theta"], indexing="ij")
        rows = {"tau": tau, "theta": theta, "sigma": fields["sigma"], "psi": fields["psi"]}
        return {name: values.ravel() for name, values in rows.items()}, MARCH_FIELDS[:-1]
    return found, COUPLED_MODES if isinstance(found, CoupledStability) else SPECTRUM


def described(found: Part | Assessment) -> tuple[Any, Table]:
    """Return all that a part of an assessment, or a whole one, holds, and its table."""
    if isinstance(found, RadialAssessment):
        return {"profiles": profiles(found), "radial": found}, (
            *within("profiles", PROFILES),
            *within("radial", RADIAL),
        )
    if isinstance(found, StabilityAssessment):
        return found, STABILITY_WHOLE
    if isinstance(found, CoupledStability):
        return found, COUPLED_WHOLE
    if isinstance(found, MarchAssessment):
        return {"profiles": found.profiles(), "march": found}, MARCH_WHOLE
    return {**vars(found), "profiles": found.radial and profiles(found.radial)}, WHOLE


def comment(found: Assessment) -> dict[str, str]:
    """Return why parts of an assessment do not exist, as the attribute `comment`, if any."""
    reasons = [*(found.radial.notes if found.radial else ()), *filter(None, [found.reason])]
    return {"comment": "; ".join(reasons)} if reasons else {}
