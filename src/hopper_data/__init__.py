"""Results as xarray datasets and CF files, for notebooks, scripts and the command alike.

``to_dataset`` describes any result of the numerics; ``open_artifact`` reads what the workflow
wrote. Both name flags by their meanings: ``open_artifact(path).sel(kept_in="physical")``.
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from hopper_data.reading import open_artifact as open_artifact
    from hopper_data.results import to_dataset as to_dataset

_HOMES = {"open_artifact": "hopper_data.reading", "to_dataset": "hopper_data.results"}


if not TYPE_CHECKING:

    def __getattr__(name):
        """Import a name when it is first asked for: not every user of the package has xarray."""
        if name not in _HOMES:
            raise AttributeError(f"module 'hopper_data' has no attribute {name!r}", name=name)
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)

    def __dir__():
        return sorted({*globals(), *_HOMES} - {"TYPE_CHECKING"})
