"""Check config.yaml against the schema before any job starts."""

import math
from collections.abc import Iterator, Mapping, Sequence
from math import atan, radians
from pathlib import Path
from typing import Any

import jsonschema
import yaml
from jsonschema.exceptions import ValidationError, best_match

from hopper.errors import WallFrictionError
from hopper.yield_conditions import yield_condition


class ConfigurationError(Exception):
    """A configuration value is wrong; the one-line message names the key and the remedy."""


def check(config: Mapping[str, Any], schema_path: str | Path) -> None:
    """Validate a configuration.

    Raises
    ------
    ConfigurationError
        For the most relevant violation of the schema, a value that is not finite, or a wrong order.
    """
    require_schema(config, schema_path)
    _check_order(config)
    _check_cases(config["cases"])


def require_schema(
    data: Mapping[str, Any], schema_path: str | Path, source: str = "config"
) -> None:
    """Validate what a YAML file, called ``source`` in messages, holds against a schema.

    Raises
    ------
    ConfigurationError
        For the most relevant violation, or a value that is not finite.
    """
    for key, value in _leaves(data, ""):
        if isinstance(value, float) and not math.isfinite(value):
            raise ConfigurationError(f"{source} key '{key}' is {value}: give a finite number")
    schema = yaml.safe_load(Path(schema_path).read_text(encoding="utf-8"))
    error = best_match(jsonschema.Draft202012Validator(schema).iter_errors(data))
    if error is not None:
        raise ConfigurationError(f"{source} {_explain(error, schema_path)}")


def _check_order(config: Mapping[str, Any]) -> None:
    """Check what a schema cannot: relations between two keys."""
    for name, spectrum in config["spectra"].items():
        if spectrum["coarse_nodes"] >= spectrum["nodes"]:
            raise ConfigurationError(
                f"config key 'spectra.{name}.coarse_nodes': {spectrum['coarse_nodes']} is not "
                f"below nodes = {spectrum['nodes']}: the first mesh must be the finer one"
            )
    for key, value in _leaves(config, ""):
        parent, _, name = key.rpartition(".")
        if name == "stop" and value <= _get(config, parent).get("start", -math.inf):
            raise ConfigurationError(f"config key '{key}': {value} must be above start")


def _check_cases(cases: Sequence[Mapping[str, Any]]) -> None:
    """Check what a schema cannot: names that repeat, and walls no material transmits."""
    names: set[str] = set()
    for index, case in enumerate(cases):
        key = f"config key 'cases[{index}]"
        if case["name"] in names:
            raise ConfigurationError(f"{key}.name': {case['name']} is taken: give another name")
        names.add(case["name"])
        if case["model"] == "von-mises" and case["geometry"] == "wedge":
            raise ConfigurationError(f"{key}.model': von-mises is formulated for cones only")
        try:
            yield_condition(case["model"]).wall_angle(radians(case["delta_deg"]), atan(case["mu"]))
        except WallFrictionError as error:
            raise ConfigurationError(f"{key}.mu': {error}") from None


def _get(config: Mapping[str, Any], key: str) -> Any:
    for name in key.split("."):
        config = config[name]
    return config


def _leaves(value: Any, key: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, Mapping):
        for name, item in value.items():
            yield from _leaves(item, f"{key}.{name}" if key else str(name))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _leaves(item, f"{key}[{index}]")
    else:
        yield key, value


def _explain(error: ValidationError, schema_path: str | Path) -> str:
    key = error.json_path.removeprefix("$").removeprefix(".") or "top level"
    meaning = error.schema.get("description", "") if isinstance(error.schema, Mapping) else ""
    message = error.message if len(error.message) < 200 else error.message[:200] + " ..."
    hint = f" ({meaning})" if meaning else ""
    return f"key '{key}': {message}{hint}; see {Path(schema_path).name}"
