"""A SLURM of its own for the tests of this folder, and a local run to compare with."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.slurm import cluster
from tests.workflow.conftest import Workflow, copy

# More than the machine has: much of a short job is waiting for files and for SLURM.
PROCESSORS = 4


@pytest.fixture(scope="session")
def slurm() -> Iterator[None]:
    pytest.importorskip("snakemake_executor_plugin_slurm", reason="needs `make cluster`")
    try:
        cluster.prepare()
    except cluster.ClusterError as error:
        pytest.skip(str(error))
    # Not below pytest's directory: the name of a socket is short.
    with tempfile.TemporaryDirectory(prefix="slurm") as state:
        Path(state).chmod(0o755)
        with cluster.running(Path(state), PROCESSORS):
            yield


@pytest.fixture(scope="session")
def local(slurm: None, tmp_path_factory: pytest.TempPathFactory) -> Workflow:
    """The workflow run on this machine, without SLURM. Do not change it."""
    workflow = copy(tmp_path_factory.mktemp("local") / "run")
    workflow.build()
    return workflow
