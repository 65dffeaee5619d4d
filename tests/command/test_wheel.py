"""The wheel, built without a network and used outside the clone."""

import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
OFFLINE = ["--no-index", "--no-deps"]


def checked(command, directory, **variables):
    done = subprocess.run(
        command, cwd=directory, env={**os.environ, **variables}, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    # A build leaves files in its sources.
    sources = tmp_path_factory.mktemp("sources") / "clone"
    hidden = shutil.ignore_patterns("__pycache__", "*.egg-info")
    shutil.copytree(ROOT / "src", sources / "src", ignore=hidden)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy2(ROOT / name, sources / name)
    checked([*PIP, "wheel", *OFFLINE, "--no-build-isolation", "-w", "dist", "."], sources)
    (found,) = (sources / "dist").iterdir()
    return found


@pytest.fixture(scope="module")
def site(wheel, tmp_path_factory):
    """Where the wheel is installed, away from the clone."""
    target = tmp_path_factory.mktemp("somewhere else") / "site"
    checked([*PIP, "install", *OFFLINE, "--target", str(target), str(wheel)], target.parent)
    return target


def test_the_distribution_has_a_name_of_its_own(wheel):
    assert wheel.name.startswith("granular_hopper-")
    with ZipFile(wheel) as archive:
        packages = {name.split("/")[0] for name in archive.namelist()}
        (metadata,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
        text = archive.read(metadata).decode()
    assert {name for name in packages if "." not in name} == {"hopper", "hopper_cli", "hopper_data"}
    assert "Name: granular-hopper\n" in text
    for extra in ("plot", "data", "workflow"):
        assert f"Provides-Extra: {extra}\n" in text


def test_small_extras_bring_no_workflow():
    for extra in ("plot", "data"):
        assert not {"snakemake", "grimp"} & {
            one.partition(">")[0] for one in PROJECT["optional-dependencies"][extra]
        }
    assert set(PROJECT["optional-dependencies"]["workflow"]) > {
        one for extra in ("plot", "data") for one in PROJECT["optional-dependencies"][extra]
    }


def test_the_command_of_the_wheel_answers_outside_the_clone(site, tmp_path):
    options = "radial --geometry cone --delta 40 --half-angle 20 --mu 0.3 --json"
    files = ["--profile", str(tmp_path / "out.nc"), "--plot", str(tmp_path / "out.png")]
    command = [str(site / "bin/hopper"), *options.split(), *files]
    answer = json.loads(checked(command, tmp_path, PYTHONPATH=str(site)))
    assert answer["flow_factor"] == pytest.approx(1.45872524832)
    assert (tmp_path / "out.nc").is_file()
    assert (tmp_path / "out.png").is_file()


def test_the_package_of_the_wheel_is_the_one_that_is_imported(site, tmp_path):
    code = "import hopper, hopper_data; print(hopper.__file__); print(hopper.Hopper.__module__)"
    printed = checked([sys.executable, "-c", code], tmp_path, PYTHONPATH=str(site))
    assert printed.splitlines() == [str(site / "hopper/__init__.py"), "hopper.problem"]
