"""What the parser cannot find: options that do not go together, files, missing libraries."""

from argparse import Namespace
from importlib.util import find_spec
from pathlib import Path

from hopper_cli import chart_options, design_options, march_options, ranges, sheet_options
from hopper_cli.errors import UsageError
from hopper_cli.outputs import require_writable

# The extra of the distribution and its libraries that a file of this suffix needs.
_LIBRARIES = {
    ".csv": ("", list[str]()),
    ".xlsx": ("data", ["openpyxl"]),
    ".json": ("", list[str]()),
    ".nc": ("data", ["xarray", "netCDF4"]),
}


def check(options: Namespace) -> None:
    """Find what the parser cannot: options that do not go together, files, missing libraries.

    Raises
    ------
    UsageError
        If an option is wrong.
    """
    if options.command == "table":
        sheet_options.check(options)
        _require_libraries("--out", options.out.suffix.lower())
        return
    if options.command == "chart":
        chart_options.check(options)
        _require_libraries("--out", options.out.suffix.lower())
        return
    if options.explain and options.json:
        raise UsageError("argument --explain: explains text: leave out --json")
    if getattr(options, "disturbances", None) == "any" and options.geometry == "cone":
        raise UsageError(
            "argument --disturbances: asymmetric disturbances are singular at the apex of a cone: "
            "use symmetric or --geometry wedge"
        )
    if options.model == "von-mises" and options.geometry == "wedge":
        raise UsageError(
            "argument --model: von-mises is formulated for cones only: use --geometry cone or "
            "--model mohr-coulomb"
        )
    if options.command == "march":
        march_options.check(options)
        if Path(options.top).suffix.lower() == ".nc":
            _require_libraries("--top", ".nc")
    if options.command == "design":
        design_options.check(options)
    if options.command in ("radial", "stability", "design"):
        ranges.check(options)
        if options.out is not None:
            sheet_options.check(options)
            _require_libraries("--out", options.out.suffix.lower())
    if options.command in ("neutral", "design"):
        return
    _check_files(options)


def _check_files(options: Namespace) -> None:
    for option, path, suffixes in (
        ("--profile", options.profile, (".csv", ".nc")),
        ("--plot", options.plot, (".png", ".pdf", ".svg")),
    ):
        if path is None:
            continue
        require_writable(option, path, suffixes, overwrite=options.force)
        _require_libraries(option, path.suffix.lower())


def _require_libraries(option: str, suffix: str) -> None:
    extra, libraries = _LIBRARIES.get(suffix, ("plot", ["matplotlib"]))
    for library in libraries:
        if find_spec(library) is None:
            raise UsageError(
                f"argument {option}: {suffix} needs {library}: install granular-hopper[{extra}]"
            )
