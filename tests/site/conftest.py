"""The site that `make docs` built here."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SITE = ROOT / "results/site"
# As the Makefile calls the builder, from the root or a copy of it.
ENVIRONMENT = os.environ | {"PYTHONPATH": os.pathsep.join(["scripts", "src"])}


@pytest.fixture(scope="session")
def site() -> Path:
    assert (SITE / "index.html").is_file(), "there is no site: build it with: make docs"
    return SITE
