"""A SLURM of one node on this machine, for the tests: needs root and the packages of Debian.

State, logs and keys live in a directory of their own. The configuration has to be the file that
SLURM's commands read without being told: within a job the executor drops SLURM's variables, the
one that names another file among them.
"""

import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

CONFIG = Path("/etc/slurm/slurm.conf")
PACKAGES = ("slurmctld", "slurmd", "slurm-client", "munge")
PROGRAMS = ("slurmctld", "slurmd", "sbatch", "munged")
# Memory is a resource, and a job beyond its request is killed: the tests hold the requests. The
# node claims more processors than it has, as most of a short job is waiting for files and SLURM.
_SETTINGS = """\
ClusterName=hopper
SlurmctldHost={host}(127.0.0.1)
AuthInfo=socket={state}/munge.socket
SlurmUser=root
StateSaveLocation={state}
SlurmdSpoolDir={state}/node
SlurmctldPidFile={state}/slurmctld.pid
SlurmdPidFile={state}/slurmd.pid
SlurmctldLogFile={state}/slurmctld.log
SlurmdLogFile={state}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=2
JobAcctGatherParams=OverMemoryKill
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory=8000 State=UNKNOWN
PartitionName=test Nodes={host} Default=YES State=UP
"""


class ClusterError(Exception):
    """No SLURM can be started here; the message says why."""


def prepare() -> None:
    """Install SLURM where it is missing.

    Raises
    ------
    ClusterError
        If this is not Linux, not root, a SLURM is configured already, or it cannot be installed.
    """
    if not sys.platform.startswith("linux"):
        raise ClusterError("SLURM needs Linux")
    if os.geteuid() != 0:
        raise ClusterError("starting a SLURM needs root")
    if CONFIG.exists():
        raise ClusterError(f"{CONFIG} belongs to another SLURM: remove it to run these tests")
    if not _missing():
        return
    if not shutil.which("apt-get"):
        raise ClusterError(f"{', '.join(_missing())} are missing, and there is no apt-get")
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["update"], ["install", "-y", "--no-install-recommends", *PACKAGES]):
        done = subprocess.run(
            ["apt-get", "-qq", *command],
            env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
        )  # fmt: skip
        if done.returncode:
            raise ClusterError(f"apt-get {command[0]} failed: {done.stderr.strip()[-500:]}")
    if _missing():
        raise ClusterError(f"{', '.join(_missing())} are missing after the installation")


@contextmanager
def running(state: Path, processors: int) -> Iterator[None]:
    """Start the SLURM, and stop it at the end with all its jobs.

    ``state`` is an empty directory that only root may write to.

    Raises
    ------
    ClusterError
        If it does not answer; the message has the end of the logs.
    """
    host = socket.gethostname().partition(".")[0]
    settings = _SETTINGS.format(host=host, state=state, processors=processors)
    files = {"key": "munge.key", "socket": "munge.socket", "pid": "munge.pid",
             "log": "munge.log", "seed": "munge.seed"}  # fmt: skip
    options = [f"--{kind}{'' if kind == 'socket' else '-file'}={state / name}"
               for kind, name in files.items()]  # fmt: skip
    with ExitStack() as stack:
        CONFIG.parent.mkdir(exist_ok=True)
        with CONFIG.open("x", encoding="utf-8") as file:
            file.write(settings)
        stack.callback(CONFIG.unlink)
        (state / "node").mkdir()
        (state / "munge.key").write_bytes(os.urandom(128))
        (state / "munge.key").chmod(0o400)
        for command in (["munged", "-F", *options], ["slurmctld", "-D", "-c"], ["slurmd", "-D"]):
            stack.enter_context(_daemon(command, state))
        _wait(lambda: _answer("sinfo", "-h", "-o", "%t") == "idle", state)
        try:
            yield
        finally:
            # What an interrupted test left would outlive the daemons.
            subprocess.run(["scancel", "--user=root"], check=False)
            _wait(lambda: _answer("squeue", "-h") == "", state)


def _missing() -> list[str]:
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return [program for program in PROGRAMS if not shutil.which(program, path=path)]


@contextmanager
def _daemon(command: list[str], state: Path) -> Iterator[None]:
    environment = {**os.environ, "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin"}
    with (state / f"{command[0]}.out").open("w") as output:
        process = subprocess.Popen(
            command, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=output
        )
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _wait(ready: Callable[[], bool], state: Path) -> None:
    end = time.monotonic() + 60
    while not ready():
        if time.monotonic() > end:
            logs = [*state.glob("*.out"), *state.glob("*.log")]
            tails = [f"{log.name}: {log.read_text(errors='replace')[-500:]}" for log in logs]
            raise ClusterError("SLURM does not answer:\n" + "\n".join(tails))
        time.sleep(0.2)


def _answer(*command: str) -> str | None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else None
