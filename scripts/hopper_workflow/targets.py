"""What can be asked of the workflow: every file it makes, and the nearest to a misspelt one."""

import difflib
import re
from collections.abc import Iterable, Iterator
from itertools import product
from pathlib import Path

_WILDCARD = re.compile(r"\{(?P<name>\w+),(?P<words>[^{}]+)\}")
_FILE = re.compile(r"(\./)?(figures|results)/.+\.(png|pdf|nc|json|csv|md)")
_NOTHING = "(?!)"
_NEAREST, _LIKENESS = 4, 0.4


def words(values: Iterable[object]) -> str:
    """Return the regular expression of a wildcard that is one of the values and nothing else."""
    return "|".join(re.escape(str(value)) for value in values) or _NOTHING


def files(patterns: Iterable[str]) -> Iterator[str]:
    """Yield every file that outputs of rules stand for.

    Each wildcard in a pattern is held by :func:`words`: ``{geometry,wedge|cone}``.
    """
    for pattern in patterns:
        held = {found["name"]: found["words"].split("|") for found in _WILDCARD.finditer(pattern)}
        bare = _WILDCARD.sub(r"{\g<name>}", pattern)
        for values in product(*held.values()):
            if _NOTHING not in values:
                plain = (value.replace("\\", "") for value in values)
                yield bare.format(**dict(zip(held, plain, strict=True)))


def missing(arguments: Iterable[str], patterns: Iterable[str]) -> str | None:
    """Return, in one line, which file of a command line nothing makes, and what there is; or None.

    Snakemake learns its targets after it has read the rules: they are told by their looks.
    """
    asked = [str(Path(one)) for one in arguments if _FILE.fullmatch(one) and not Path(one).exists()]
    known = {*files(patterns)} if asked else set()
    for file in asked:
        if file not in known:
            alike = sorted(name for name in known if Path(name).suffix == Path(file).suffix)
            nearest = difflib.get_close_matches(file, alike, _NEAREST, _LIKENESS)
            return f"nothing makes {file}; there is {', '.join(nearest) or 'no such kind of file'}"
    return None
