"""How far long work is, on a terminal."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic

# Seconds before the first word, and between two.
_PATIENCE, _BETWEEN = 2.0, 0.5
_CLEAR = "\r\x1b[K"


@contextmanager
def on_terminal() -> Iterator[Callable[[str, float], None] | None]:
    """Yield a function that is told what is being marched and its tau; None without a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    due = monotonic() + _PATIENCE

    def tell(what: str, tau: float) -> None:
        nonlocal due
        if monotonic() >= due:
            due = monotonic() + _BETWEEN
            print(f"{_CLEAR}hopper: {what}, tau = {tau:.3f}", end="", file=sys.stderr, flush=True)

    try:
        yield tell
    finally:
        print(_CLEAR, end="", file=sys.stderr, flush=True)
