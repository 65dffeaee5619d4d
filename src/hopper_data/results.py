"""Any result of the numerics as a dataset."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from hopper.assessment.coupled import CoupledStability
from hopper.assessment.march import MarchAssessment
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper.assessment.summary import Assessment
from hopper.domain.borders import Borders
from hopper.domain.neutral_curve import NeutralCurve
from hopper.domain.stability_map import Sweep
from hopper.radial.solution import RadialSolution
from hopper.radial.velocity import VelocityField
from hopper.spectral.pseudospectrum import Pseudospectrum
from hopper.stability.convergence_filter import FilteredSpectrum
from hopper.stability.mesh_spectrum import MeshSpectrum
from hopper.stability.modes import LinearStability
from hopper_data import assessments, cf, domain, radial, stability
from hopper_data.contents import CfDataset
from hopper_data.datasets import dataset
from hopper_data.decoding import decoded
from hopper_data.inputs import Case
from hopper_data.reading import as_xarray
from hopper_data.tables import Table

TABLES: dict[type, tuple[Table, Table]] = {
    LinearStability: (stability.STABILITY, ()),
    MeshSpectrum: (stability.MESH_SPECTRUM, ()),
    FilteredSpectrum: (stability.FILTERED_SPECTRUM, ()),
    Pseudospectrum: (stability.PSEUDOSPECTRUM, stability.PLANE),
    Sweep: (domain.SWEEP, domain.FRICTION),
    NeutralCurve: (domain.NEUTRAL_CURVE, ()),
    Borders: (domain.BORDERS, domain.DELTA),
}


def to_dataset(result: Any) -> xr.Dataset:
    """Return a result as a dataset: a variable for each number or array, with units and meaning.

    Parameters
    ----------
    result : object
        A radial solution, velocity field or assessment, low modes, the spectrum of a mesh or a
        filtered one, a pseudospectrum, a sweep of wall friction, a neutral curve or borders. Fields
        are over [-theta_w, theta_w].

    Returns
    -------
    xarray.Dataset
        Flags are named, complex numbers in one piece, angles in degrees unless their units say
        radians. What does not exist is left out.

    Raises
    ------
    TypeError
        If it is none of these.

    Examples
    --------
    >>> from hopper import Hopper, solve_radial
    >>> from hopper_data import to_dataset
    >>> solution = solve_radial(Hopper("cone", delta=0.7, half_angle=0.35), friction_angle=0.3)
    >>> round(float(to_dataset(solution).sigma.min()), 4)
    0.1185
    """
    return decoded(as_xarray(stored_form(result)))


def stored_form(result: Any) -> CfDataset:
    """Return the same as CF files hold it: flags as codes, complex numbers in two parts."""
    if isinstance(result, Assessment | assessments.Part):
        attributes = assessments.comment(result) if isinstance(result, Assessment) else None
        return dataset(*assessments.described(result), attributes=attributes)
    if isinstance(result, RadialSolution | VelocityField):
        return dataset(*radial.over_theta(result), radial.THETA)
    if type(result) not in TABLES:
        known = ", ".join(sorted(kind.__name__ for kind in TABLES))
        raise TypeError(
            f"{type(result).__name__} is not a result with a dataset: use a RadialSolution, "
            f"VelocityField, an assessment, {known}"
        )
    table, coordinates = TABLES[type(result)]
    return dataset(result, table, coordinates)


def write_part(
    path: Path, case: Case, found: assessments.Part, more: Mapping[str, Any] | None = None
) -> None:
    """Write one part of an assessment as netCDF; ``more`` are parameters beside those of the case.

    Raises
    ------
    OSError
        If the file cannot be written; no part of it stays.
    """
    title, equations = _TITLES[type(found)]
    cf.write(
        stored_form(found),
        path,
        title=f"{title}: {case}",
        equations=equations,
        parameters=case.echoed() | dict(more or {}),
    )


_TITLES = {
    RadialAssessment: ("Radial solution", "(2.8)-(2.15), (3.1)-(3.5)"),
    StabilityAssessment: ("Linear stability", "(4.1), (4.2)"),
    CoupledStability: ("Linear stability", "(2.8)-(2.15), linearised"),
    MarchAssessment: ("Stress march", "(2.8)-(2.11), (3.1)"),
}
