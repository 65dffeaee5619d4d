"""Hoppers of the list `cases` as they are given: numbers, or ranges in the words of the command."""

from argparse import ArgumentTypeError, Namespace
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from hopper_cli import ranges, values
from hopper_data.walls import Wall

_TYPES: dict[str, Callable[[str], float]] = {
    "delta_deg": values.angle,
    "half_angle_deg": values.angle,
    "mu": values.coefficient,
    "phi_deg": values.wall_angle,
}


def problems(case: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield the keys of a case that are no numbers and no ranges, with what is wrong."""
    walls = [key for key in ("mu", "phi_deg") if key in case]
    if len(walls) != 1:
        yield "mu", "give one of mu and phi_deg" + (", not both" if walls else "")
    for key, single in _TYPES.items():
        if isinstance(text := case.get(key), str):
            try:
                ranges.ranged(single)(text)
            except ArgumentTypeError as error:
                yield key, str(error)


def options(case: Mapping[str, Any]) -> Namespace:
    """Return a case as options of the command."""
    given = {
        key.removesuffix("_deg"): ranges.ranged(single)(value) if isinstance(value, str) else value
        for key, single in _TYPES.items()
        if (value := case.get(key)) is not None
    }
    walls = {"mu": None, "phi": None}
    return Namespace(geometry=case["geometry"], model=case["model"], **(walls | given))


def roughest(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return a case with the weakest material and the roughest wall of its ranges."""
    given = options(case)
    wall = Wall.of(_end(given.mu, "high"), _end(given.phi, "high"))
    key = "mu" if given.phi is None else "phi_deg"
    return {**case, "delta_deg": _end(given.delta, "low"), "mu": wall.mu, "at": key}


def middle(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return the hopper in the middle of the ranges of a case, its wall both ways."""
    given = options(case)
    wall = Wall.of(_end(given.mu, "middle"), _end(given.phi, "middle"))
    return {
        "geometry": given.geometry,
        "model": given.model,
        "delta_deg": _end(given.delta, "middle"),
        "half_angle_deg": _end(given.half_angle, "middle"),
        **vars(wall),
    }


def _end(value: Any, name: str) -> Any:
    return getattr(value, name) if isinstance(value, ranges.Given) else value


def shown(case: Mapping[str, Any]) -> dict[str, str]:
    """Return what is given of a case, by short names, with units."""
    return {
        key.removesuffix("_deg").replace("_", " "): f"{value:g}{unit}"
        if not isinstance(value, str)
        else f"{value}{unit}"
        for key in _TYPES
        if (value := case.get(key)) is not None
        for unit in ["°" if key.endswith("_deg") else ""]
    }
