"""Killed, cut short, or with nowhere to write: nothing is lost, and nothing half-written counts."""

import contextlib
import os
import random
import re
import shutil
import subprocess
from collections import Counter

import pytest

from hopper_data.files import replacing
from tests.reliability import comparison, record
from tests.workflow import interruptions
from tests.workflow.interruptions import held_job, killed_at_random, resume, started

pytestmark = pytest.mark.workflow
SEED = 2000
SHORT = 4  # kills in the short version
# Some of every kind: solver, chunks that are merged, several artifacts for a plot.
SOME = ("figures/fig_3_1.png", "results/smooth_wall.nc", "results/map/cone_10.nc")
AS_ROOT = pytest.mark.skipif(
    os.geteuid() != 0 or not shutil.which("mount"), reason="mounting a small disk needs root"
)


def completed(workflow, expected):
    """Check that the targets are there and all files are the expected; return the counts."""
    found = workflow.products()
    assert {*SOME} <= found.keys()
    assert found.items() <= expected.items()
    return comparison(found, expected, SOME)


def sound(built):
    found = built.products()
    assert len(found) > 60
    return found


@pytest.mark.soak
def test_killed_at_random_moments(built, fresh):
    expected = sound(built)
    at_work = killed_at_random(fresh, expected, SHORT, random.Random(SEED), *SOME)
    resume(fresh, *SOME)
    compared = completed(fresh, expected)
    assert at_work > 0
    record(
        "kill_and_resume_short",
        "A few targets were built, and the run killed with all its processes (SIGKILL) at random "
        "moments, then resumed: the files are, byte for byte, those of an undisturbed run.",
        {"moments killed": SHORT, "jobs at work then": at_work, **compared},
    )


@pytest.mark.soak
def test_killed_at_many_random_moments(built, copy_workflow, tmp_path):
    expected, rng = sound(built), random.Random(SEED)
    at_work, rounds, kills = 0, 2, 12
    compared: Counter[str] = Counter()
    for turn in range(rounds):
        workflow = copy_workflow(tmp_path / str(turn))
        at_work += killed_at_random(workflow, expected, kills, rng)
        resume(workflow)
        found = workflow.products()
        assert found == expected
        compared.update(comparison(found, expected))
        assert workflow.publish("verify").returncode == 0
        assert interruptions.leftovers(workflow) == []
    record(
        "kill_and_resume",
        "The whole workflow, on coarse grids, was killed with all its processes (SIGKILL) at "
        "random moments, resumed, killed again, and at last completed: every artifact, table and "
        "figure is, byte for byte, that of an undisturbed run.",
        {"moments killed": rounds * kills, "jobs at work then": at_work, "runs completed": rounds,
         **compared},
    )  # fmt: skip


@pytest.mark.soak
def test_one_job_killed(built, fresh):
    with started(fresh, *SOME) as process:
        held_job(process).kill()
        assert process.wait(timeout=120) == 1
    log = (fresh.path / "run.log").read_text(encoding="utf-8")
    assert re.search(r"failed: \w+; more: cat logs/", log)
    assert "Traceback" not in log
    fresh.build(*SOME)
    compared = completed(fresh, sound(built))
    record("job_killed", "One job of a run was killed: the run ended with exit code 1 and the name "
           "of the rule, and the next run made what was missing.",
           {"jobs killed": 1, **compared})  # fmt: skip


@pytest.mark.soak
def test_two_runs_at_once(built, fresh):
    with started(fresh, *SOME) as process:
        at_work = held_job(process)  # so that the first run cannot end before the second begins
        second = fresh.snakemake(*SOME)
        at_work.resume()
        assert second.returncode == 1
        assert "cannot be locked" in second.stderr
        assert "Traceback" not in second.stderr
        assert process.wait(timeout=300) == 0
    compared = completed(fresh, sound(built))
    record("two_runs_at_once", "A second run in the same directory is refused while the first "
           "works, and does not disturb it.",
           {"runs refused": 1, **compared})  # fmt: skip


@contextlib.contextmanager
def mounted(folder, *options):
    subprocess.run(["mount", *options, str(folder)], check=True, capture_output=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


@pytest.mark.soak
@AS_ROOT
def test_disk_full(built, fresh):
    disk = fresh.path / "results"
    disk.mkdir()
    expected = sound(built)
    with mounted(disk, "-t", "tmpfs", "-o", "size=96k", "tmpfs"):
        done = fresh.snakemake("--keep-going", *SOME)
        assert done.returncode == 1
        assert re.search(r"No space left on device|\d+ bytes free on its disk", done.stderr)
        assert "unexpected error" not in done.stderr
        partial = fresh.products()
        assert partial.items() <= expected.items()
        assert {*SOME} > partial.keys() & {*SOME}
        subprocess.run(["mount", "-o", "remount,size=64m", str(disk)], check=True)
        fresh.build(*SOME)
        compared = completed(fresh, expected)
    record("disk_full", "The disk of the results had 96 KiB: jobs ended with the reason, what they "
           "had begun was removed, and with space again the run was completed.",
           {"files before": len(partial), **compared})  # fmt: skip


@AS_ROOT
def test_results_read_only(built, rebuilt):
    disk, expected = rebuilt.path / "results", sound(built)
    rebuilt.set("radial.fig_3_1.delta_deg", 31)
    with mounted(disk, "--bind", str(disk)):
        subprocess.run(["mount", "-o", "remount,bind,ro", str(disk)], check=True)
        done = rebuilt.snakemake("figures/fig_3_1.png")
        assert done.returncode == 1
        assert "Write-protected output files for rule solve_radial" in done.stderr
        assert "results/radial/fig_3_1.nc" in done.stderr
        assert "Traceback" not in done.stderr
    lost = expected.keys() - rebuilt.products().keys()
    assert not {path for path in lost if path.startswith("results")}
    rebuilt.set("radial.fig_3_1.delta_deg", 30)
    rebuilt.build()
    found = rebuilt.products()
    assert found == expected
    record("results_read_only", "With results/ read-only a run that had to change them ended with "
           "the reason and changed nothing; writable again, it went on.",
           comparison(found, expected))  # fmt: skip


def test_what_a_killed_writer_leaves_is_removed_by_the_next(tmp_path):
    gone = subprocess.Popen(["true"])
    gone.wait()
    left = tmp_path / f".artifact.{gone.pid}.partial.nc"
    at_work = tmp_path / f".artifact.{os.getppid()}.partial.nc"
    other = tmp_path / f".artifact.2.{gone.pid}.partial.nc"
    for path in (left, at_work, other):
        path.write_text("half", encoding="utf-8")
    with replacing(tmp_path / "artifact.nc") as partial:
        partial.write_text("whole", encoding="utf-8")
    assert sorted(tmp_path.iterdir()) == sorted([at_work, other, tmp_path / "artifact.nc"])
