"""Check config.yaml against the schema before any job starts."""

import copy
import math
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
from jsonschema.exceptions import ValidationError, best_match

from hopper_workflow import older, relations, strict_yaml

_MOST_VALUES = 20_000
_MOST_BITS = 1024  # as many as the largest float


class ConfigurationError(Exception):
    """A configuration value is wrong; the one-line message names the key and the remedy."""


def check_file(path: str | Path, schema_path: str | Path) -> None:
    """Check the text of a configuration file, before Snakemake reads it.

    Raises
    ------
    ConfigurationError
        If the file is not YAML, is easily misread, or has a section that the schema does not know.
    """
    try:
        content = strict_yaml.read(path)
    except strict_yaml.StrictYamlError as error:
        raise ConfigurationError(str(error)) from None
    sections = _schema(schema_path)["properties"]
    for key in content:
        if key not in sections:
            message = f"config key '{key}' is unknown: remove it; see {Path(schema_path).name}"
            raise ConfigurationError(strict_yaml.one_line(message))


def check(config: Mapping[str, Any], schema_path: str | Path) -> None:
    """Validate a configuration; what has a default may be left out.

    Raises
    ------
    ConfigurationError
        For the most relevant violation of the schema, a value that is not finite, or two values
        that contradict each other.
    """
    whole = copy.deepcopy(dict(config))
    older.put_into_new_words(whole)
    require_schema(whole, schema_path)
    bring_up_to_date(whole, schema_path)
    for key, problem in relations.violations(whole):
        raise ConfigurationError(f"config key '{key}': {problem}")


def bring_up_to_date(config: dict[str, Any], schema_path: str | Path) -> list[str]:
    """Add what an older configuration lacks, remove what it need not have; a line for the latter.

    Defaults and deprecated keys are those of the schema; old words are put into new ones.
    """
    older.put_into_new_words(config)
    return list(_updated(config, _schema(schema_path), ""))


def _updated(part: dict[str, Any], schema: Mapping[str, Any], prefix: str) -> Iterator[str]:
    for key, known in schema.get("properties", {}).items():
        if "default" in known:
            part.setdefault(key, copy.deepcopy(known["default"]))
        if key not in part:
            continue
        if known.get("deprecated"):
            del part[key]
            yield f"config key '{prefix}{key}' {known['description']}"
        elif isinstance(part[key], dict):
            yield from _updated(part[key], known, f"{prefix}{key}.")


def require_schema(
    data: Mapping[str, Any], schema_path: str | Path, source: str = "config"
) -> None:
    """Validate what a YAML file, called ``source`` in messages, holds against a schema.

    Raises
    ------
    ConfigurationError
        For the most relevant violation, or a value that is not finite.
    """
    for count, (key, problem) in enumerate(_walk(data, "", 0)):
        if count == _MOST_VALUES:
            problem = f"is the last of more than {_MOST_VALUES} values: shorten the lists"
        if problem:
            raise ConfigurationError(strict_yaml.one_line(f"{source} key '{key}' {problem}"))
    error = best_match(_validator(schema_path).iter_errors(data))
    if error is not None:
        raise ConfigurationError(strict_yaml.one_line(f"{source} {_explain(error, schema_path)}"))


def _walk(value: Any, key: str, depth: int) -> Iterator[tuple[str, str]]:
    """Yield every key, with what is wrong with its value whatever the schema, or nothing."""
    if depth > strict_yaml.DEEPEST:
        yield key, f"is nested deeper than {strict_yaml.DEEPEST} levels"
    elif isinstance(value, Mapping):
        yield key, ""
        for name, item in value.items():
            if isinstance(name, str):
                yield from _walk(item, f"{key}.{name}" if key else name, depth + 1)
            else:
                yield key or "top level", f"has a key that is not a word: {name!r:.40}"
    elif isinstance(value, list):
        yield key, ""
        for index, item in enumerate(value):
            yield from _walk(item, f"{key}[{index}]", depth + 1)
    elif isinstance(value, float) and not math.isfinite(value):
        yield key, f"is {value}: give a finite number"
    elif isinstance(value, int) and value.bit_length() > _MOST_BITS:
        yield key, f"is a number of {value.bit_length()} bits: give a smaller one"
    elif value is None or isinstance(value, str | int | float):
        yield key, ""
    else:
        yield key, f"is a {type(value).__name__}: give a number, a text, a list or a mapping"


@cache
def _schema(schema_path: str | Path) -> dict[str, Any]:
    return strict_yaml.read_own(schema_path)


@cache
def _validator(schema_path: str | Path) -> jsonschema.protocols.Validator:
    base = jsonschema.Draft202012Validator
    # To JSON 400.0 is an integer; to Python it is none, and it makes another file name.
    integers = base.TYPE_CHECKER.redefine(
        "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
    )
    extended = jsonschema.validators.extend(base, type_checker=integers)  # type: ignore[no-untyped-call]
    validator: jsonschema.protocols.Validator = extended(_schema(schema_path))
    return validator


def _explain(error: ValidationError, schema_path: str | Path) -> str:
    key = error.json_path.removeprefix("$").removeprefix(".") or "top level"
    meaning = error.schema.get("description", "") if isinstance(error.schema, Mapping) else ""
    message = error.message if len(error.message) < 200 else error.message[:200] + " ..."
    hint = f" ({meaning})" if meaning else ""
    return f"key '{key}': {message}{hint}; see {Path(schema_path).name}"
