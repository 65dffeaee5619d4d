"""The project's own promises: layers, pins, names."""

import importlib.metadata
import json
import re

import jsonschema
import pytest
import yaml

from hopper import __version__
from tests.workflow.conftest import ROOT

RULES = "\n".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))


def test_each_script_belongs_to_the_rule_of_its_name():
    rules = set(re.findall(r"^rule (\w+):", RULES, re.MULTILINE))
    scripts = {path.stem for path in (ROOT / "scripts").glob("*.py")}
    assert rules == scripts


@pytest.mark.parametrize("directive", ["log:", "benchmark:", "threads:", "input:", "output:"])
def test_every_rule_has(directive):
    for block in re.split(r"^rule ", RULES, flags=re.MULTILINE)[1:]:
        assert directive in block, f"rule {block.split(':')[0]} lacks {directive}"


def test_the_rules_know_no_numbers():
    """Numbers belong in config.yaml; a rule may only say how many threads it takes."""
    code = re.sub(r"#.*|\"[^\"]*\"|threads: 1\b|fig_\d_\d\w*|(?<=\w)\d+", "", RULES)
    assert re.findall(r"(?<![\w.])\d+\.?\d*", code) == []


def test_the_citation_file_follows_its_schema():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    # cffconvert itself wants an older jsonschema; the schema it brings is all that is used of it.
    schema = next(
        file
        for file in importlib.metadata.files("cffconvert") or []
        if file.as_posix().endswith("schemas/1.2.0/schema.json")
    )
    jsonschema.Draft7Validator(json.loads(schema.read_text())).validate(citation)
    assert citation["version"] == __version__
    assert citation["license"] in (ROOT / "LICENSE").read_text()
    paper = citation["references"][0]
    assert paper["title"] == "Similarity solutions for granular flows in hoppers"


def test_the_changelog_knows_the_version():
    headings = re.findall(r"^## \[(.+?)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert headings[0] == "Unreleased"
    assert __version__ in headings


def test_the_workflow_catalog_finds_what_it_asks_for():
    usage = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text())["usage"]
    assert usage["report"] is True
    assert any(usage["software-stack-deployment"].values())
    assert isinstance(usage["mandatory-flags"]["flags"], list)
    readme = (ROOT / "README.md").read_text().lower()
    assert "snakemake" in readme
    assert "workflow" in readme
    assert (ROOT / "workflow/Snakefile").is_file()
    assert (ROOT / "config/config.yaml").samefile(ROOT / "config.yaml")
    instructions = (ROOT / "config/README.md").read_text()
    for section in yaml.safe_load((ROOT / "config.yaml").read_text()):
        assert f"`{section}`" in instructions, f"config/README.md does not explain {section}"


def test_github_runs_the_same_commands_and_keeps_what_they_make():
    steps = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text())["jobs"]["test"]["steps"]
    assert [step["run"] for step in steps if "run" in step] == ["bash .ci/run"]
    actions = [step["uses"] for step in steps if "uses" in step]
    assert all(re.fullmatch(r"actions/[\w-]+@v\d+(\.\d+)*", action) for action in actions)
    kept = next(step for step in steps if "upload-artifact" in step.get("uses", ""))
    assert kept["if"] == "always()"
    wanted = {"figures/*.png", "figures/*.pdf", "results/report.html", "results/figure_checks/"}
    assert wanted <= set(kept["with"]["path"].split())


def test_continuous_integration_makes_the_report_and_reads_it():
    commands = (ROOT / ".ci/run").read_text().splitlines()
    order = [commands.index(f"make {target}") for target in ("test", "report", "test-report")]
    assert order == sorted(order)
