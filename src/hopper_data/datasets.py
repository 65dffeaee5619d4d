"""From a result and a table that describes it to the variables of a CF file."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from hopper.quantity import Quantity
from hopper_data.contents import CfDataset, CfVariable
from hopper_data.tables import Variable, number, parts


def dataset(
    result: Any,
    table: Iterable[Variable],
    coordinates: Iterable[Variable] = (),
    leading: str = "",
    attributes: Mapping[str, Any] | None = None,
) -> CfDataset:
    """Return the variables of a result.

    What is None in the result is left out; a quantity is followed by its error.

    Parameters
    ----------
    result : object or mapping
        Where the sources of the variables lead from.
    table, coordinates : iterables of Variable
        Data and coordinates.
    leading : str
        Dimensions in front of those of every variable in ``table``, separated by spaces.
    attributes : mapping, optional
        Global attributes.

    Examples
    --------
    >>> from hopper_data.datasets import dataset
    >>> from hopper_data.inputs import solution_of
    >>> from hopper_data.tables import number
    >>> solution = solution_of("cone", delta_deg=40, half_angle_deg=20, mu=0.3)
    >>> found = dataset(solution, [number("sigma_axis", "stress on the axis")])
    >>> found.data["sigma_axis"][2]
    {'long_name': 'stress on the axis', 'units': '1'}
    """
    data = _variables(result, table, tuple(leading.split()))
    return CfDataset(data, _variables(result, coordinates, ()), attributes or {})


def _variables(
    result: Any, table: Iterable[Variable], leading: tuple[str, ...]
) -> dict[str, CfVariable]:
    found: dict[str, CfVariable] = {}
    for variable in table:
        values = variable.of(result)
        if values is not None:
            found |= _described(variable, values, leading + tuple(variable.over.split()))
    return found


def _described(variable: Variable, values: Any, over: tuple[str, ...]) -> dict[str, CfVariable]:
    if isinstance(values, Quantity):
        error = number(f"{variable.name}_error", f"error estimate of {variable.name}")
        return _described(variable, values.value, over) | _described(
            replace(error, units=variable.units), values.error, over
        )
    found: dict[str, CfVariable] = {}
    for part, numbers in parts(variable, values):
        attributes: dict[str, Any] = {"long_name": part.long_name}
        if part.kind == "flag":
            numbers = _codes(numbers, part.meanings)
            attributes["flag_values"] = np.arange(len(part.meanings), dtype=np.int8)
            words = [word.replace(" ", "_") for word in part.meanings]
            attributes["flag_meanings"] = " ".join(words)
        elif part.kind != "text":
            attributes["units"] = part.units
        found[part.name] = over, numbers, attributes
    return found


def _codes(values: Any, meanings: tuple[str, ...]) -> np.ndarray:
    codes = np.asarray(values)
    if codes.dtype.kind in "UO":
        codes = np.reshape(
            [meanings.index(str(word or "none")) for word in codes.flat], codes.shape
        )
    return codes.astype(np.int8)
