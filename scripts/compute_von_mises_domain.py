"""Types, neutral curve and decay rates of von Mises cones over internal and wall friction."""

import logging
from math import radians

import numpy as np

from hopper_workflow import artifacts, jobs, ranges
from hopper.domain.coupled import coupled_borders, decay_rates, stable_edge
from hopper.problem import Hopper
from hopper.von_mises.characteristics import AXIS_HYPERBOLIC, TENSION
from hopper.von_mises.neutral_curve import neutral_curve
from hopper.yield_conditions import VON_MISES
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.domain import COUPLED_BORDERS, COUPLED_NEUTRAL
from hopper_data.tables import angle, number, within


def compute_von_mises_domain(
    *,
    half_angle_deg: float,
    least_delta_deg: float,
    border_points: int,
    neutral_step_deg: float,
    edge_points: int,
    decay: dict[str, int],
) -> CfDataset:
    """Trace borders as roots; rates on a grid that follows the border of elliptic flows."""
    half_angle, least = radians(half_angle_deg), radians(least_delta_deg)
    below = least + ranges.closing_in(AXIS_HYPERBOLIC - least, border_points)
    above = AXIS_HYPERBOLIC + ranges.closing_in(TENSION - AXIS_HYPERBOLIC, border_points)
    borders = coupled_borders(half_angle, np.concatenate([below, above]))
    neutral = neutral_curve(half_angle, radians(neutral_step_deg))
    logging.info("half angle %g deg: %s", half_angle_deg, neutral)
    result = {
        "borders": borders,
        "neutral": neutral,
        "edge": _edge(half_angle, neutral.delta[-1], neutral.friction_angle[-1], edge_points),
        "decay": _decay(half_angle, below, borders.sonic[: below.size], **decay),
        "axis_hyperbolic": AXIS_HYPERBOLIC,
        "tension": TENSION,
    }
    return dataset(result, TABLE, AXES)


def _edge(half_angle: float, delta: float, phi: float, points: int) -> dict[str, np.ndarray]:
    """Follow the largest resolved friction of stable cones from the neutral curve's end on.

    There is nothing to follow where the curve ends next to tension.
    """
    inside = TENSION - radians(1)
    if delta >= TENSION - radians(_NEXT_TO_TENSION):
        return dict.fromkeys(("delta", "phi"), np.full(points, np.nan))
    # Denser at both ends, where the edge bends.
    along = (1 - np.cos(np.pi * np.arange(1, points + 1) / points)) / 2
    deltas = delta + (inside - delta) * along
    return {"delta": deltas, "phi": stable_edge(half_angle, deltas, phi)}


def _decay(
    half_angle: float, deltas: np.ndarray, sonic: np.ndarray, *, rows: int, frictions: int
) -> dict[str, np.ndarray]:
    kept = np.linspace(0, deltas.size - 1, rows).astype(int)[:-1]
    kept = kept[np.isfinite(sonic[kept])]
    phi = sonic[kept, None] * ranges.closing_in(_UP_TO, frictions)
    rates = [
        decay_rates(Hopper("cone", float(delta), half_angle, VON_MISES), row)
        for delta, row in zip(deltas[kept], phi, strict=True)
    ]
    down, up = np.array(rates).transpose(1, 0, 2)
    return {"delta": deltas[kept], "phi": phi, "down": down, "up": up}


# Degrees.
_NEXT_TO_TENSION = 3
# Part of the border up to which decay is resolved: beyond, modes as high as meshes go decay least.
_UP_TO = 0.975
_GRID = "decay_row friction"
TABLE = (
    *within("borders", COUPLED_BORDERS),
    *within("neutral", COUPLED_NEUTRAL),
    angle("edge_delta", "internal friction beyond the neutral curve's end", "edge", "edge.delta"),
    angle("edge_phi", "wall friction up to which it is stable, not resolved beyond", "edge",
          "edge.phi"),
    angle("decay_delta", "internal friction of elliptic flows", "decay_row", "decay.delta"),
    angle("decay_phi", "wall friction of elliptic flows", _GRID, "decay.phi"),
    number("decay_down", "least exponent of r, disturbances of the top", _GRID, "decay.down"),
    number("decay_up", "least exponent of 1/r, disturbances of the outlet", _GRID, "decay.up"),
    angle("axis_hyperbolic", "internal friction from which the axis is hyperbolic"),
    angle("tension", "internal friction from which the axis is in tension"),
)  # fmt: skip
AXES = (angle("delta", "angle of internal friction", "delta", "borders.delta"),)

if __name__ == "__main__":
    jobs.run(
        artifacts.writing(
            compute_von_mises_domain,
            "Types and neutral curve, von Mises cone",
            "(2.8)-(2.15), linearised",
        )
    )
