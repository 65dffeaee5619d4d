"""Points of a curve computed again by the paper's own algorithm, and how far it is from ours."""

import logging
from collections.abc import Sequence

import numpy as np

from hopper.errors import ConvergenceError
from hopper.radial.solution import RadialSolution
from hopper.stability.modes import linear_stability
from hopper.stability.paper_abscissa import PaperAbscissa, paper_abscissa
from support.fields import Variable, number

_MEANING = {
    "abscissa": "abscissa from low modes and line at the checked point",
    "as_worded": "abscissa by the paper's algorithm, both parities, NaN if nothing converged",
    "physical": "abscissa by the paper's algorithm, the flow's parity, NaN if nothing converged",
}


def check_variables(
    over: tuple[str, ...] | str,
    solutions: Sequence[RadialSolution],
    shape: tuple[int, ...] = (-1,),
    *,
    nodes: int,
    coarse_nodes: int,
    tolerance: float,
) -> dict[str, Variable]:
    """Return the abscissae of radial solutions, ours and the paper's, and their differences.

    ``over`` names the dimensions of the variables and ``shape`` gives their sizes.
    """
    found = [_by_the_paper(one, nodes, coarse_nodes, tolerance) for one in solutions]
    columns = {
        "abscissa": [linear_stability(one).abscissa for one in solutions],
        "as_worded": [one.as_worded if one else np.nan for one in found],
        "physical": [one.physical if one else np.nan for one in found],
    }
    values = {name: np.reshape(column, shape) for name, column in columns.items()}
    variables = {f"check_{name}": number(over, values[name], _MEANING[name]) for name in values}
    for name in ("as_worded", "physical"):
        variables[f"check_difference_{name}"] = number(
            over, values[name] - values["abscissa"], f"check_{name} - check_abscissa"
        )
    return variables


def _by_the_paper(
    solution: RadialSolution, nodes: int, coarse_nodes: int, tolerance: float
) -> PaperAbscissa | None:
    try:
        return paper_abscissa(solution, nodes, coarse_nodes, tolerance)
    except ConvergenceError as error:
        logging.info("phi = %.4f rad: %s", solution.friction_angle, error)
        return None
