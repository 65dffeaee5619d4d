"""Known vulnerabilities of the packages in the locks, asked of a database by pip-audit.

Exit code 1 if there are any, 0 if there are none or if nobody could be asked: without pip-audit or
without a network one line says so.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from hopper_workflow.publish import locks

_SECONDS = 300


def find_tool() -> str | None:
    """Return pip-audit beside this Python, or else on the path."""
    here = str(Path(sys.executable).parent)
    return shutil.which("pip-audit", path=os.pathsep.join([here, os.environ.get("PATH", "")]))


def known_vulnerabilities(tool: str, lock: Path) -> list[str]:
    """Return "package version: identifiers" for each vulnerable package of a lock.

    Raises
    ------
    OSError
        If the tool could not ask; the message is the last line it said.
    """
    command = [tool, "--disable-pip", "--no-deps", "--require-hashes", "-r", str(lock)]
    options = ["--format", "json", "--progress-spinner", "off"]
    try:
        done = subprocess.run(
            command + options, capture_output=True, text=True, check=False, timeout=_SECONDS
        )
        packages = json.loads(done.stdout)["dependencies"]
    except subprocess.TimeoutExpired:
        raise OSError(f"no answer in {_SECONDS} s") from None
    except (ValueError, KeyError, TypeError):
        said = done.stderr.strip().splitlines() or ["it said nothing"]
        raise OSError(said[-1]) from None
    return [
        f"{one['name']} {one['version']}: {', '.join(known['id'] for known in one['vulns'])}"
        for one in packages
        if one.get("vulns")
    ]


def audit(directory: Path) -> int:
    """Print what is known of the locks in a directory and return the exit code."""
    tool = find_tool()
    if tool is None:
        print("audit skipped: pip-audit is not installed (pipx install pip-audit)")
        return 0
    found: set[str] = set()
    for lock in locks.LOCKS.values():
        try:
            found.update(known_vulnerabilities(tool, directory / lock))
        except OSError as error:
            print(f"audit skipped: pip-audit could not ask about {lock}: {error}")
            return 0
    print("\n".join(sorted(found)) or "no known vulnerabilities in the locks")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(audit(Path.cwd()))
