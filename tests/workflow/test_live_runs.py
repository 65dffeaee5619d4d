"""A run that lives keeps its locks and files; the locks of a dead one are removed."""

import json
import socket
import subprocess
import sys

import pytest

from hopper_workflow import live
from tests.workflow.conftest import with_make
from tests.workflow.interruptions import held_job, started

pytestmark = pytest.mark.workflow


def test_a_live_run_keeps_its_locks(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    live.unlock()
    live.leave_record()
    lock = live.LOCKS / "0.input.lock"
    (own,) = live.LOCKS.glob("*.run.json")
    told = json.loads(own.read_text())
    assert told["host"] == socket.gethostname()
    lock.touch()
    with pytest.raises(live.LiveRunError, match="is at work: wait for it, or end it"):
        live.unlock()
    own.write_text(json.dumps(told | {"host": "node17"}))
    with pytest.raises(live.LiveRunError, match=r"of host node17 has a run here.*--unlock"):
        live.unlock()
    own.unlink()
    with pytest.raises(live.LiveRunError, match="does not tell which run left its locks"):
        live.unlock()
    assert lock.exists()
    own.write_text(json.dumps(told | {"began": told["began"] - 10}))
    live.unlock()
    assert not lock.exists()


def test_a_process_at_work_is_found_without_a_lock(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    program = tmp_path / "snakemake"
    program.write_text("import time; time.sleep(60)")
    process = subprocess.Popen([sys.executable, program])
    try:
        with pytest.raises(live.LiveRunError, match=f"kill {process.pid}"):
            live.unlock()
    finally:
        process.kill()
        process.wait()
    live.unlock()


def test_make_resume_leaves_a_live_run_alone(fresh):
    target = "figures/fig_1_1.png"
    with started(fresh, target) as process:
        job = held_job(process)  # or else the run may end before it is found
        done = with_make(fresh, "resume")
        job.resume()
        assert done.returncode != 0
        assert done.stdout == ""
        assert f"not resumed: process {process.pid} of a run is at work here" in done.stderr
        assert process.wait(timeout=120) == 0
    assert (fresh.path / target).exists()
