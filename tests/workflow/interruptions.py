"""Runs of the workflow that are killed at chosen moments, and what they leave."""

import contextlib
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import TypeVar

import psutil

from tests.workflow.conftest import Workflow

_Found = TypeVar("_Found")


@contextlib.contextmanager
def started(workflow: Workflow, *targets: str) -> Iterator[subprocess.Popen[str]]:
    """Start the workflow in a session of its own; nothing of it outlives the block."""
    with (workflow.path / "run.log").open("w", encoding="utf-8") as output:
        process = subprocess.Popen(
            [sys.executable, "-m", "snakemake", "--cores", "2", *targets],
            cwd=workflow.path,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
            stdout=output,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            yield process
        finally:
            kill(process)


def kill(process: subprocess.Popen[str]) -> int:
    """Kill every process of the run at once, and return how many jobs it had at work."""
    members = [each for each in psutil.process_iter() if _session(each) == process.pid]
    jobs = sum(".snakemake/scripts" in " ".join(_command(each)) for each in members)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    for each in members:
        with contextlib.suppress(psutil.NoSuchProcess):
            each.kill()
    psutil.wait_procs(members, timeout=10)
    process.wait(timeout=10)
    return jobs


def jobs_of(process: subprocess.Popen[str]) -> list[psutil.Process]:
    """Return the processes that run a script now."""
    try:
        members = psutil.Process(process.pid).children(recursive=True)
    except psutil.NoSuchProcess:
        return []
    return [each for each in members if ".snakemake/scripts" in " ".join(_command(each)[:2])]


def wait_for(condition: Callable[[], _Found | None], seconds: float = 120) -> _Found:
    """Return what a condition finds, once it finds something.

    Raises
    ------
    TimeoutError
        If it does not within the time.
    """
    end = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > end:
            raise TimeoutError(f"not within {seconds:g} s: {condition}")
        time.sleep(0.02)
    return found


def held_job(process: subprocess.Popen[str]) -> psutil.Process:
    """Return a job of a run, suspended, so that it does not end before something is done to it."""

    def hold() -> psutil.Process | None:
        for job in jobs_of(process):
            with contextlib.suppress(psutil.NoSuchProcess):
                job.suspend()
                # The signal arrives a moment later; a job left behind would stay suspended.
                if wait_for(partial(_halted, job)) == psutil.STATUS_STOPPED:
                    return job
        return None

    return wait_for(hold)


def _halted(job: psutil.Process) -> str | None:
    status = job.status()
    return status if status in (psutil.STATUS_STOPPED, psutil.STATUS_ZOMBIE) else None


def resume(workflow: Workflow, *targets: str) -> None:
    """Take up a killed run as `make resume` does, to its end."""
    workflow.build("--unlock")
    workflow.build(*targets)


def killed_at_random(
    workflow: Workflow, sound: dict[str, str], kills: int, rng: random.Random, *targets: str
) -> int:
    """Start, kill and take up a run again and again, and return how many jobs were at work.

    After each kill every file that counts as a result must be the one of an undisturbed run.
    """
    at_work = 0
    for _ in range(kills):
        if (workflow.path / ".snakemake/locks").is_dir():
            workflow.build("--unlock")
        with started(workflow, *targets) as process:
            # From the first job on, up to a few seconds: start-up alone leaves nothing to find.
            with contextlib.suppress(TimeoutError):
                wait_for(lambda: bool(jobs_of(process)) or process.poll() is not None)
            time.sleep(rng.uniform(0, 3))
            at_work += kill(process)
        assert workflow.products().items() <= sound.items()
    return at_work


def _session(process: psutil.Process) -> int | None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        return os.getsid(process.pid)
    return None


def _command(process: psutil.Process) -> list[str]:
    with contextlib.suppress(psutil.Error):
        return list(process.cmdline())
    return []


def leftovers(workflow: Workflow) -> list[Path]:
    """Return what writers that were killed have left in the results."""
    return sorted((workflow.path / "results").rglob("*.partial*"))
