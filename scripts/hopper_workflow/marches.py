"""What artifacts of marches have in common: hoppers and tops of entries of config.yaml."""

from collections.abc import Mapping
from typing import Any

from hopper.march.base import Base, base_of
from hopper_data.inputs import solution_of


def base(hopper: Mapping[str, Any]) -> Base:
    """Return the radial field of a hopper, to be marched over."""
    return base_of(solution_of(**hopper))


def name_of_hopper(geometry: str, delta_deg: float, half_angle_deg: float, mu: float) -> str:
    """Return a hopper in a word: geometry, delta, half angle (degrees) and mu."""
    return f"{geometry} {delta_deg:g}/{half_angle_deg:g}/{mu:g}"


def name_of_top(name: str, eps: float | None = None, factor: float | None = None) -> str:
    """Return a top in a word."""
    if factor is not None:
        return f"load \u00d7 {factor:g}"
    return name if eps is None else f"{name} {eps:g}"
