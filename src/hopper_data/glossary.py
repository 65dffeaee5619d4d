"""The glossary: terms of answers and their definitions, from one file."""

import re
import tomllib
from importlib.resources import files


def definitions() -> dict[str, str]:
    """Return the definition of each term."""
    return {term: entry["text"] for term, entry in _entries().items()}


def explained(answer: str) -> dict[str, str]:
    """Return the definitions of the terms that occur in an answer, in the order of the file."""
    return {
        term: entry["text"]
        for term, entry in _entries().items()
        if any(re.search(rf"(?<!\w){re.escape(word)}", answer) for word in entry["words"])
    }


def _entries() -> dict[str, dict[str, str]]:
    text = files("hopper_data").joinpath("glossary.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)
