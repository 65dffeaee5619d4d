"""Wall time of the whole workflow on two cores, and of a run with nothing to do."""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]


def main() -> None:
    """Build every figure in a copy of the repository, then run again."""
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder) / "clone"
        subprocess.run(["git", "clone", "-q", str(ROOT), str(clone)], check=True)
        for label in ("all figures", "nothing to do"):
            start = time.perf_counter()
            command = [sys.executable, "-m", "snakemake", "--cores", "2", "--quiet", "all"]
            subprocess.run(command, cwd=clone, check=True, capture_output=True)
            print(f"{label:<40} {time.perf_counter() - start:8.1f} s")
