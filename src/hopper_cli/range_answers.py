"""What the subcommands answer where an option is known in a range."""

from argparse import Namespace
from math import atan, degrees, floor, log10, radians, tan
from typing import Any

from hopper.design.half_angles import LIMITS
from hopper.design.material import NARROWEST
from hopper.problem import as_geometry
from hopper.uncertainty.box import Box, Range
from hopper.uncertainty.designs import RangedDesign, design_over
from hopper.uncertainty.ranged import Ranged, radial_over, stability_over
from hopper.uncertainty.sampling import Share
from hopper.yield_conditions import yield_condition
from hopper_cli import designs, documents, ranges, sentences, text
from hopper_cli.errors import UsageError
from hopper_data import assessments, tables
from hopper_data.tables import Row, Table, angle

_SPARE: Table = (angle("half_angle_to_spare_deg", "half angle to spare", source="spare"),)
_RADIAL: Table = (*_SPARE, *assessments.RADIAL, *assessments.LIMITS)
_STABILITY: Table = (*_SPARE, *assessments.STABILITY, *assessments.TANGENCY)
_NOT_OVER_RANGES = {
    "radial": "the number of solutions is not looked at over a range",
    "stability": "eigenvalues and transient growth are not looked at over a range",
}
_WORDS = {
    "radial_solution": "a radial solution exists",
    "velocity": "radial flow reaches the wall",
    "no_wall_angle": "the wall is rougher than the material",
    "not_converged": "not resolved",
    "limit": "limit of a radial solution",
}
# Errors that are not worth a word, relative.
_SMALL = 1e-6


def answer(options: Namespace) -> str:
    """Return intervals over the ranges of the options, and the share in which each verdict holds.

    Raises
    ------
    UsageError
        If a range holds impossible hoppers, or is not looked at for that material.
    """
    box = box_of(options)
    if options.command == "design":
        return _design(options, box)
    if options.command == "radial":
        return _text_or_json(options, radial_over(box, options.normal), _RADIAL)
    if options.model == "von-mises":
        raise UsageError(
            "argument --model: the stability of von Mises cones is not looked at over a range: "
            "give steps, as 30:60:1"
        )
    found = stability_over(box, options.disturbances, options.normal)
    return _text_or_json(options, found, _STABILITY)


def judged_over(options: Namespace) -> Ranged:
    """Return the verdicts over a range: of stability, of von Mises cones of the radial solution."""
    box = box_of(options)
    return radial_over(box) if options.model == "von-mises" else stability_over(box)


def box_of(options: Namespace) -> Box:
    """Return the hoppers of ranges.

    Raises
    ------
    UsageError
        If the roughest wall is rougher than the weakest material.
    """
    condition, by_mu = yield_condition(options.model), options.phi is None
    delta = _range(options.delta, radians)
    half_angle = _range(getattr(options, "half_angle", degrees(NARROWEST)), radians)
    wall = _range(options.mu, float) if by_mu else _range(options.phi, radians)
    largest = condition.largest_friction_angle(delta.low)
    if (atan(wall.high) if by_mu else wall.high) > largest:
        most = f"{tan(largest):.6g}" if by_mu else f"{degrees(largest):.6g} deg"
        raise UsageError(
            f"argument --{'mu' if by_mu else 'phi'}: its range ends above {most}, the most that a "
            f"{condition.name} material with delta = {degrees(delta.low):.6g} deg transmits: end "
            "it there, or raise --delta"
        )
    return Box(as_geometry(options.geometry), delta, wall, half_angle, condition, by_mu)


def _range(value: ranges.Value, unit: Any) -> Range:
    ends = (value.low, value.high) if isinstance(value, ranges.Given) else (value, value)
    return Range(*map(unit, ends))


def _design(options: Namespace, box: Box) -> str:
    needed = designs.demand(options)
    found = design_over(box, radians(options.margin), needed, options.disturbances, options.normal)
    first = sentences.design_range_sentence(found, options.margin)
    low, high = (tables.rows(_nested(found, end), assessments.DESIGN) for end in ("low", "high"))
    if options.json:
        recommended = found.recommended
        return documents.over_ranges(
            {**_inputs(options), "margin_deg": options.margin},
            list(zip(low, high, strict=True)),
            **{
                f"{a.variable.name}_error": None if a.value is None else [a.error, b.error]
                for a, b in zip(low, high, strict=True)
            },
            sentence=first,
            half_angle_recommended_whole_deg=recommended and degrees(recommended.value),
            governed_by=found.middle.half_angles.governed_by,
            **_shares(found.shares, found.probabilities),
            notes=[*options.doubts, *found.middle.notes],
        )
    cells = [cell for pair in zip(low, high, strict=True) if (cell := _cell(*pair))]
    cells += share_cells(found.shares, found.probabilities)
    words = [*_explanation(options, low + high), *found.middle.notes]
    return documents.as_text(first, cells, words)


