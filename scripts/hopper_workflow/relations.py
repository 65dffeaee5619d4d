"""What a schema cannot say of config.yaml: relations between two values."""

import math
from collections.abc import Iterator, Mapping
from math import atan, radians
from pathlib import Path
from typing import Any

from hopper_workflow import entries, own_hoppers
from hopper.errors import InvalidParameterError, WallFrictionError
from hopper.yield_conditions import yield_condition

Violation = tuple[str, str]


def violations(config: Mapping[str, Any]) -> Iterator[Violation]:
    """Yield key and problem of each contradiction in a configuration that the schema allows."""
    for key, section in _sections(config, ""):
        yield from _mesh(key, section)
        yield from _range(key, section)
    yield from _drawing(config)
    yield from _counts(config)
    yield from entries.problems(config)
    for index, case in enumerate(config["cases"]):
        for name, problem in own_hoppers.problems(case):
            yield f"cases[{index}].{name}", problem
    for key, case in _hoppers(config):
        yield from _wall(key, **case)
    for key, geometry, top in _tops(config):
        yield from _top(key, geometry, **top)


def _sections(value: Any, key: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield every mapping of a configuration, with its key."""
    if isinstance(value, Mapping):
        yield key, value
        for name, item in value.items():
            yield from _sections(item, f"{key}.{name}" if key else name)


def _mesh(key: str, section: Mapping[str, Any]) -> Iterator[Violation]:
    coarse, nodes = section.get("coarse_nodes", -1), section.get("nodes", 0)
    if coarse >= nodes:
        problem = f"{coarse} is not below nodes = {nodes}: the first mesh must be the finer one"
        yield f"{key}.coarse_nodes", problem


def _range(key: str, section: Mapping[str, Any]) -> Iterator[Violation]:
    if "stop" not in section:
        return
    start, stop = section.get("start", -math.inf), section["stop"]
    if isinstance(stop, str):
        return
    if stop <= start:
        yield f"{key}.stop", f"{stop} must be above start"
    elif section.get("step", 0) > stop - start:
        yield f"{key}.step", f"{section['step']} must not exceed stop - start = {stop - start:g}"


def _drawing(config: Mapping[str, Any]) -> Iterator[Violation]:
    """Check what is drawn: the particle and the zone inside the hopper, colours in order."""
    for key, name, hopper in (
        ("fig_1_1", "theta_deg", config["fig_1_1"]),
        ("fig_3_2", "stagnant_from_deg", config["radial"]["fig_3_2"]),
    ):
        angle = config[key][name]
        if angle >= hopper["half_angle_deg"]:
            yield f"{key}.{name}", f"{angle} must be below half_angle_deg"
    linear, largest = config["fig_4_5_map"]["color_range"]
    if linear >= largest:
        yield "fig_4_5_map.color_range", f"{linear} must be below {largest}"


def _counts(config: Mapping[str, Any]) -> Iterator[Violation]:
    for key, grid in (
        ("stability_map", config["stability_map"]), ("von_mises.map", config["von_mises"]["map"])
    ):  # fmt: skip
        if grid["chunks"] > grid["delta_deg"]["points"]:
            yield f"{key}.chunks", f"{grid['chunks']} is more than delta_deg has points"
    smooth = config["claims"]["linear"]["smooth"]
    if smooth["nodes"] <= 2 * smooth["modes"]:
        yield "claims.linear.smooth.nodes", f"{smooth['nodes']} must be more than twice the modes"


def _hoppers(config: Mapping[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield every hopper with one wall friction, and its key."""
    for name, case in config["radial"].items():
        # The claims ledger solves the hopper of Figure 3.2 at the frictions of both figures.
        ledger = [config["radial"]["fig_3_2"]] if name in ("fig_3_1", "fig_3_2") else []
        for hopper in (case, *ledger):
            for model in hopper["models"]:
                for index, mu in enumerate(case["mu"]):
                    at = {"model": model, "mu": mu, "at": f"mu[{index}]"}
                    yield f"radial.{name}", {**hopper, **at}
    for name, case in config["spectra"].items():
        yield f"spectra.{name}", case
    for key, hopper in _marched(config):
        yield key, dict(hopper)
    linear = config["claims"]["linear"]
    printed_at = {**config["spectra"][linear["spectrum"]], "mu": linear["printed_at"]["mu"]}
    yield "claims.linear.printed_at", printed_at
    for name, case in config["fig_vm_spectra"]["hoppers"].items():
        yield f"fig_vm_spectra.hoppers.{name}", {**case, "model": "von-mises"}
    for index, case in enumerate(config["cases"]):
        if not list(own_hoppers.problems(case)):
            yield f"cases[{index}]", own_hoppers.roughest(case)


def _marched(config: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the hoppers of marches, and their keys."""
    for section in entries.MARCHES:
        for name, entry in config[section].items():
            if "hopper" in entry:
                yield f"{section}.{name}.hopper", entry["hopper"]
            for index, hopper in enumerate(entry.get("hoppers", [])):
                yield f"{section}.{name}.hoppers[{index}]", hopper


def _tops(config: Mapping[str, Any]) -> Iterator[tuple[str, str, Mapping[str, Any]]]:
    """Yield the tops of marches that are given in full: key, a geometry, and the top."""
    for name, entry in config["march_breakdown"].items():
        yield f"march_breakdown.{name}.top", entry["hopper"]["geometry"], entry["top"]
    for name, entry in config["march_depth"].items():
        geometries = {hopper["geometry"] for hopper in entry["hoppers"]}
        for index, top in enumerate(entry["tops"]):
            yield f"march_depth.{name}.tops[{index}]", min(geometries), top


def _top(key: str, geometry: str, name: str, **numbers: float) -> Iterator[Violation]:
    """Check that a top has the number it needs and no other, and is symmetric in a cone."""
    of_file = entries.is_file_of_top(name)
    needed = {"scaled": {"factor"}, "linear": set(), "bin": set()}.get(name, {"eps"})
    if of_file:
        needed = set()
    if set(numbers) != needed:
        yield key, f"{name} needs {' and '.join(needed) or 'no number'} beside its name"
    if name == "one-sided" and geometry == "cone":
        yield key, "the top of a cone must be symmetric: use bump-s"
    if of_file and not Path(name).is_file():
        yield key, f"there is no file {name}: correct its path from the folder of the run"


def _wall(
    key: str,
    *,
    delta_deg: float,
    mu: float,
    geometry: str = "cone",
    model: str = "mohr-coulomb",
    at: str = "mu",
    **_: Any,
) -> Iterator[Violation]:
    """Check that the model is formulated for the geometry, and transmits the wall friction."""
    if model == "von-mises" and geometry == "wedge":
        name = "models" if "[" in at else "model"
        yield f"{key}.{name}", "von-mises is formulated for cones only"
    try:
        yield_condition(model).wall_angle(radians(delta_deg), atan(mu))
    except WallFrictionError as error:
        yield f"{key}.{at}", str(error)
    except InvalidParameterError as error:  # an angle so small that it is none in radians
        yield f"{key}.delta_deg", str(error)
