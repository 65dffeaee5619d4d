"""Similarity solutions for granular flows in hoppers (Gremaud, Matthews, Shearer 2000).

Numerics only: functions of arrays and small frozen dataclasses. Angles are in radians, stresses
in units of rho g r. The names below are what most users need; everything else is imported from its
room, for instance ``from hopper.stability.transient import modal_basis``.

A hopper, its material and its wall
    Hopper, yield_condition, HopperError
Radial fields
    solve_radial, radial_solutions, solve_radial_family, solve_velocity, flow_factor,
    friction_limit, mass_flow_half_angle, RadialSolution, VelocityField, FrictionLimit
Linear stability
    linear_stability, LinearStability, neutral_delta, stable_deltas, neutral_curve, NeutralCurve
What is known about one hopper, with errors
    assess, Assessment
Any dense matrix
    schur_form, pseudospectrum, smallest_singular_values, pseudospectral_abscissa,
    pseudospectral_radius, distance_to_instability, SchurForm, Pseudospectrum
"""

TYPE_CHECKING = False  # as typing has it, whose import takes longer than all of this
if TYPE_CHECKING:
    from hopper.assessment.summary import Assessment as Assessment
    from hopper.assessment.summary import assess as assess
    from hopper.domain.neutral_curve import NeutralCurve as NeutralCurve
    from hopper.domain.neutral_curve import neutral_curve as neutral_curve
    from hopper.domain.neutral_points import neutral_delta as neutral_delta
    from hopper.domain.neutral_points import stable_deltas as stable_deltas
    from hopper.errors import HopperError as HopperError
    from hopper.problem import Hopper as Hopper
    from hopper.radial.flow_factor import flow_factor as flow_factor
    from hopper.radial.friction_limit import FrictionLimit as FrictionLimit
    from hopper.radial.friction_limit import friction_limit as friction_limit
    from hopper.radial.mass_flow import mass_flow_half_angle as mass_flow_half_angle
    from hopper.radial.solution import RadialSolution as RadialSolution
    from hopper.radial.solution import radial_solutions as radial_solutions
    from hopper.radial.solution import solve_radial as solve_radial
    from hopper.radial.solution import solve_radial_family as solve_radial_family
    from hopper.radial.velocity import VelocityField as VelocityField
    from hopper.radial.velocity import solve_velocity as solve_velocity
    from hopper.spectral.pseudospectrum import Pseudospectrum as Pseudospectrum
    from hopper.spectral.pseudospectrum import pseudospectrum as pseudospectrum
    from hopper.spectral.pseudospectrum import smallest_singular_values as smallest_singular_values
    from hopper.spectral.robust_stability import distance_to_instability as distance_to_instability
    from hopper.spectral.robust_stability import pseudospectral_abscissa as pseudospectral_abscissa
    from hopper.spectral.robust_stability import pseudospectral_radius as pseudospectral_radius
    from hopper.spectral.schur import SchurForm as SchurForm
    from hopper.spectral.schur import schur_form as schur_form
    from hopper.stability.modes import LinearStability as LinearStability
    from hopper.stability.modes import linear_stability as linear_stability
    from hopper.yield_conditions import yield_condition as yield_condition

__version__ = "0.2.0"

# The same for the interpreter, which imports a room when one of its names is first asked for.
_HOMES = {
    "assessment.summary": ("Assessment", "assess"),
    "domain.neutral_curve": ("NeutralCurve", "neutral_curve"),
    "domain.neutral_points": ("neutral_delta", "stable_deltas"),
    "errors": ("HopperError",),
    "problem": ("Hopper",),
    "radial.flow_factor": ("flow_factor",),
    "radial.friction_limit": ("FrictionLimit", "friction_limit"),
    "radial.mass_flow": ("mass_flow_half_angle",),
    "radial.solution": (
        "RadialSolution",
        "radial_solutions",
        "solve_radial",
        "solve_radial_family",
    ),
    "radial.velocity": ("VelocityField", "solve_velocity"),
    "spectral.pseudospectrum": ("Pseudospectrum", "pseudospectrum", "smallest_singular_values"),
    "spectral.robust_stability": (
        "distance_to_instability",
        "pseudospectral_abscissa",
        "pseudospectral_radius",
    ),
    "spectral.schur": ("SchurForm", "schur_form"),
    "stability.modes": ("LinearStability", "linear_stability"),
    "yield_conditions": ("yield_condition",),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}
__all__ = ["__version__", *_HOME]


if not TYPE_CHECKING:  # who checks types must not believe in every name

    def __getattr__(name):
        """Return a name from its room (PEP 562)."""
        if name not in _HOME:
            from difflib import get_close_matches

            nearest = get_close_matches(name, _HOME, n=1, cutoff=0.0)[0]
            raise AttributeError(
                f"module 'hopper' has no attribute {name!r}: did you mean {nearest!r}?", name=name
            )
        from importlib import import_module

        found = globals()[name] = getattr(import_module(f"hopper.{_HOME[name]}"), name)
        return found

    def __dir__():
        return sorted({*globals(), *_HOME} - {"TYPE_CHECKING"})
