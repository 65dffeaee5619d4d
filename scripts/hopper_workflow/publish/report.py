"""The report: one HTML file with all figures and tables, readable without a network."""

import base64
import io
import json
from html import escape
from pathlib import Path

from PIL import Image

from hopper_workflow import entries
from hopper_workflow.artifacts import replacing
from hopper_workflow.publish import run

# In workflow.rst, where the first page shows all figures; at most so many pixels each.
_PLACE = '<div class="gallery"></div>'
_SMALL = (560, 420)
STYLESHEET = Path(__file__).parents[3] / "workflow/report/report.css"


def write_report(path: Path, configuration: Path | None) -> None:
    """Write Snakemake's report of the finished run.

    Raises
    ------
    RunError
        If there is no finished run; an older report stays as it is.
    """
    made = run.products(configuration)
    with replacing(path) as temporary:
        options = ["--report", str(temporary), "--report-stylesheet", str(STYLESHEET)]
        run.snakemake(configuration, *options)
        page = temporary.read_text(encoding="utf-8")
        place = json.dumps(_PLACE)[1:-1]
        if page.count(place) != 1:
            raise run.RunError(f"the report has no place {_PLACE} for the figures")
        figures = [file for file in made if file.suffix == ".png"]
        figures.sort(key=lambda file: file.stem.startswith("case_"))
        pictures = "".join(_picture(file) for file in figures)
        temporary.write_text(page.replace(place, json.dumps(pictures)[1:-1]), encoding="utf-8")


def _picture(file: Path) -> str:
    """Return a small picture of a figure with its name, as HTML."""
    with Image.open(file) as whole:
        small = whole.convert("RGB")
    small.thumbnail(_SMALL)
    content = io.BytesIO()
    small.quantize(64).save(content, "PNG", optimize=True)
    source = base64.b64encode(content.getvalue()).decode()
    name = escape(entries.number_of(file.stem))
    return (
        f'<figure class="small"><img alt="{name}" src="data:image/png;base64,{source}">'
        f"<figcaption>{name}</figcaption></figure>"
    )


if __name__ == "__main__":
    run.publish(write_report, "results/report.html")
