"""The project's own promises: layers, pins, names."""

import re
import tomllib

import pytest
import yaml

from tests.workflow.conftest import ROOT

RULES = "\n".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk"))


def test_the_conda_pins_equal_the_lock():
    environment = yaml.safe_load((ROOT / "envs/hopper.yaml").read_text())
    lock = (ROOT / "requirements.lock").read_text()
    python = next(pin for pin in environment["dependencies"] if pin.startswith("python="))
    for pin in environment["dependencies"]:
        name, wanted = pin.split("=")
        if pin == python:
            continue
        locked = re.findall(rf"^{name}==([\w.]+)", lock, re.MULTILINE | re.IGNORECASE)
        assert any(version.startswith(wanted) for version in locked), f"{pin}: lock has {locked}"


def test_every_dependency_is_locked_with_a_hash():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    runtime = (ROOT / "requirements.lock").read_text().lower()
    development = (ROOT / "requirements-dev.lock").read_text().lower()
    for wanted, lock in (
        (project["dependencies"] + extras["workflow"], runtime),
        (extras["dev"], development),
    ):
        for requirement in wanted:
            name = re.match(r"[\w-]+", requirement)
            assert name
            assert re.search(rf"^{name[0].lower()}==.*\n +--hash=", lock, re.MULTILINE), requirement
    for lock in (runtime, development):
        assert "http" not in lock


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
