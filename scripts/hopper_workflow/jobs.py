"""Run a script as a Snakemake job: its log goes to the log file, what is wrong to the screen."""

import logging
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol, cast

from hopper_workflow import logs
from hopper.errors import HopperError
from hopper_workflow.artifacts import ArtifactError

Progress = Callable[[int, int], None]
# Inputs whose paths are not arguments: modules of code, and files that params name.
BARE = ("code", "files")
_FORMAT = "%(asctime)s %(levelname)-7s %(message)s"


class Job(Protocol):
    """What a script needs of Snakemake's object."""

    rule: str
    input: Mapping[str, Any]
    output: Any  # a mapping of their names, and the paths themselves
    params: Mapping[str, Any]
    log: Sequence[str]


def run(function: Callable[..., None]) -> None:
    """Call a rule's function with the job's named inputs, outputs and params.

    Snakemake puts its object into the script it runs. Inputs that are there for Snakemake only are
    left out. A foreseen error ends in one line and exit code 1. The log of a job that is done is
    sealed.
    """
    job = cast("Job", sys.modules["__main__"].__dict__["snakemake"])
    screen = logging.StreamHandler()
    screen.setLevel(logging.WARNING)
    handlers: list[logging.Handler] = [screen]
    handlers += [logging.FileHandler(path, mode="w", encoding="utf-8") for path in job.log]
    logging.basicConfig(level=logging.INFO, format=_FORMAT, handlers=handlers, force=True)
    logging.captureWarnings(True)
    for library in ("fontTools", "matplotlib"):
        logging.getLogger(library).setLevel(logging.WARNING)
    inputs = {name: value for name, value in job.input.items() if name not in BARE}
    arguments = {**inputs, **job.output, **job.params}
    logging.info("%s: started", job.rule)
    try:
        function(**arguments)
    except (HopperError, ArtifactError, OSError) as error:
        logging.error("%s: %s: %s", job.rule, type(error).__name__, error)
        sys.exit(1)
    except Exception:
        logging.exception("%s: unexpected error", job.rule)
        sys.exit(1)
    logging.info("%s: done", job.rule)
    logging.shutdown()
    for path in job.log:
        logs.seal(path, job.output, _files_read(job))


def _files_read(job: Job) -> list[str]:
    """Return the paths of a job's inputs but code."""
    named = [value for name, value in job.input.items() if name != "code"]
    lists = [[value] if isinstance(value, str) else value for value in named]
    return [str(path) for paths in lists for path in paths]


def progress(logger: logging.Logger, label: str, steps: int = 4) -> Progress:
    """Return a callable(done, total) that logs about ``steps`` times on the way."""
    reported = 0

    def report(done: int, total: int) -> None:
        nonlocal reported
        if done == total or steps * done // total > reported:
            reported = steps * done // total
            logger.info("%s: %d of %d", label, done, total)

    return report