def _nested(found: RangedDesign, end: str) -> dict[str, Any]:
    """Return one end of each interval as a design has it."""
    whole: dict[str, Any] = {}
    for name, interval in found.numbers.items():
        part, _, last = name.rpartition(".")
        (whole.setdefault(part, {}) if part else whole)[last] = getattr(interval, end)
    return whole


def _text_or_json(options: Namespace, found: Ranged, table: Table) -> str:
    first = sentences.mass_flow_sentence(found.pattern, found)
    low, high = (
        tables.rows({name: getattr(each, end) for name, each in found.numbers.items()}, table)
        for end in ("low", "high")
    )
    notes = [_NOT_OVER_RANGES[options.command]]
    if found.cut_off > _SMALL:
        notes.append(
            f"{100 * found.cut_off:.2g} % of the normal values are impossible and left out"
        )
    if options.json:
        return documents.over_ranges(
            _inputs(options),
            list(zip(low, high, strict=True)),
            sentence=first,
            mass_flow=found.pattern.mass_flow,
            **_shares(found.shares, found.probabilities),
            notes=[*options.doubts, *notes],
        )
    cells = [cell for pair in zip(low, high, strict=True) if (cell := _cell(*pair))]
    cells += share_cells(found.shares, found.probabilities)
    return documents.as_text(first, cells, [*_explanation(options, low + high), *notes])


def _cell(low: Row, high: Row) -> tuple[str, str] | None:
    if low.value is None:
        return None
    if low.variable.units == "radian":
        low, high = low.in_degrees(), high.in_degrees()
    return low.variable.label, f"{_end(low)} to {_end(high)} {text.unit(low.variable)}".rstrip()


def _end(row: Row) -> str:
    value, error = row.value or 0.0, row.error or 0.0
    least = _SMALL * abs(value)
    return text.with_error(value, error) if error > least else text.rounded(value, least)


def share_cells(
    shares: dict[str, Share], probabilities: dict[str, Share] | None = None
) -> list[tuple[str, str]]:
    """Return in words what holds, and in which share of the range."""
    cells = []
    for name in dict.fromkeys([*shares, *(probabilities or {})]):
        words = f"{_percent(shares[name])} of the range" if name in shares else "not in the range"
        if probabilities is not None:
            chance = _percent(probabilities[name]) if name in probabilities else "next to none"
            words += f", probability {chance}"
        label = _WORDS.get(name) or name.replace("_", " ")
        cells.append((f"{label} is smallest" if name in LIMITS else label, words))
    return cells


def _percent(share: Share) -> str:
    if not share.error:
        return f"{100 * share.value:g} %"
    digits = max(0, -floor(log10(100 * share.error)))
    return f"{100 * share.value:.{digits}f} +- {100 * share.error:.{digits}f} %"


def _explanation(options: Namespace, rows: list[Row]) -> list[str]:
    """Return what was given, and which uncertainty is which."""
    given = ", ".join(
        f"{ranges.option(name)[2:]} {value}{'' if name == 'mu' else ' deg'}"
        for name in ranges.RANGED
        if (value := getattr(options, name, None)) is not None
    )
    errors = [row.relative_error for row in rows if row.value]
    return [
        f"Over a range: {options.geometry}, {options.model}, {given}",
        "'to': what the given range leaves open, where there is a value; '+-': numerical error, at "
        f"most {max(errors, default=0.0):.0e} of the value, and of shares that of sampling.",
    ]


def _shares(
    shares: dict[str, Share], probabilities: dict[str, Share] | None
) -> dict[str, dict[str, float] | None]:
    document: dict[str, dict[str, float] | None] = {}
    both: dict[str, dict[str, Share] | None] = {"share": shares, "probability": probabilities}
    for key, known in both.items():
        for suffix, part in (("", "value"), ("_error", "error")):
            document[key + suffix] = (
                {name: getattr(share, part) for name, share in known.items()} if known else None
            )
    return document


def _inputs(options: Namespace) -> dict[str, Any]:
    """Return the inputs by the keys of a plain answer: a range as its ends."""
    wall, unit = (options.phi, radians) if options.mu is None else (options.mu, atan)
    friction = _range(wall, unit)
    angles = [degrees(friction.low), degrees(friction.high)]
    inputs: dict[str, Any] = {
        "geometry": options.geometry,
        "model": options.model,
        "delta_deg": _ends(options.delta),
        **({} if options.command == "design" else {"half_angle_deg": _ends(options.half_angle)}),
        "mu": [tan(friction.low), tan(friction.high)] if options.mu is None else _ends(options.mu),
        "phi_deg": angles if options.phi is None else _ends(options.phi),
        "normal": options.normal,
    }
    for key in ("mu", "phi_deg"):
        if isinstance(inputs[key], list) and inputs[key][0] == inputs[key][1]:
            inputs[key] = inputs[key][0]
    return inputs


def _ends(value: ranges.Value) -> Any:
    return [value.low, value.high] if isinstance(value, ranges.Given) else value
