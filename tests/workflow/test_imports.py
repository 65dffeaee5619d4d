"""What a job loads before its own work: imports are a good part of a short job."""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
SCRIPTS = {path.stem: path.read_text(encoding="utf-8") for path in ROOT.glob("scripts/*.py")}
_READS = r"reading\b|merging|plotting|claims\.ledger"
# Slow modules, and what a script says that needs them. SciPy's parts load when they are asked for.
SLOW = {
    "xarray": _READS,
    "pandas": f"pandas|{_READS}",
    "matplotlib": "plotting",
    "yaml": "claims",
    **dict.fromkeys(
        [f"scipy.{part}" for part in ("linalg", "optimize", "special", "stats", "interpolate")],
        "never",
    ),
}
IMPORTED = """
import importlib, json, sys
slow, scripts = json.loads(sys.argv[1])
for script in scripts:
    before = set(sys.modules)
    importlib.import_module(script)
    print(json.dumps([script, [name for name in slow if name in sys.modules.keys() - before]]))
"""


def test_no_script_imports_what_it_does_not_use():
    needed = {
        script: {module for module, pattern in SLOW.items() if re.search(pattern, text)}
        for script, text in SCRIPTS.items()
    }
    # In one process, those first that need least: what is new is due to the script.
    order = sorted(SCRIPTS, key=lambda script: (len(needed[script]), script))
    done = subprocess.run(
        [sys.executable, "-c", IMPORTED, json.dumps([list(SLOW), order])],
        cwd=ROOT / "scripts",
        capture_output=True,
        text=True,
        check=True,
    )
    loaded = {script: set(new) for script, new in map(json.loads, done.stdout.splitlines())}
    assert loaded.keys() == SCRIPTS.keys()
    assert {
        script: new - needed[script] for script, new in loaded.items() if new - needed[script]
    } == {}
    assert {module for new in loaded.values() for module in new} >= {"xarray", "matplotlib"}
    assert sum(not modules for modules in needed.values()) > 15
