"""The workflow on a real SLURM: the same bytes as without, also if jobs are cancelled."""

import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.reliability import comparison, record
from tests.workflow.conftest import copy

pytestmark = pytest.mark.slurm

COMMAND = [
    sys.executable, "-m", "snakemake", "--workflow-profile", "profiles/slurm",
    "--slurm-status-command", "squeue", "--slurm-no-account", # there is no accounting
    "--slurm-init-seconds-before-status-checks", "2",
]  # fmt: skip
LIMIT = 1800  # seconds, beyond which something hangs


def submitted(log: str) -> list[str]:
    return re.findall(r"submitted with SLURM jobid (\d+)", log)


def running() -> list[str]:
    """Identifiers of the jobs that run, in the order of submission."""
    command = ["squeue", "--noheader", "--states=R", "--sort=i", "--format=%i"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def test_all_figures_are_the_bytes_of_a_local_run(local, tmp_path):
    workflow = copy(tmp_path / "a path with a space")
    done = subprocess.run(
        COMMAND, cwd=workflow.path, capture_output=True, text=True, check=False, timeout=LIMIT
    )
    assert done.returncode == 0, done.stderr
    expected, found = local.products(), workflow.products()
    assert len(expected) > 60
    assert list(found) == list(expected)
    assert [name for name in expected if found[name] != expected[name]] == []
    jobs = submitted(done.stderr)
    assert "Trying to restart" not in done.stderr, "a request was too small"
    assert len(jobs) == len(list((workflow.path / "logs").rglob("*.benchmark.tsv")))
    record(
        "slurm",
        "All figures of the coarse workflow through a SLURM of one node, where a job beyond its "
        "request of memory or time is killed: artifacts and figures are the bytes of a local run.",
        {"jobs run": len(jobs), **comparison(found, expected)},
    )


def test_cancelled_jobs_are_retried(local, tmp_path):
    targets = [f"results/map/{geometry}_10.nc" for geometry in ("wedge", "cone")]
    workflow = copy(tmp_path / "cancelled")
    cancelled: list[str] = []
    log = Path(tmp_path / "log")
    with log.open("w") as output:
        process = subprocess.Popen([*COMMAND, *targets], cwd=workflow.path, stderr=output)
        try:
            end = time.monotonic() + LIMIT
            while process.poll() is None and time.monotonic() < end:
                fresh = [job for job in running() if job not in cancelled]
                if fresh and len(cancelled) < 3:
                    time.sleep(len(cancelled))  # at its start, and one and two seconds later
                    subprocess.run(["scancel", fresh[0]], check=True)
                    cancelled.append(fresh[0])
                time.sleep(0.2)
            assert process.poll() == 0, log.read_text()
        finally:
            process.terminate()
            process.wait()
    text = log.read_text()
    killed = re.findall(r"SLURM-job '(\d+)' failed, SLURM status is: 'CANCELLED'", text)
    assert sorted(set(killed)) == sorted(cancelled)
    assert len(cancelled) == 3
    retried = text.count("Trying to restart job")
    assert retried == len(cancelled)
    found, expected = workflow.products(), local.products()
    assert set(targets) <= set(found)
    assert [name for name in found if found[name] != expected[name]] == []
    record(
        "slurm_cancelled",
        "Jobs killed by scancel, at their start and later, are submitted again; the run completes, "
        "its artifacts are the bytes of a local run.",
        {
            "jobs run": len(submitted(text)),
            "jobs cancelled": len(cancelled),
            "jobs retried": retried,
            **comparison(found, expected, targets),
        },
    )
