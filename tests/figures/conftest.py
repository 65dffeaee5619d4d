"""Run by `make check`, after `make figures`; `make references` stores anew what is compared."""

from collections.abc import Iterator

import matplotlib
import matplotlib.pyplot as plt
import pytest

from tests.figures import numbers, registry


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "plot" in metafunc.fixturenames:
        metafunc.parametrize("plot", registry.plots().values(), ids=lambda plot: plot.name)
    if "artifact" in metafunc.fixturenames:
        metafunc.parametrize("artifact", numbers.compared_artifacts())


@pytest.fixture(autouse=True)
def _in_the_repository(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Paths of artifacts are relative; a style that one test sets must not reach the next."""
    monkeypatch.chdir(registry.ROOT)
    with matplotlib.rc_context():
        yield
    plt.close("all")


@pytest.fixture
def storing(pytestconfig: pytest.Config) -> bool:
    """Whether references are to be stored rather than compared."""
    return pytestconfig.getoption("--mpl-generate-path") is not None
