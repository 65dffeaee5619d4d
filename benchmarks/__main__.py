"""Run every benchmark, or those named on the command line: `python -m benchmarks radial`."""

import importlib
import os
import sys
from pathlib import Path

# Before numpy loads: one BLAS thread, as in the workflow's jobs.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

available = sorted(p.stem.removeprefix("bench_") for p in Path(__file__).parent.glob("bench_*.py"))
chosen = sys.argv[1:] or available
if unknown := set(chosen) - set(available):
    sys.exit(
        f"no benchmark called {', '.join(sorted(unknown))}: choose from {', '.join(available)}"
    )
for name in chosen:
    print(f"\n== {name}", flush=True)
    importlib.import_module(f"benchmarks.bench_{name}").main()
