"""Stress at the top of a march, by name."""

from collections.abc import Callable

from hopper.march import tops
from hopper.march.tops import Top

NAMED: dict[str, Callable[..., Top]] = {
    "bump-s": tops.bump_of_sigma,
    "bump-a": tops.bump_of_psi,
    "one-sided": tops.one_sided_bump,
    "scaled": tops.scaled,
    "linear": tops.linear_psi,
    "bin": tops.bin_like,
}


def named_top(name: str, eps: float | None = None, factor: float | None = None) -> Top:
    """Return a top by its name, with its amplitude or factor.

    Raises
    ------
    HopperError
        If the number is no number for it.
    """
    numbers = [number for number in (eps, factor) if number is not None]
    return NAMED[name](*numbers)
