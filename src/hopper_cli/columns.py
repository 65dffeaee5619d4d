"""Columns that a table of hoppers may have beside the short answer."""

from collections.abc import Callable, Mapping, Sequence
from math import radians
from typing import Any

from hopper.assessment.limits import assess_limits
from hopper.assessment.radial import assess_radial
from hopper.assessment.stability import assess_stability
from hopper.design.design import design
from hopper.errors import HopperError
from hopper.radial.solution import solve_radial
from hopper.stability.modes import Disturbances
from hopper_cli.errors import UsageError
from hopper_data import assessments, tables
from hopper_data.inputs import Case
from hopper_data.tables import Table, Variable, text

SHORT = (
    *("sentence", "verdict", "abscissa", "abscissa_error", "governed_by", "flow_factor"),
    *("flow_factor_error", "reason"),
)
# Degrees below the smallest limit, as `hopper design` keeps by default.
_MARGIN = 3.0
_Answer = dict[str, Any]


def _radial(case: Case, _: Disturbances | None) -> Any:
    return assess_radial(case.hopper, case.wall.friction_angle)


def _limits(case: Case, _: Disturbances | None) -> Any:
    return assess_limits(case.hopper)


def _transients(case: Case, disturbances: Disturbances | None) -> Any:
    return assess_stability(solve_radial(case.hopper, case.wall.friction_angle), disturbances)


def _design(case: Case, disturbances: Disturbances | None) -> Any:
    return design(case.material, radians(_MARGIN), None, disturbances)


def _without(table: Table, *names: str) -> Table:
    return tuple(variable for variable in table if variable.name not in names)


# What is computed for each group, and its columns. Of a table nobody knows outlets: they need
# flow functions.
_GROUPS: Mapping[str, tuple[Callable[[Case, Disturbances | None], Any], Table]] = {
    "radial": (_radial, _without(assessments.RADIAL, "flow_factor")),
    "limits": (_limits, assessments.LIMITS),
    "transients": (_transients, _without(assessments.STABILITY, "abscissa")),
    "design": (
        _design,
        (
            *_without(assessments.DESIGN, "flow_factor", "critical_stress_kpa", "outlet_m"),
            text("half_angle_governed_by", "smallest limit", source="half_angles.governed_by"),
        ),
    ),
}


def _titles(variable: Variable) -> tuple[str, ...]:
    if variable.kind == "text":
        return (variable.name,)
    name = f"{variable.name}_deg" if variable.units == "radian" else variable.name
    return name, f"{name}_error"


class Columns:
    """Columns asked for by their names, or those of their groups, after those of the answer."""

    def __init__(self, names: Sequence[str]) -> None:
        known = {
            _titles(variable)[0]: (group, variable)
            for group, (_, table) in _GROUPS.items()
            for variable in table
        }
        self._wanted: dict[str, dict[str, Variable]] = {}
        for name in names:
            if name not in known and name not in _GROUPS and name not in SHORT:
                raise UsageError(
                    f"argument --columns: {name!r} is unknown: use {', '.join(_GROUPS)}, or of "
                    f"their columns {', '.join(known)}"
                )
            for title, (group, variable) in known.items():
                if name in (title, group):
                    self._wanted.setdefault(group, {})[title] = variable
        more = [
            title
            for group in self._wanted.values()
            for variable in group.values()
            for title in _titles(variable)
        ]
        self.titles: tuple[str, ...] = (*SHORT[:-1], *more, SHORT[-1])

    def fill(self, answer: _Answer, case: Case, disturbances: Disturbances | None) -> _Answer:
        """Return an answer with the columns asked for; None, and a reason, for what is not."""
        reasons = [answer["reason"]] if answer["reason"] else []
        filled: _Answer = {**dict.fromkeys(self.titles), **answer}
        for group, variables in self._wanted.items():
            try:
                found = _GROUPS[group][0](case, disturbances)
            except HopperError as error:
                if str(error) not in reasons:
                    reasons.append(f"{group}: {error}")
                continue
            reasons += getattr(found, "notes", ())
            for row in tables.rows(found, variables.values()):
                shown = row.in_degrees() if row.variable.units == "radian" else row
                cells = zip(_titles(row.variable), (shown.value, shown.error), strict=False)
                filled.update(cells)
        return {**filled, "reason": "; ".join(dict.fromkeys(reasons)) or None}
