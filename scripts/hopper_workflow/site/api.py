"""The API: a page for each package of ``src/hopper``, from its docstrings."""

from pathlib import Path

from hopper_workflow.site.source import Source, heading

_OTHERS = ("hopper_data",)


def write(source: Source, root: Path) -> None:
    """Write a page for each package, and one for the modules that stand alone."""
    home = root / "src/hopper"
    packages = sorted(path.parent.name for path in home.glob("*/__init__.py"))
    alone = sorted(path.stem for path in home.glob("[a-z]*.py"))
    pages = ["hopper"]
    source.write("api/hopper.rst", _page("hopper", [f"hopper.{name}" for name in alone]))
    for package in packages:
        modules = sorted(path.stem for path in (home / package).glob("[a-z]*.py"))
        name = f"hopper.{package}"
        source.write(f"api/{name}.rst", _page(name, [f"{name}.{module}" for module in modules]))
        pages.append(name)
    for name in _OTHERS:
        modules = sorted(path.stem for path in (root / "src" / name).glob("[a-z]*.py"))
        source.write(f"api/{name}.rst", _page(name, [f"{name}.{module}" for module in modules]))
        pages.append(name)
    source.write("api/index.rst", _index(pages))


def _index(pages: list[str]) -> str:
    lines = [
        heading("API"),
        "Functions and results by package; ``hopper`` hands on the names that most users need. "
        "Angles are in radians, stresses in units of rho g r.\n",
        ".. toctree::\n   :maxdepth: 2\n",
        *(f"   {page}" for page in pages),
    ]
    return "\n".join(lines) + "\n"


def _page(package: str, modules: list[str]) -> str:
    lines = [heading(package), f".. automodule:: {package}\n"]
    for module in modules:
        lines += [heading(module, "-"), f".. automodule:: {module}\n   :members:\n"]
    return "\n".join(lines) + "\n"
