"""Which modules of this project a script depends on, from the real import graph."""

import ast
from functools import lru_cache
from pathlib import Path

import grimp

PACKAGES = {
    "hopper": "src",
    "hopper_data": "src",
    "hopper_cli": "src",
    "hopper_workflow": "scripts",
}


@lru_cache(maxsize=1)
def _graph() -> grimp.ImportGraph:
    # A cache on disk would be one more file that can be stale.
    return grimp.build_graph(*PACKAGES, cache_dir=None, exclude_type_checking_imports=True)


@lru_cache(maxsize=256)
def modules_used_by(root: Path, script: str) -> list[str]:
    """Return ``script`` and the files it imports from this project, directly or not, sorted.

    ``root`` is the repository, ``script`` a path below it. Importing a module also runs the
    ``__init__`` of its packages; the plot style goes with the module that loads it.
    """
    graph = _graph()
    modules: set[str] = set()
    ahead = _imported(root / script) & graph.modules
    while ahead:
        module = ahead.pop()
        modules.add(module)
        package = {module.rpartition(".")[0]} - {""}
        ahead |= (graph.find_modules_directly_imported_by(module) | package) - modules
    files = {root / script} | {_file(root, module) for module in modules}
    if "hopper_workflow.plotting" in modules:
        files.add(root / "src/hopper_cli/paper.mplstyle")
    return sorted(relative(file) for file in files)


def relative(file: Path) -> str:
    """Return a path as rules should name it: relative where the workflow runs in its own clone.

    So a clone may move without its results becoming outdated. Elsewhere, as in a module of another
    workflow, it is absolute: a prefix for the results must not apply to it.
    """
    root = Path(__file__).parents[2]
    return str(file.relative_to(root) if root.samefile(Path.cwd()) else file)


def _imported(script: Path) -> set[str]:
    """Return every dotted name a script may import; names that are not modules do no harm."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def _file(root: Path, module: str) -> Path:
    package, *rest = module.split(".")
    path = root.joinpath(PACKAGES[package], package, *rest)
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
