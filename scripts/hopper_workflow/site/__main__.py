"""Build the site: put its pages together, and run Sphinx, to which a warning is an error."""

import csv
import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from hopper_workflow import configuration, effective, entries
from hopper_workflow.publish import run
from hopper_workflow.site import api, gallery, notebooks, reference, texts, works
from hopper_workflow.site.source import SiteError, Source

WORK, SITE = Path(".site"), Path("results/site")
SCHEMA = Path("workflow/schemas/config.schema.yaml")
_TOLD = (SiteError, run.RunError, configuration.ConfigurationError, OSError)
_CAUSES = ("config.yaml", "Snakefile", "workflow/**/*.smk", "scripts/*.py")


def main() -> None:
    """Build the site in the current directory."""
    given = run.configuration()
    config = effective.merged(given, SCHEMA)
    configuration.check(config, SCHEMA)
    summary = _summary(given)
    source, root = Source(WORK / "source"), Path.cwd()
    texts.write(source, root)
    reference.write(source, root)
    if missing := gallery.write(source, root, config, summary):
        count = f"{len(missing)} of {len(list(entries.drawings(config)))} figures"
        print(f"{count} are not drawn yet and have text alone: draw them with: make", flush=True)
    api.write(source, root)
    works.write(source, root)
    notebooks.write(source, root, WORK / "notebooks")
    if source.finish():  # Sphinx leaves what it once made of them
        shutil.rmtree(SITE, ignore_errors=True)
    _sphinx()
    print(SITE / "index.html")


def _summary(given: Path | None) -> dict[str, Mapping[str, str]]:
    """Return Snakemake's summary by output file; asked for anew if what it follows from changed."""
    causes = sorted(path for pattern in _CAUSES for path in Path().glob(pattern))
    text = b"".join(path.read_bytes() for path in [*causes, *filter(None, [given])])
    kept = WORK / f"summary-{hashlib.sha256(text).hexdigest()[:16]}.json"
    if not kept.exists():
        table = run.snakemake(given, "--detailed-summary")
        rows = {
            row["output_file"]: row for row in csv.DictReader(table.splitlines(), delimiter="\t")
        }
        WORK.mkdir(exist_ok=True)
        for old in WORK.glob("summary-*.json"):
            old.unlink()
        kept.write_text(json.dumps(rows), encoding="utf-8")
    found: dict[str, Mapping[str, str]] = json.loads(kept.read_text(encoding="utf-8"))
    return found


def _sphinx() -> None:
    command = [sys.executable, "-m", "sphinx", "-q", "-j", "2", "-W", "--keep-going"]
    command += ["-b", "html", "-c", "docs/site", "-d", str(WORK / "doctrees")]
    command += [str(WORK / "source"), str(SITE)]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(["scripts", "src"])}
    done = subprocess.run(command, env=environment, check=False)
    if done.returncode != 0:
        raise SiteError("a warning of Sphinx above is an error: mend what it names")


if __name__ == "__main__":
    try:
        main()
    except _TOLD as error:
        sys.exit(f"{SITE} not built: {error}")
