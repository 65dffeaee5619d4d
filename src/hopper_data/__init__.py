"""Results as xarray datasets and CF files, for notebooks, scripts and the command alike.

``to_dataset`` describes any result of the numerics; ``open_artifact`` reads what the workflow
wrote. Both name flags by their meanings: ``open_artifact(path).sel(kept_in="physical")``.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hopper_data.cf import open_artifact as open_artifact
    from hopper_data.results import to_dataset as to_dataset

_HOMES = {"open_artifact": "hopper_data.cf", "to_dataset": "hopper_data.results"}


def __getattr__(name: str) -> Any:
    """Import a name when it is first asked for: the command needs neither xarray nor netCDF4."""
    if name not in _HOMES:
        raise AttributeError(f"module 'hopper_data' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
