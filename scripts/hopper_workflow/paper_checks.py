"""Points of a curve computed again by the paper's own algorithm, and how far it is from ours."""

import logging
from collections.abc import Sequence

import numpy as np

from hopper.errors import ConvergenceError
from hopper.radial.solution import RadialSolution
from hopper.stability.modes import linear_stability
from hopper.stability.paper_abscissa import PaperAbscissa, paper_abscissa
from hopper_data.tables import Table, number


def compared(
    solutions: Sequence[RadialSolution],
    shape: tuple[int, ...] = (-1,),
    *,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
) -> dict[str, np.ndarray]:
    """Return the abscissae of radial solutions, ours and the paper's, and their differences.

    By the names of :func:`table`, each of the given ``shape``.
    """
    found = [_by_the_paper(one, nodes, coarse_nodes, tolerance) for one in solutions]
    ours = [linear_stability(one) for one in solutions]
    columns = {
        "abscissa": [one.abscissa for one in ours],
        "symmetric": [one.symmetric[0] for one in ours],
        "as_worded": [one.as_worded if one else np.nan for one in found],
        "physical": [one.physical if one else np.nan for one in found],
    }
    values = {f"check_{name}": np.reshape(column, shape) for name, column in columns.items()}
    differences = {
        f"check_difference_{name}": values[f"check_{name}"] - values[f"check_{counterpart}"]
        for name, counterpart in (("as_worded", "abscissa"), ("physical", "symmetric"))
    }
    return values | differences


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
    return tuple(number(f"check_{name}", text, over) for name, text in meanings.items())


def _by_the_paper(
    solution: RadialSolution, nodes: int, coarse_nodes: int, tolerance: float
) -> PaperAbscissa | None:
    try:
        return paper_abscissa(solution, nodes, coarse_nodes, tolerance)
    except ConvergenceError as error:
        logging.info("phi = %.4f rad: %s", solution.friction_angle, error)
        return None
