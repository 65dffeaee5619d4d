"""The report: one HTML file with all figures and tables, readable without a network."""

from pathlib import Path

from hopper_workflow.artifacts import replacing
from hopper_workflow.publish import run

STYLESHEET = Path(__file__).parents[3] / "workflow/report/report.css"


def write_report(path: Path, configuration: Path | None) -> None:
    """Write Snakemake's report of the finished run.

    Raises
    ------
    RunError
        If there is no finished run; an older report stays as it is.
    """
    run.products(configuration)
    with replacing(path) as temporary:
        options = ["--report", str(temporary), "--report-stylesheet", str(STYLESHEET)]
        run.snakemake(configuration, *options)


if __name__ == "__main__":
    run.publish(write_report, "results/report.html")
