"""Fixtures of the tests of the command."""

import json
import shlex

import pytest

from hopper_cli import commands
from hopper_cli.main import main


@pytest.fixture
def run(capsys):
    """Run the command in this process; return exit code, stdout and stderr."""

    def run(command):
        code = main(shlex.split(command))
        out, err = capsys.readouterr()
        return code, out, err

    return run


@pytest.fixture
def answer(run):
    """Return the parsed JSON of a command that has an answer."""

    def answer(command):
        code, out, err = run(f"{command} --json")
        assert (code, err) == (0, "")

        def refuse(name):
            raise AssertionError(f"{name} in JSON")

        return json.loads(out, parse_constant=refuse)

    return answer


@pytest.fixture
def no_computation(monkeypatch):
    def refuse(options):
        raise AssertionError("the work has started")

    monkeypatch.setattr(commands, "answer", refuse)
