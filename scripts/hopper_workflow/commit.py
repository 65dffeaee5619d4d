"""The commit of the code, where git knows it."""

import logging
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).parents[2]


def commit() -> str | None:
    """Return `git describe` of this project; None, with a line in the log, where there is none.

    A repository around the project, or one that the environment names, is somebody else's.
    """
    try:
        top = _git("rev-parse", "--show-toplevel")
        if ROOT.samefile(top):
            return _git("describe", "--always", "--dirty", "--abbrev=12")
        reason = f"{ROOT} is not the top of a repository, but inside {top}"
    except subprocess.CalledProcessError as error:
        reason = "git says " + " ".join(error.stderr.split())
    except OSError as error:
        reason = f"git cannot be run ({error.strerror})"
    logging.info("commit not recorded: %s", reason)
    return None


def _git(*arguments: str) -> str:
    environment = {name: value for name, value in os.environ.items() if name[:4] != "GIT_"}
    done = subprocess.run(
        ["git", *arguments],
        cwd=ROOT,
        env=environment | {"LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    return done.stdout.rstrip("\n")
