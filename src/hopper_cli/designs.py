"""What ``hopper design`` answers."""

from argparse import Namespace
from math import radians

from hopper.design.design import Demand, design
from hopper.design.flow_pattern import flow_pattern
from hopper.design.material import Material
from hopper.design.outlet import linear_flow_function
from hopper.errors import InvalidParameterError
from hopper.problem import as_geometry
from hopper.yield_conditions import yield_condition
from hopper_cli import documents, sentences, text
from hopper_cli.errors import UsageError
from hopper_data import assessments, tables
from hopper_data.flow_functions import read_flow_function
from hopper_data.inputs import Case
from hopper_data.walls import Wall


def answer(options: Namespace) -> str:
    """Return the largest half angles, the recommended one, and what follows there.

    Raises
    ------
    UsageError
        If the flow function cannot be read, or no outlet is wide enough for it.
    HopperError
        As :func:`hopper.design.design.design`.
    """
    wall = Wall.of(options.mu, options.phi)
    material = Material(
        as_geometry(options.geometry),
        radians(options.delta),
        wall.friction_angle,
        yield_condition(options.model),
    )
    needed = demand(options)
    try:
        found = design(material, radians(options.margin), needed, options.disturbances)
    except InvalidParameterError as error:
        option = "--flow-function" if options.flow_function else "--flow-function-intercept"
        raise UsageError(f"argument {option}: {error}") from None
    rows = tables.rows(found, assessments.DESIGN)
    if options.json:
        inputs = {
            "geometry": options.geometry,
            "model": options.model,
            "delta_deg": options.delta,
            **vars(wall),
            "margin_deg": options.margin,
        }
        return documents.as_json(
            inputs,
            rows,
            **{f"{row.variable.name}_error": row.error for row in rows},
            sentence=sentences.design_sentence(found),
            governed_by=found.half_angles.governed_by,
            notes=[*options.doubts, *found.notes],
        )
    title = f"{options.geometry}, {options.model}, delta {options.delta:g} deg, {wall}"
    return documents.as_text(
        sentences.design_sentence(found),
        text.number_cells(rows),
        [f"Design: {title}, margin {options.margin:g} deg", *found.notes],
    )


def mass_flow(case: Case) -> str:
    """Return whether there is mass flow, in a sentence; the same in every answer about a hopper."""
    return sentences.mass_flow_sentence(flow_pattern(case.material, case.hopper.half_angle))


def demand(options: Namespace) -> Demand | None:
    """Return what an outlet is asked to be wide enough for, None if nothing.

    Raises
    ------
    UsageError
        If the flow function cannot be read.
    """
    if options.bulk_density is None:
        return None
    if options.flow_function is None:
        slope = options.flow_function_slope or 0.0
        function = linear_flow_function(options.flow_function_intercept, slope)
    else:
        try:
            function = read_flow_function(options.flow_function)
        except InvalidParameterError as error:
            raise UsageError(f"argument --flow-function: {error}") from None
    return Demand(function, options.bulk_density)
