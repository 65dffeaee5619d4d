"""What the scripts and rules of the workflow share; no mathematics.

Artifacts with provenance, logs, the configuration, plots, the claims ledger, report and crate.
Import this package first: it loads the packages of ``src`` beside it, so that a clone runs its own
code whatever is installed, and a host workflow keeps its ``sys.path``.
"""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

_SOURCES = Path(__file__).parents[2] / "src"


def _load(package: str) -> None:
    file = _SOURCES / package / "__init__.py"
    spec = spec_from_file_location(package, file, submodule_search_locations=[str(file.parent)])
    if spec is None or spec.loader is None:
        raise ImportError(f"{file} cannot be loaded")
    sys.modules[package] = module = module_from_spec(spec)
    spec.loader.exec_module(module)


for _package in ("hopper", "hopper_data", "hopper_cli"):
    if _package not in sys.modules:
        _load(_package)

import hopper  # noqa: E402
import hopper_cli  # noqa: E402
import hopper_data  # noqa: E402

__all__ = ["hopper", "hopper_cli", "hopper_data"]
