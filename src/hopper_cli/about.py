"""Options that end the command: its version, and a script that completes it in a shell."""

import argparse
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import hopper
from hopper_cli.errors import UsageError

SHELLS = ("bash", "zsh", "tcsh")
_TIMEOUT = 5.0


class Version(argparse.Action):
    """Print the version, with the commit where the package lies in a clone."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        """Print and end."""
        print(f"hopper {hopper.__version__}{commit(Path(hopper.__file__).parents[2])}")
        parser.exit()


class Completion(argparse.Action):
    """Print the script that completes commands, options and files in a shell."""

    def __call__(self, parser: argparse.ArgumentParser, _: Any, shell: Any, *__: Any) -> None:
        """Print and end."""
        try:
            import shtab
        except ModuleNotFoundError:
            raise UsageError("argument --print-completion: install shtab first") from None
        for action in _actions(parser):
            if action.type is Path:
                action.complete = shtab.FILE  # type: ignore[attr-defined]
        print(shtab.complete(parser, shell))
        parser.exit()


def add(parser: argparse.ArgumentParser) -> None:
    """Add the options to the command."""
    parser.add_argument(
        "--version", action=Version, nargs=0, help="print version and commit, and end"
    )
    parser.add_argument(
        "--print-completion",
        action=Completion,
        choices=SHELLS,
        help="print the script that completes this command in a shell, and end",
    )


def commit(clone: Path) -> str:
    """Return `git describe` of a clone in brackets, nothing where there is none."""
    if not (clone / ".git").exists():
        return ""
    # Only now: it takes longer than the help.
    import subprocess

    environment = {name: value for name, value in os.environ.items() if name[:4] != "GIT_"}
    try:
        done = subprocess.run(
            ["git", "-C", str(clone), "describe", "--always", "--dirty", "--abbrev=12"],
            env=environment | {"GIT_OPTIONAL_LOCKS": "0"},
            capture_output=True,
            text=True,
            timeout=_TIMEOUT,
            check=True,
        )
    except (OSError, subprocess.SubprocessError):
        return ""
    return f" (commit {done.stdout.strip()})"


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Yield the actions of a parser and of its subcommands."""
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                yield from _actions(command)
