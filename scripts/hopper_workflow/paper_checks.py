"""Points of a curve computed again by the paper's own algorithm, and how far it is from ours."""

import logging
from collections.abc import Sequence

import numpy as np

from hopper.errors import ConvergenceError
from hopper.problem import Hopper
from hopper.radial.solution import solve_radial
from hopper.stability.modes import linear_stability
from hopper.stability.paper_abscissa import paper_abscissa
from hopper_data.tables import Table, flag, number

_REASONS = ("kept", "nothing_converged_between_the_meshes", "radial_solution_not_resolved")
_KEPT, _NOTHING_KEPT, _NO_SOLUTION = range(3)


def compared(
    points: Sequence[tuple[Hopper, float]],
    shape: tuple[int, ...] = (-1,),
    *,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
) -> dict[str, np.ndarray]:
    """Return the abscissae at hoppers and wall frictions, ours and the paper's, and differences.

    By the names of :func:`table`, each of the given ``shape``.
    """
    rows = [_row(*point, (nodes, coarse_nodes, tolerance)) for point in points]
    columns = zip(*rows, strict=True)
    names = ("abscissa", "symmetric", "as_worded", "physical", "reason")
    values = {
        f"check_{name}": np.reshape(np.array(column), shape)
        for name, column in zip(names, columns, strict=True)
    }
    differences = {
        f"check_difference_{name}": values[f"check_{name}"] - values[f"check_{counterpart}"]
        for name, counterpart in (("as_worded", "abscissa"), ("physical", "symmetric"))
    }
    return values | differences


def _row(
    hopper: Hopper, friction_angle: float, meshes: tuple[int, int, float]
) -> tuple[float, float, float, float, int]:
    try:
        solution = solve_radial(hopper, friction_angle)
        ours = linear_stability(solution)
    except ConvergenceError as error:
        logging.info("%s: %s", hopper, error)
        return np.nan, np.nan, np.nan, np.nan, _NO_SOLUTION
    numbers = ours.abscissa, ours.symmetric[0]
    try:
        paper = paper_abscissa(solution, *meshes)
    except ConvergenceError as error:
        logging.info("%s, phi = %.4f rad: %s", hopper, friction_angle, error)
        return *numbers, np.nan, np.nan, _NOTHING_KEPT
    return *numbers, paper.as_worded, paper.physical, _KEPT


def table(over: str) -> Table:
    """Return the table of what :func:`compared` returns, over the given dimensions."""
    algorithm = "abscissa by the paper's algorithm, {}, NaN if nothing converged"
    meanings = {
        "abscissa": "abscissa from low modes and line at the checked point",
        "symmetric": "the same for symmetric disturbances",
        "as_worded": algorithm.format("both parities"),
        "physical": algorithm.format("the flow's parity"),
        "difference_as_worded": "check_as_worded - check_abscissa",
        "difference_physical": "check_physical - check_symmetric",
    }
    return (
        *(number(f"check_{name}", text, over) for name, text in meanings.items()),
        flag("check_reason", "what the paper's algorithm found", _REASONS, over),
    )
