"""The site of a fresh copy: text alone, and the command that makes the figures."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.site.conftest import ENVIRONMENT, ROOT
from tests.workflow.conftest import PARTS

pytestmark = pytest.mark.site
ALSO = ("docs", "CHANGELOG.md", "CONTRIBUTING.md")


def test_text_alone_and_the_command_that_makes_figures(tmp_path: Path):
    for name in (*PARTS, *ALSO):
        origin, copy = ROOT / name, tmp_path / name
        (shutil.copytree if origin.is_dir() else shutil.copy2)(origin, copy)
    command = [sys.executable, "-m", "hopper_workflow.site"]
    done = subprocess.run(
        command, cwd=tmp_path, env=ENVIRONMENT, capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stderr
    missing, made = done.stdout.splitlines()
    assert re.fullmatch(
        r"(\d+) of \1 figures are not drawn yet and have text alone: draw them with: make", missing
    )
    page = (tmp_path / made).parent / "gallery/fig_4_4.html"
    assert "Not drawn yet" in page.read_text(encoding="utf-8")
    assert not (tmp_path / "figures/fig_4_4.png").exists()


def test_a_warning_is_an_error_in_one_line(tmp_path: Path):
    broken = tmp_path / "source/index.md"
    broken.parent.mkdir()
    broken.write_text("# Broken\n\n[nowhere](no_such_page.md)\n")
    program = (
        "from pathlib import Path; from hopper_workflow.site import __main__ as site;"
        f"site.WORK, site.SITE = Path({str(tmp_path)!r}), Path({str(tmp_path / 'site')!r});"
        "site._sphinx()"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, encoding="utf-8",
        env=ENVIRONMENT, check=False,
    )  # fmt: skip
    assert done.returncode != 0
    assert "no_such_page.md" in done.stderr
    assert "a warning of Sphinx above is an error" in done.stderr
