"""Configurations in the words of older versions, put into today's."""

from typing import Any

_PSEUDOSPECTRUM = ("spectrum", "real", "imag", "modes", "formulations", "levels_log10")


def put_into_new_words(config: dict[str, Any]) -> None:
    """Change a configuration in place; what is wrong with it is left to the schema.

    ``pseudospectrum`` once was what its entry ``fig_pseudospectrum`` is now, and ``modes`` what
    ``formulations`` are. In a mixture, as a file of ``--configfile`` makes it, old words win.
    """
    section = config.get("pseudospectrum")
    if not isinstance(section, dict):
        return
    if moved := {key: section.pop(key) for key in _PSEUDOSPECTRUM if key in section}:
        _merge(section, {"fig_pseudospectrum": moved})
    for entry in section.values():
        if isinstance(entry, dict) and "modes" in entry:
            _merge(entry, {"formulations": entry.pop("modes")})


def _merge(target: dict[str, Any], changes: dict[str, Any]) -> None:
    for key, value in changes.items():
        if isinstance(value, dict) and isinstance(target.get(key), dict):
            _merge(target[key], value)
        else:
            target[key] = value
