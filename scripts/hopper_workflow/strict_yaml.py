"""Read a YAML file that means what it looks like, or name the line that does not.

YAML reads 010 as 8, 1:30 as 90, no as false, and takes the last of two equal keys; Snakemake goes
further and runs a file as a program where it says ``__use_yte__``. None of this is let through, nor
what can make a small file a huge configuration. The workflow's own files need none of this.
"""

import re
from pathlib import Path
from typing import Any

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode

_MOST_CHARACTERS = 80_000  # holds the 200 hoppers of the schema; parsed in less than two seconds
DEEPEST = 20  # the schema has 6
_LONGEST_NUMBER = 40
_LONGEST_TEXT = 400
_PLAIN_NUMBER = re.compile(r"[-+]?(0|[1-9]\d*|(0|[1-9]\d*)?\.\d+|(0|[1-9]\d*)\.)(e[-+]?\d+)?", re.I)
_MERGE, _NULL, _STRING = (f"tag:yaml.org,2002:{name}" for name in ("merge", "null", "str"))
_NUMBERS = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float")


class StrictYamlError(Exception):
    """A file is not what it looks like; the one-line message names the line and the remedy."""


def read(path: str | Path) -> dict[str, Any]:
    """Load a file with one mapping.

    Raises
    ------
    StrictYamlError
        If the file cannot be read, is not valid YAML in UTF-8, or uses what is easily misread:
        repeated keys, aliases, tags, several documents, numbers that are not plain decimals.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
        text = data.decode("utf-8")
        if len(text) > _MOST_CHARACTERS:
            message = f"{path.name} has more than {_MOST_CHARACTERS} characters: shorten it"
            raise StrictYamlError(message)
        loader = _Loader(text)
        node = loader.get_single_node()
        if not isinstance(node, MappingNode):
            raise StrictYamlError(f"{path.name} has no keys at top level: start from config.yaml")
        content: dict[str, Any] = loader.construct_document(node)
    except OSError as error:
        raise StrictYamlError(f"{path.name} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise StrictYamlError(f"{path.name} line {line}: not UTF-8 text: save it as such") from None
    except yaml.reader.ReaderError as error:
        line = data.decode("utf-8").count("\n", 0, error.position) + 1
        raise StrictYamlError(
            f"{path.name} line {line}: the character {chr(error.character)!a} is not allowed"
        ) from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark else 1
        raise StrictYamlError(f"{path.name} line {line}: {one_line(str(error.problem))}") from None
    return content


def read_own(path: str | Path) -> dict[str, Any]:
    """Load a file of the workflow itself, five times as fast, with nothing refused."""
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    content: dict[str, Any] = yaml.load(Path(path).read_text(encoding="utf-8"), loader)
    return content


class _Loader(yaml.SafeLoader):
    """The safe loader, less what is easily misread."""

    depth = 0

    def compose_node(self, parent: Node | None, index: Any) -> Node | None:
        event = self.peek_event()  # type: ignore[no-untyped-call]
        if isinstance(event, yaml.AliasEvent) or event.anchor is not None:
            _refuse(event, f"&{event.anchor} and *{event.anchor}: write the values out")
        if event.tag is not None:
            _refuse(event, f"the tag {event.tag}: write the value without it")
        if self.depth == DEEPEST:
            _refuse(event, f"more than {DEEPEST} levels of nesting")
        self.depth += 1
        node = super().compose_node(parent, index)
        self.depth -= 1
        if isinstance(node, ScalarNode) and event.implicit[0]:
            _check_plain(node)
        if isinstance(node, MappingNode):
            _check_keys(node)
        return node


def _check_plain(node: ScalarNode) -> None:
    """Refuse an unquoted word or number that YAML reads as something else."""
    text = str(node.value)
    if node.tag in _NUMBERS and text.lstrip("+-.")[:1].isdigit():
        if not _PLAIN_NUMBER.fullmatch(text):
            value = yaml.safe_load(text) if len(text) < _LONGEST_NUMBER else "another number"
            _refuse(node, f"YAML reads {text} as {value}: write a plain decimal number")
        if len(text) > _LONGEST_NUMBER:
            _refuse(node, f"a number of {len(text)} characters: write a shorter one")
    elif node.tag == _STRING and "e" in text.lower() and _PLAIN_NUMBER.fullmatch(text):
        _refuse(node, f"YAML reads {text} as text: write a point and a signed power, as 1.0e-3")
    elif node.tag not in (*_NUMBERS, _STRING, _NULL, _MERGE):
        kind = node.tag.rpartition(":")[2]
        _refuse(node, f"YAML reads {text} as {_KINDS.get(kind, kind)}: quote it to mean text")


_KINDS = {"bool": "a truth value", "timestamp": "a date", "value": "a default key"}


def _check_keys(node: MappingNode) -> None:
    """Refuse keys that repeat, are not words, or have a meaning to YAML or Snakemake."""
    seen: set[str] = set()
    for key, _ in node.value:
        if not isinstance(key, ScalarNode) or key.tag not in (_STRING, _MERGE):
            _refuse(key, "a key that is not a word")
        if key.value in seen:
            _refuse(key, f"key '{key.value}' is here for the second time: keep one")
        if key.tag == _MERGE or key.value == "__use_yte__":
            _refuse(key, f"key '{key.value}' is not supported: write the values out")
        seen.add(key.value)


def one_line(text: str) -> str:
    """Return a text in printable ASCII, the rest escaped, the middle left out if it is long."""
    if len(text) > _LONGEST_TEXT:
        text = f"{text[: _LONGEST_TEXT - 100]} ... {text[-60:]}"
    return "".join(c if " " <= c <= "~" else ascii(c)[1:-1] for c in text)


def _refuse(where: Any, message: str) -> None:
    raise yaml.MarkedYAMLError(problem=message, problem_mark=where.start_mark)
