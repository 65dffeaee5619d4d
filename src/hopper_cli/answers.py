"""What an answer consists of, one list for text, JSON, files and figures; angles in degrees."""

from collections.abc import Iterable
from math import degrees

import numpy as np

from hopper.assessment.limits import Limits
from hopper.assessment.neutral import NeutralPoint
from hopper.assessment.quantity import Quantity
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper_cli.rows import Column, Row

Part = RadialAssessment | StabilityAssessment

# Of profiles over [-theta_w, theta_w]; odd, so that one is on the axis.
POINTS = 241


def _row(key: str, label: str, quantity: Quantity | None, units: str = "1", scale: str = "") -> Row:
    if quantity is None:
        return Row(key, label, units, scale)
    value, error = quantity.value, quantity.error
    if units == "degree":
        value, error = degrees(value), degrees(error)
    return Row(key, label, units, scale, value, error)


def radial_rows(radial: RadialAssessment) -> list[Row]:
    """Return the numbers of a radial solution."""
    return [
        _row("sigma_axis", "average stress on the axis", radial.sigma_axis, scale="rho g r"),
        _row("sigma_wall", "average stress at the wall", radial.sigma_wall, scale="rho g r"),
        _row("psi_wall", "Sokolovskii angle psi at the wall", radial.psi_wall, "radian"),
        _row("psi_max", "largest psi", radial.psi_max, "radian"),
        _row("theta_psi_max_deg", "polar angle of the largest psi", radial.theta_psi_max, "degree"),
        _row("u_wall", "velocity at the wall", radial.u_wall, scale="u(0)"),
        _row("flow_factor", "flow factor", radial.flow_factor),
        Row("solutions", "number of radial solutions for this wall", value=radial.solutions),
    ]


def radial_columns(radial: RadialAssessment) -> list[Column]:
    """Return the fields over the polar angle; the velocity only where it is known."""
    half_angle = radial.solution.hopper.half_angle
    theta = np.linspace(-half_angle, half_angle, POINTS)
    sigma, psi, u = radial.profiles(theta)
    columns = [
        Column("theta", "polar angle", "degree", values=np.degrees(theta)),
        Column("sigma", "average stress", scale="rho g r", values=sigma),
        Column("psi", "Sokolovskii angle", "radian", values=psi),
    ]
    if u is not None:
        columns.append(Column("u", "radial velocity", scale="u(0)", values=u))
    return columns


def limit_rows(limits: Limits) -> list[Row]:
    """Return the limits of the wall friction."""
    folds = limits.friction is not None and limits.friction.end == "fold"
    return [
        _row("mu_fold", "mu at the fold", limits.coefficient if folds else None),
        _row("mu_limit", "largest mu with a radial solution", limits.coefficient),
        _row("mass_flow_limit_deg", "mass-flow limit of phi", limits.mass_flow, "degree"),
        tangency_row(limits.tangency),
    ]


def tangency_row(tangency: Quantity | None) -> Row:
    """Return the end of the linear theory of stability."""
    return _row("mu_tangency", "mu beyond which stability is not defined", tangency)


def stability_rows(found: StabilityAssessment) -> list[Row]:
    """Return the numbers of a verdict of stability."""
    line, transient = found.result.line, found.transient
    amplification = transient.amplification if transient else None
    growth = transient.growth if transient else None
    condition = transient.condition if transient else None
    modes = transient.modes if transient else None
    return [
        _row("line", "asymptotic line of Re(lambda)", Quantity(line.abscissa, line.error_estimate)),
        _row("abscissa", "supremum of Re(lambda)", found.abscissa),
        _row(
            "transient_amplification",
            "transient amplification",
            amplification,
            scale="exp(-t abscissa)",
        ),
        _row("transient_growth", "transient growth, largest norm of exp(-tM)", growth),
        _row("kappa", "condition number of the modes", condition),
        Row("transient_modes", "number of modes followed", value=modes),
    ]


def stability_columns(found: StabilityAssessment) -> list[Column]:
    """Return the resolved eigenvalues with Im >= 0, by modulus."""
    return [
        Column("eigenvalue_real", "real part of the eigenvalue", values=found.spectrum.real),
        Column("eigenvalue_imag", "imaginary part of the eigenvalue", values=found.spectrum.imag),
        Column("eigenvalue_error", "error of the eigenvalue", values=found.spectrum_errors),
    ]


def columns(found: Part) -> list[Column]:
    """Return the arrays of a part of an assessment."""
    if isinstance(found, RadialAssessment):
        return radial_columns(found)
    return stability_columns(found)


def neutral_rows(found: NeutralPoint) -> list[Row]:
    """Return the numbers of a neutral point."""
    return [_row("delta_neutral_deg", "neutral angle of internal friction", found.delta, "degree")]


def largest_relative_error(rows: Iterable[Row]) -> float:
    """Return the largest relative error; of angles, in radians."""
    return max(row.relative_error for row in rows)


_ENDS = {
    "fold": "where a second branch of solutions begins",
    "wall": "where the wall is as rough as the material",
    "interior": "where psi reaches its singular angle inside the hopper",
    "axis": "where the stress on the axis vanishes",
}


def radial_sentence(radial: RadialAssessment) -> str:
    """Return the answer in words."""
    limits, sentence = radial.limits, "A radial solution exists"
    if limits.friction is not None and limits.coefficient is not None:
        sentence += f" up to mu = {limits.coefficient.value:.6g}, {_ENDS[limits.friction.end]}"
    if limits.mass_flow is not None:
        flows = radial.solution.friction_angle <= limits.mass_flow.value
        limit = f"the mass-flow limit, phi = {degrees(limits.mass_flow.value):.6g} deg"
        sentence += f"; the wall is {'within' if flows else 'beyond'} {limit}"
    return f"{sentence}."


def stability_sentence(found: StabilityAssessment) -> str:
    """Return the verdict in words."""
    if found.verdict == "neutral":
        return "Neutral: the abscissa is zero within its error."
    change = "decay" if found.verdict == "stable" else "grow"
    cause = {"mode": "a low mode", "line": "the asymptotic line"}[found.result.governed_by]
    verdict = found.verdict.capitalize()
    return f"{verdict}: perturbations {change} down the hopper, governed by {cause}."


def neutral_sentence(found: NeutralPoint) -> str:
    """Return the answer in words."""
    delta = f"{degrees(found.delta.value):.6g} deg"
    return f"Stable above delta = {delta}, unstable just below."
