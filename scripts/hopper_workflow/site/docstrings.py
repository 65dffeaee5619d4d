"""Docstrings as reStructuredText, in which bars, works and formulas would mean something else."""

import ast
import inspect
import re
import sys
import zlib
from dataclasses import is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

_CITATION = re.compile(r"[.][.] (\[\w+\])")
_REFERENCE = re.compile(r"(\[\w+\])_")
_CODE = re.compile(r"(``.*?``|:\w+:`[^`]*`)")
_SEVERAL = re.compile(r"^:(ivar|vartype) (\w+(?:, \w+)+):")
_NAME = re.compile(r"`([^`]+)`")


def mended(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with formulas kept as set, bars as bars, works as a list."""
    found: list[str] = []
    literal = example = False
    before = ""
    for line in lines:
        indented = line.startswith("    ")
        example = bool(line) and (example or line.lstrip().startswith(">>> "))
        if line and not indented:
            literal = False
        elif indented and not example and found and not found[-1] and not before.startswith(" "):
            literal = True
            found += ["::", ""]
        if line:
            before = line
        found.append(line if literal or example else _escaped(_CITATION.sub(r"*  **\1**", line)))
    return found


def _escaped(line: str) -> str:
    """Return a line with bars, names and citations as they are read in a terminal."""
    parts = _CODE.split(line)
    for index in range(0, len(parts), 2):
        text = _REFERENCE.sub(r"\1", parts[index]).replace("|", r"\|")
        parts[index] = _NAME.sub(r"``\1``", text)
    return "".join(parts)


def _process(app: Any, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    # Napoleon takes what precedes a colon in the first line of a property for its type: begin with
    # an empty comment.
    lines[:] = ["..", ""] * (what in ("attribute", "property")) + mended(lines)


def joined(line: str) -> str:
    """Return a field of several attributes with their names in one word, as Sphinx wants it."""
    return _SEVERAL.sub(lambda found: found[0].replace(", ", ",\u200b"), line)


def _join(app: Any, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    lines[:] = map(joined, lines)


def signature(value: Any) -> tuple[str, str | None] | None:
    """Return arguments and result in the words of the source, ``Radians`` and ``RealLike``.

    None if there is no source, as of what other classes hand down.
    """
    value = inspect.unwrap(value)
    node = _definitions(getattr(value, "__module__", "")).get(getattr(value, "__qualname__", ""))
    if isinstance(node, ast.ClassDef) and is_dataclass(value):
        fields = [ast.unparse(one) for one in node.body if isinstance(one, ast.AnnAssign)]
        return f"({', '.join(fields)})", None
    if not isinstance(node, ast.FunctionDef):
        return None
    words = re.sub(r"^(self|cls)(, /)?(, |$)", "", ast.unparse(node.args))
    return f"({words})", ast.unparse(node.returns) if node.returns else None


@lru_cache
def _definitions(module: str) -> dict[str, ast.stmt]:
    """Return the definitions of a module by their names; none of what is written in C."""
    file = getattr(sys.modules.get(module), "__file__", None) or ""
    if not file.endswith(".py"):
        return {}
    found: dict[str, ast.stmt] = {}
    ahead = [("", node) for node in ast.parse(Path(file).read_text(encoding="utf-8")).body]
    while ahead:
        path, node = ahead.pop()
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found[path + node.name] = node
            ahead += [(f"{path}{node.name}.", inner) for inner in node.body]
    return found


def _sign(app: Any, what: str, name: str, value: Any, options: Any, call: Any, gives: Any) -> Any:
    return signature(value) if what in ("function", "method", "class") else None


def own_files_alone(app: Any, env: Any) -> None:
    """Let a page of the API follow from its own package, not from all that it imports."""
    for page, files in env.dependencies.items():
        if page.startswith("api/"):
            folder = page.removeprefix("api/").replace(".", "/")
            files -= {file for file in files if not str(file.parent).endswith(f"src/{folder}")}


def setup(app: Any) -> dict[str, int]:
    """Register with Sphinx, before and behind what reads the sections of docstrings."""
    app.connect("autodoc-process-docstring", _process, priority=100)
    app.connect("autodoc-process-docstring", _join, priority=900)
    app.connect("autodoc-process-signature", _sign)
    app.connect("env-updated", own_files_alone)
    # All pages are made anew if this file changed.
    version = zlib.crc32(Path(__file__).read_bytes())
    return {"parallel_read_safe": True, "parallel_write_safe": True, "env_version": version}
