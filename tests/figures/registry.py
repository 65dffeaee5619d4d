"""Which figures there are, how they are drawn and from what: asked of the workflow itself."""

import contextlib
import importlib
import io
import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Plot:
    """A figure of the workflow."""

    name: str
    script: str
    arguments: dict[str, Any]  # of the script's draw: artifacts' paths and plain values
    artifacts: frozenset[str]  # all that feed the figure, directly or not

    def draw(self) -> Figure:
        figure: Figure = importlib.import_module(self.script).draw(**self.arguments)
        return figure


@lru_cache(maxsize=1)
def plots() -> dict[str, Plot]:
    """Return the figures by name, as the Snakefile and config.yaml define them.

    Cases of one's own (``case_...``) are left out: nobody stores references for them.
    """
    # Another process: the Snakefile changes the environment and the import path.
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        found = pool.submit(_plots_of_workflow).result()
    return {plot.name: plot for plot in found if not plot.name.startswith("case_")}


def _plots_of_workflow() -> list[Plot]:
    from snakemake.api import SnakemakeApi
    from snakemake.settings.types import (
        ConfigSettings,
        DAGSettings,
        OutputSettings,
        Quietness,
        ResourceSettings,
    )

    from hopper_workflow import effective

    os.chdir(ROOT)
    record = effective.of_last_run()
    with SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api:
        workflow = api.workflow(
            ResourceSettings(cores=1),
            ConfigSettings(configfiles=[record] if record else []),
            snakefile=Path("Snakefile"),
        )
        with contextlib.redirect_stdout(io.StringIO()):
            workflow.dag(DAGSettings()).summary()  # resolves all jobs and runs none
        jobs = list(workflow._workflow.dag.jobs)  # no public attribute holds them
    made_from = {
        str(output): [str(path) for path in job.input] for job in jobs for output in job.output
    }
    return [_plot(job, made_from) for job in jobs if job.rule.name.startswith("plot_")]


def _plot(job: Any, made_from: dict[str, list[str]]) -> Plot:
    arguments = {**job.input, **job.params}
    arguments.pop("code", None)
    return Plot(
        name=Path(job.output.png).stem,
        script=Path(job.rule.script).stem,
        arguments={name: _plain(value) for name, value in arguments.items()},
        artifacts=frozenset(_upstream(job.output.png, made_from)),
    )


def _plain(value: Any) -> Any:
    """Return what Snakemake wraps (paths, lists of paths) as plain values."""
    if isinstance(value, str):
        return str(value)
    return [_plain(item) for item in value] if isinstance(value, list | tuple) else value


def _upstream(path: str, made_from: dict[str, list[str]]) -> set[str]:
    found = {source for source in made_from.get(path, []) if source.endswith(".nc")}
    return found.union(*(_upstream(source, made_from) for source in found))
