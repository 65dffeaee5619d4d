"""Shared set-up of all tests."""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parents[1] / "scripts"))

import hopper_workflow  # noqa: F401 - this clone's sources, whatever is installed
