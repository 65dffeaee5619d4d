"""Reference pages: configuration from schema, command from parsers, glossary from its file."""

import argparse
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from hopper_workflow import strict_yaml
from hopper_cli import main
from hopper_data import glossary
from hopper_workflow.site.source import Source

_RANGE = {
    "minimum": "≥ {}",
    "exclusiveMinimum": "> {}",
    "maximum": "≤ {}",
    "exclusiveMaximum": "< {}",
    "multipleOf": "a multiple of {}",
    "minItems": "at least {} values",
    "maxItems": "at most {} values",
}
_KINDS = {"array": "list", "object": "keys below", "boolean": "true or false"}


def write(source: Source, root: Path) -> None:
    """Write the three pages."""
    schema = strict_yaml.read_own(root / "workflow/schemas/config.schema.yaml")
    source.write("configuration.md", configuration(schema))
    source.write("command.md", command(main.build_parser()))
    source.write("glossary.md", words(glossary.definitions()))


def configuration(schema: Mapping[str, Any]) -> str:
    """Return the keys of the configuration, from its schema."""
    lines = [
        "# Keys of the configuration",
        "",
        "Every key of `config.yaml`, from `workflow/schemas/config.schema.yaml`, which a run is "
        "checked against before any job starts. `NAME` stands for a name of your own, `[]` for "
        "each item of a list.",
    ]
    for section, entry in schema["properties"].items():
        whole = _resolved(schema, entry)
        lines += ["", f"## {section}", "", _sentence(whole["description"]), ""]
        rows = list(_keys(schema, whole, ""))
        if rows:
            lines += ["| Key | Meaning | Values | Default |", "|---|---|---|---|", *rows]
    return "\n".join(lines) + "\n"


def _resolved(schema: Mapping[str, Any], entry: Mapping[str, Any]) -> dict[str, Any]:
    """Return an entry with what it refers to; its own words come first."""
    if "$ref" not in entry:
        return dict(entry)
    name = entry["$ref"].removeprefix("#/$defs/")
    base = _resolved(schema, schema["$defs"][name])
    own = {key: value for key, value in entry.items() if key not in ("$ref", "properties")}
    properties = {
        key: {**base.get("properties", {}).get(key, {}), **value}
        for key, value in entry.get("properties", {}).items()
    }
    joined = {**base, **own}
    if properties:
        joined["properties"] = {**base.get("properties", {}), **properties}
    return joined


def _keys(schema: Mapping[str, Any], entry: Mapping[str, Any], path: str) -> Iterator[str]:
    """Yield a row for each key below an entry."""
    children = dict(entry.get("properties", {}))
    if isinstance(entry.get("additionalProperties"), dict):
        children["NAME"] = entry["additionalProperties"]
    for name, child in children.items():
        whole = _resolved(schema, child)
        if whole.get("deprecated"):
            continue
        own = f"{path}.{name}" if path else name
        if whole.get("type") == "array":
            own += "[]" if "properties" in _resolved(schema, whole.get("items", {})) else ""
        default = f"`{json.dumps(whole['default'])}`" if "default" in whole else ""
        if len(default) > 60:
            default = "as in `config.yaml`"
        text = _sentence(whole.get("description", ""))
        yield f"| `{own}` | {text} | {_values(schema, whole)} | {default} |"
        yield from _keys(schema, whole, own)
        if own.endswith("[]"):
            yield from _keys(schema, _resolved(schema, whole["items"]), own)


def _values(schema: Mapping[str, Any], entry: Mapping[str, Any]) -> str:
    """Return in words which values an entry may have."""
    if "const" in entry or "enum" in entry:
        return ", ".join(f"`{value}`" for value in entry.get("enum", [entry.get("const")]))
    kind = entry.get("type", "")
    kinds = [kind] if isinstance(kind, str) else kind
    words = [" or ".join(_KINDS.get(one, one) for one in kinds)]
    words += [text.format(_number(entry[key])) for key, text in _RANGE.items() if key in entry]
    if kind == "array" and "items" in entry:
        items = _resolved(schema, entry["items"])
        if "properties" not in items and (each := _values(schema, items)):
            words.append(f"each {each}")
    choices = [_values(schema, _resolved(schema, one)) for one in entry.get("oneOf", ())]
    return ", ".join([*filter(None, words), *dict.fromkeys(filter(None, choices))])


def _number(value: float) -> str:
    return f"{value:g}"


def _sentence(text: str) -> str:
    return " ".join(text.split()).replace("|", r"\|")


def command(parser: argparse.ArgumentParser) -> str:
    """Return the help of the command and of each of its parts."""
    lines = ["# The command `hopper`", "", parser.description or "", ""]
    (parts,) = (one for one in parser._actions if isinstance(one, argparse._SubParsersAction))
    for name, part in parts.choices.items():
        example = (part.epilog or "").removeprefix("example:\n").partition("\n\n")[0].strip()
        lines += [f"## hopper {name}", "", part.description or "", ""]
        lines += ["```console", f"$ {example}", "```", ""]
        lines += ["| Option | Meaning |", "|---|---|"]
        lines += [_option(part, action) for action in part._actions if action.dest != "help"]
        lines.append("")
    lines += ["## Exit codes", "", "```text", (parser.epilog or "").partition("\n")[2], "```"]
    return "\n".join(lines) + "\n"


def _option(parser: argparse.ArgumentParser, action: argparse.Action) -> str:
    """Return a row for an option, with the values it takes."""
    formatter = parser._get_formatter()
    name = ", ".join(action.option_strings) or str(action.dest).upper()
    if action.option_strings and action.nargs != 0:
        value = formatter._metavar_formatter(action, action.dest.upper())(1)[0]
        name += f" {value}"
    text = formatter._expand_help(action) if action.help else ""
    if action.required and action.option_strings:
        text = f"{text} (required)".strip()
    name = name.replace("|", r"\|")
    return f"| `{name}` | {_sentence(text)} |"


def words(terms: Mapping[str, str]) -> str:
    """Return the glossary; its terms are those that ``hopper --explain`` explains."""
    lines = ["# Glossary", "", "What `hopper ... --explain` says of the terms of its answers.", ""]
    for term, text in sorted(terms.items(), key=lambda item: item[0].lower()):
        lines += [f"{term}", f": {text}", ""]
    return "\n".join(lines)
