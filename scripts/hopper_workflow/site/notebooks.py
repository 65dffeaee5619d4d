"""Notebooks: Python files in cells of text and code, run from top to bottom and set as pages.

The percent format, which Jupyter (by Jupytext), VS Code and Spyder open: ``# %% [markdown]`` begins
a cell of text, ``# %%`` one of code. A page shows what each cell printed, and the figures it left.
"""

import ast
import contextlib
import hashlib
import io
import re
import shutil
import traceback
from pathlib import Path
from typing import Any, NamedTuple

from hopper_workflow.site.source import SiteError, Source

_MARK = re.compile(r"^# %%(?P<kind>.*)$", re.MULTILINE)


class Cell(NamedTuple):
    """A cell: its text without comment marks, or its code; and its first line in the file."""

    is_text: bool
    content: str
    line: int


class Output(NamedTuple):
    """What a cell printed, and its figures as PNG."""

    printed: str
    figures: list[bytes]


def cells(text: str) -> list[Cell]:
    """Return the cells of a notebook."""
    found = []
    marks = list(_MARK.finditer(text))
    for mark, end in zip(marks, [*(m.start() for m in marks[1:]), len(text)], strict=True):
        content = text[mark.end() + 1 : end].strip("\n")
        is_text = mark["kind"].strip() == "[markdown]"
        if is_text:
            content = re.sub(r"^# ?", "", content, flags=re.MULTILINE)
        found.append(Cell(is_text, content, text.count("\n", 0, mark.end()) + 2))
    return found


def run(path: Path) -> list[tuple[Cell, Output]]:
    """Run a notebook and return its cells with what they gave.

    Raises
    ------
    SiteError
        If a cell fails; the message names its line and the last line of the traceback.
    """
    space: dict[str, Any] = {"__name__": "__main__", "__file__": str(path)}
    return [
        (cell, Output("", []) if cell.is_text else _run(path, cell, space))
        for cell in cells(path.read_text(encoding="utf-8"))
    ]


def _run(path: Path, cell: Cell, space: dict[str, Any]) -> Output:
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot

    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed):
            exec(compile("\n" * (cell.line - 1) + cell.content, str(path), "exec"), space)
    except Exception as error:
        last = traceback.format_exception_only(error)[-1].strip()
        raise SiteError(f"{path.name}, cell at line {cell.line}: {last}") from error
    figures = []
    for number in pyplot.get_fignums():
        png = io.BytesIO()
        pyplot.figure(number).savefig(png, dpi=150, metadata={"Software": None})
        figures.append(png.getvalue())
    pyplot.close("all")
    return Output(printed.getvalue(), figures)


def write(source: Source, root: Path, kept: Path) -> None:
    """Write a page for each notebook of docs/notebooks; run it only if it or its code changed."""
    code = b"".join(_code(path) for path in sorted((root / "src").rglob("*.py")))
    for path in sorted((root / "docs/notebooks").glob("*.py")):
        digest = hashlib.sha256(code + path.read_bytes()).hexdigest()
        folder = kept / path.stem
        stamp = folder / "stamp"
        if not stamp.exists() or stamp.read_text(encoding="utf-8") != digest:
            shutil.rmtree(folder, ignore_errors=True)
            _set(path, folder)
            stamp.write_text(digest, encoding="utf-8")
        for page in folder.iterdir():
            if page != stamp:
                source.copy(f"notebooks/{page.name}", page)
        source.copy(f"notebooks/{path.name}", path)


def _code(path: Path) -> bytes:
    """Return a module without its docstrings, on whose words no result depends."""
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    words: set[int] = set()
    ahead: list[ast.AST] = [ast.parse(text)]
    while ahead:
        node = ahead.pop()
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            ahead += node.body
            if ast.get_docstring(node, clean=False) is not None:
                words |= {*range(node.body[0].lineno - 1, node.body[0].end_lineno or 0)}
    return "\n".join(line for at, line in enumerate(lines) if at not in words).encode()


def _set(path: Path, folder: Path) -> None:
    """Run a notebook and write its page, and its figures, into a folder."""
    done = run(path)
    folder.mkdir(parents=True)
    lines = []
    for cell, output in done:
        if cell.is_text:
            lines += [cell.content, ""]
            continue
        lines += ["```python", cell.content, "```", ""]
        if output.printed:
            lines += ["```text", output.printed.rstrip("\n"), "```", ""]
        for png in output.figures:
            name = f"{path.stem}-{cell.line}-{len(list(folder.glob('*.png')))}.png"
            (folder / name).write_bytes(png)
            lines += [f"![Figure of the cell above]({name})", ""]
    lines += [f"The notebook as a file: {{download}}`{path.name}`", ""]
    (folder / f"{path.stem}.md").write_text("\n".join(lines), encoding="utf-8")
