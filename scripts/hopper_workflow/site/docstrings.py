"""Docstrings as reStructuredText, in which bars, works and formulas would mean something else."""

import ast
import inspect
import re
import textwrap
from dataclasses import is_dataclass
from typing import Any

_CITATION = re.compile(r"[.][.] (\[\w+\])")
_REFERENCE = re.compile(r"(\[\w+\])_")
_CODE = re.compile(r"(``.*?``|:\w+:`[^`]*`)")
_NAME = re.compile(r"`([^`]+)`")


def mended(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with formulas kept as set, bars as bars, works as a list."""
    found: list[str] = []
    literal = False
    before = ""
    for line in lines:
        indented = line.startswith("    ")
        if line and not indented:
            literal = False
        elif indented and found and not found[-1] and not before.startswith(" "):
            literal = True
            found += ["::", ""]
        if line:
            before = line
        found.append(line if literal else _escaped(_CITATION.sub(r"*  **\1**", line)))
    return found


def _escaped(line: str) -> str:
    """Return a line with bars, names and citations as they are read in a terminal."""
    parts = _CODE.split(line)
    for index in range(0, len(parts), 2):
        text = _REFERENCE.sub(r"\1", parts[index]).replace("|", r"\|")
        parts[index] = _NAME.sub(r"``\1``", text)
    return "".join(parts)


def _process(app: Any, what: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    lines[:] = mended(lines)


def signature(value: Any) -> tuple[str, str | None] | None:
    """Return arguments and result in the words of the source, ``Radians`` and ``RealLike``.

    None if there is no source, as of what other classes hand down.
    """
    try:
        source = inspect.getsource(inspect.unwrap(value))
        node = ast.parse(textwrap.dedent(source)).body[0]
    except (OSError, TypeError):
        return None
    if isinstance(node, ast.ClassDef) and is_dataclass(value):
        fields = [ast.unparse(one) for one in node.body if isinstance(one, ast.AnnAssign)]
        return f"({', '.join(fields)})", None
    if not isinstance(node, ast.FunctionDef):
        return None
    every = node.args.posonlyargs + node.args.args
    if every and every[0].arg in ("self", "cls"):
        (node.args.posonlyargs or node.args.args).pop(0)
    return f"({ast.unparse(node.args)})", ast.unparse(node.returns) if node.returns else None


def _sign(app: Any, what: str, name: str, value: Any, options: Any, call: Any, gives: Any) -> Any:
    return signature(value) if what in ("function", "method", "class") else None


def setup(app: Any) -> dict[str, bool]:
    """Register with Sphinx, ahead of the extension that reads the sections of docstrings."""
    app.connect("autodoc-process-docstring", _process, priority=100)
    app.connect("autodoc-process-signature", _sign)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
