"""The command's plots."""

import os
from pathlib import Path

os.environ["MPLBACKEND"] = "Agg"  # with one that it does not know Matplotlib does not load

import numpy as np
from matplotlib import style
from matplotlib.figure import Figure

from hopper.assessment.coupled import CoupledStability
from hopper.assessment.march import MarchAssessment
from hopper.assessment.radial import RadialAssessment
from hopper.assessment.stability import StabilityAssessment
from hopper_cli import drawing
from hopper_data import assessments
from hopper_data.assessments import Part
from hopper_data.files import replacing
from hopper_data.inputs import Case

# Nothing that varies between runs.
METADATA: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    ".svg": {"Date": None, "Creator": None},
}


def write(path: Path, case: Case, found: Part) -> None:
    """Plot the fields, the spectrum, or the march, in the style of the paper, with the verdict."""
    with style.context(["default", drawing.STYLE]):
        if isinstance(found, RadialAssessment):
            figure, verdict = _fields(case, found), "radial solution"
            if found.velocity is None:
                verdict += r", velocity not known: $\psi$ reaches or nearly reaches $\pi/4$"
        elif isinstance(found, MarchAssessment):
            figure, verdict = _march(case, found), _VERDICTS[found.kind]
        else:
            figure, verdict = Figure(figsize=(7.1, 4.0)), found.verdict.replace("_", " ")
            _spectrum(figure, found)
        words = drawing.title(
            verdict,
            geometry=case.geometry,
            model=case.model,
            delta_deg=case.delta_deg,
            half_angle_deg=case.half_angle_deg,
            mu=case.wall.mu,
        )
        figure.suptitle(words, fontsize=8)
        with replacing(path) as temporary:
            figure.savefig(temporary, metadata=METADATA[path.suffix.lower()])


def _spectrum(figure: Figure, found: StabilityAssessment | CoupledStability) -> None:
    axis = figure.subplots()
    if isinstance(found, CoupledStability):
        if found.modes is not None:
            drawing.draw_coupled_spectrum(axis, found.modes.eigenvalues, found.strips)
    else:
        drawing.draw_spectrum(axis, found.spectrum.eigenvalues, found.result.line.abscissa)


def _fields(case: Case, found: RadialAssessment) -> Figure:
    known = assessments.profiles(found)
    fields = {
        variable.name: variable.of(known)
        for variable in assessments.PROFILES
        if known[variable.name] is not None
    }
    figure = Figure(figsize=(7.1, 2.6))
    drawing.draw_fields(figure.subplots(1, 3 if "u" in fields else 2), case.delta_deg, fields)
    return figure


_VERDICTS = {
    "crossing": "characteristics cross (x)",
    "tangency": "a characteristic is tangent to the top's surfaces (x)",
    "kink": "a kink breaks",
    None: "no breakdown",
}


def _march(case: Case, found: MarchAssessment) -> Figure:
    figure = Figure(figsize=(7.1, 3.4))
    axes = figure.subplots(1, 2, sharey=True)
    march = found.profiles()
    march["theta"] = np.degrees(march["theta"])
    end = (np.nan, np.nan)
    if found.result.breakdown is not None:
        breakdown = found.result.breakdown
        end = breakdown.position * case.half_angle_deg, breakdown.tau
    drawn = drawing.draw_depth_plane(axes[0], march, end)
    drawing.draw_distance(axes[1], march)
    figure.colorbar(drawn, ax=axes[0], label=r"$\psi$ (degrees)")
    return figure
