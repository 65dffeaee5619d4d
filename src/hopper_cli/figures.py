"""The command's plots."""

import os
from pathlib import Path

os.environ["MPLBACKEND"] = "Agg"  # with one that it does not know Matplotlib does not load

from matplotlib import style
from matplotlib.figure import Figure

from hopper.assessment.radial import RadialAssessment
from hopper_cli import drawing
from hopper_data import assessments
from hopper_data.assessments import Part
from hopper_data.files import replacing
from hopper_data.inputs import Case

_STYLE = {
    "font.size": 8,
    "figure.titlesize": 8,
    "legend.frameon": False,
    "savefig.dpi": 200,
    "pdf.fonttype": 42,
    "svg.hashsalt": "hopper",
}
# Nothing that varies between runs.
_METADATA: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    ".svg": {"Date": None, "Creator": None},
}


def write(path: Path, case: Case, found: Part) -> None:
    """Plot the fields, or the spectrum."""
    with style.context(["default", _STYLE]):
        if isinstance(found, RadialAssessment):
            figure = Figure(figsize=(7.1, 2.6), layout="constrained")
            known = assessments.profiles(found)
            fields = {
                variable.name: variable.of(known)
                for variable in assessments.PROFILES
                if known[variable.name] is not None
            }
            drawing.draw_fields(figure.subplots(1, 3), case.delta_deg, fields)
        else:
            figure = Figure(figsize=(7.1, 4.0), layout="constrained")
            line = found.result.line.abscissa
            drawing.draw_spectrum(figure.subplots(), found.spectrum.eigenvalues, line)
        figure.suptitle(str(case))
        with replacing(path) as temporary:
            figure.savefig(temporary, metadata=_METADATA[path.suffix.lower()])
