"""The works that docstrings name, with the modules that follow them."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from hopper_workflow.site.source import Source

_WORK = re.compile(r"^[.][.] \[\w+\] (?P<text>.+(?:\n   \S.*)*)", re.MULTILINE)


def cited(folder: Path) -> Iterator[tuple[str, str]]:
    """Yield each work and the module that cites it."""
    for path in sorted(folder.rglob("*.py")):
        text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
        module = ".".join(path.relative_to(folder.parent).with_suffix("").parts)
        for found in _WORK.finditer(text):
            yield " ".join(found["text"].split()), module


def write(source: Source, root: Path) -> None:
    """Write the page of references: those of docs/site/references.md, then those of docstrings."""
    page = (root / "docs/site/references.md").read_text(encoding="utf-8")
    works = [f"- {work} {{py:mod}}`{module}`" for work, module in cited(root / "src/hopper")]
    source.write("references.md", "\n".join([page, *sorted(works)]) + "\n")
