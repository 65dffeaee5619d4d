"""Nothing of a user's surroundings enters a result, or one line says what cannot be set aside."""

import logging
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from hopper_workflow import commit, effective, surroundings, targets
from tests.reliability import comparison, record
from tests.workflow.conftest import HOST, ROOT, Workflow, with_make

pytestmark = pytest.mark.workflow
SCHEMA = ROOT / "workflow/schemas/config.schema.yaml"
MATPLOTLIBRC = "font.size: 31\ntext.usetex: True\nlines.linewidth: 9\nsavefig.dpi: 17\n"
# A module that stops whatever finds it on its path.
TRAP = "raise SystemExit('a module of the user has been imported')\n"


def hostile(folder: Path) -> dict[str, str]:
    """Return variables that change what a process does, and write the files they name."""
    (folder / "modules").mkdir(parents=True)
    for name in ("sitecustomize", "hopper", "yaml", "numpy"):
        (folder / f"modules/{name}.py").write_text(TRAP)
    (folder / "matplotlibrc").write_text(MATPLOTLIBRC)
    (folder / "pip.conf").write_text("[install]\nuser = true\n")
    (folder / "shell").write_text("exit 7\n")
    (folder / "snakemake/default").mkdir(parents=True)
    (folder / "snakemake/default/config.yaml").write_text("dry-run: true\n")
    subprocess.run(["git", "init", "-q", folder / "repository"], check=True)
    return {
        "PYTHONPATH": str(folder / "modules"),
        "PYTHONWARNINGS": "error",
        "PYTHONHASHSEED": "7",
        "PYTHONOPTIMIZE": "2",
        "PYTHONINTMAXSTRDIGITS": "640",
        "PYTHONSAFEPATH": "1",
        "MPLCONFIGDIR": str(folder),
        "MATPLOTLIBRC": str(folder),
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "NPY_PROMOTION_STATE": "legacy",
        "NPY_DISABLE_CPU_FEATURES": "AVX2",
        "OPENBLAS_NUM_THREADS": "2",
        "OPENBLAS_CORETYPE": "Nehalem",
        "OMP_NUM_THREADS": "7",
        "XARRAY_KEEP_ATTRS": "never",
        "HDF5_USE_FILE_LOCKING": "TRUE",
        "HDF5_PLUGIN_PATH": str(folder),
        "NETCDF_RC": str(folder),
        "GIT_DIR": str(folder / "repository/.git"),
        "GIT_WORK_TREE": str(folder / "repository"),
        "SNAKEMAKE_PROFILE": "default",
        "SNAKEMAKE_OUTPUT_CACHE": str(folder),
        "XDG_CONFIG_HOME": str(folder),
        "PIP_CONFIG_FILE": str(folder / "pip.conf"),
        "PIP_USER": "true",
        "BASH_ENV": str(folder / "shell"),
        "CDPATH": "/",
        "SOURCE_DATE_EPOCH": "0",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2",
        "LANG": "tr_TR.UTF-8",
        "LC_ALL": "C",
        "TZ": "Asia/Kathmandu",
        "http_proxy": "http://127.0.0.1:9",
        "https_proxy": "http://127.0.0.1:9",
        "DISPLAY": ":99",
    }


@pytest.mark.parametrize(
    "goal",
    # With handles of a legend that its script makes when it is imported.
    ["figures/fig_4_2_physical.png", pytest.param("figures", marks=pytest.mark.soak)],
)
def test_a_hostile_environment_leaves_every_byte_as_it_is(fresh, copy_workflow, tmp_path, goal):
    other = copy_workflow(tmp_path / "hostile")
    variables = hostile(tmp_path / "home")
    shutil.copy(tmp_path / "home/matplotlibrc", other.path)
    # Ours: not what git puts into a repository, nor the caches that runs leave.
    ours = [path for path in (tmp_path / "home").rglob("*") if path.is_file()]
    files = sum(tmp_path / "home/repository" not in path.parents for path in ours) + 1
    fresh.build(*([] if goal == "figures" else [goal]))
    done = with_make(other, goal, variables=variables, umask=0o077)
    assert done.returncode == 0, done.stderr
    expected, found = fresh.products(), other.products()
    assert "figures/fig_4_2_physical.png" in expected
    assert found == expected
    record(
        "surroundings",
        "Two copies of the workflow, one with variables and files in its surroundings that are "
        "known to change what Python, NumPy, Matplotlib, HDF5, git, Snakemake and the shell do, "
        "gave equal bytes through make. The environment stood already: pip did not run.",
        {
            "variables set": len(variables),
            "files set": files,
            "runs compared": 2,
            "files compared": len(found),
            "files that differ": comparison(found, expected)["with other bytes"],
        },
    )


def test_what_scripts_make_when_imported_is_in_the_default_style(tmp_path):
    """Handles of legends: no matplotlibrc, here that of the working directory, enters."""
    (tmp_path / "matplotlibrc").write_text(MATPLOTLIBRC)
    code = (
        "from hopper_workflow import plotting; from matplotlib import rcParams, rcParamsDefault;"
        "print({k for k, v in rcParamsDefault.items() if 'backend' not in k and rcParams[k] != v});"
        "print(plotting.key('').get_linewidth() == rcParamsDefault['lines.linewidth'])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT / "scripts")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines() == ["set()", "True"]


def test_make_and_snakemake_keep_the_same_from_jobs(fresh, tmp_path):
    (fresh.path / "GNUmakefile").write_text("include Makefile\nshow: ; @env -0\n")
    variables = hostile(tmp_path / "home") | {"MPLCONFIGDIR": "kept", "MINE": "kept"}
    shown = with_make(fresh, "show", variables=variables).stdout.split("\0")
    passed = dict(item.split("=", 1) for item in shown if item)
    settled = surroundings.settled(variables)
    own = {"PYTHONUTF8", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MPLBACKEND"} | {
        "HDF5_USE_FILE_LOCKING"
    }
    assert variables.keys() & passed.keys() - own == variables.keys() & settled.keys() - own
    assert passed["MINE"] == settled["MINE"] == "kept"


@pytest.mark.soak
def test_the_modules_of_another_clone_are_not_ours(fresh, tmp_path):
    for name in ("hopper", "hopper_workflow"):
        (tmp_path / f"{name}.py").write_text(TRAP)
    fresh.build("figures/fig_1_1.png", PYTHONPATH=str(tmp_path))


def test_make_brings_a_home_and_a_name(fresh, tmp_path, monkeypatch):
    for name in ("LOGNAME", "USER", "LNAME", "USERNAME"):
        monkeypatch.delenv(name, raising=False)
    (fresh.path / "GNUmakefile").write_text("include Makefile\nshow: ; @echo $$HOME $$LOGNAME\n")
    found = with_make(fresh, "show", variables={"HOME": str(tmp_path / "none")}).stdout
    assert found == f"{fresh.path.resolve()}/.venv/home nobody\n"
    found = with_make(fresh, "show", variables={"HOME": str(tmp_path), "LOGNAME": "me"}).stdout
    assert found == f"{tmp_path} me\n"


def test_goals_of_make_are_made_one_after_the_other(fresh):
    slow, fast = "SNAKEMAKE=sleep 0.5; echo figures", "WORKFLOW=echo "
    done = with_make(fresh, "-j4", "figures", "report", "crate", slow, fast)
    assert done.stdout.split() == ["figures", ".publish.report", ".publish.crate"]


DRAW = "import sys; from hopper_cli.main import main; sys.exit(main())"


def test_the_command_draws_as_ever(tmp_path):
    words = "stability --geometry wedge --model mohr-coulomb --delta 40 --half-angle 20 --mu 0.2"
    variables = hostile(tmp_path / "home")
    images = []
    for name in ("plain", "hostile"):
        added = {k: v for k, v in variables.items() if k[:3] == "MPL"} if name == "hostile" else {}
        image = tmp_path / f"{name}.png"
        subprocess.run(
            [sys.executable, "-c", DRAW, *words.split(), "--plot", image],
            env={**os.environ, "PYTHONPATH": str(ROOT / "src"), **added},
            check=True,
            capture_output=True,
        )
        images.append(image.read_bytes())
    assert images[0] == images[1]


def test_the_commit_of_another_repository_is_not_ours(tmp_path, monkeypatch, caplog):
    caplog.set_level(logging.INFO)
    around, inside = tmp_path / "around", tmp_path / "around/hopper"
    inside.mkdir(parents=True)
    for command in (["init", "-q"], ["commit", "-q", "--allow-empty", "-m", "Theirs"]):
        identity = ["-c", "user.name=Somebody", "-c", "user.email=somebody@example.org"]
        subprocess.run(["git", *identity, *command], cwd=around, check=True)
    monkeypatch.setattr(commit, "ROOT", inside)
    assert commit.commit() is None
    assert "commit not recorded" in caplog.text
    assert "is not the top of a repository, but inside" in caplog.text
    monkeypatch.setattr(commit, "ROOT", tmp_path)
    monkeypatch.setenv("GIT_DIR", str(around / ".git"))
    assert commit.commit() is None
    assert "not a git repository" in caplog.text
    monkeypatch.setattr(commit, "ROOT", around)
    assert len(commit.commit() or "") == 12
    monkeypatch.setenv("PATH", str(tmp_path))
    assert commit.commit() is None
    assert "git cannot be run" in caplog.text


@pytest.mark.skipif(os.geteuid() != 0, reason="giving a folder to another user needs root")
def test_a_repository_of_another_user_is_not_asked(tmp_path, monkeypatch, caplog):
    caplog.set_level(logging.INFO)
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    monkeypatch.setattr(commit, "ROOT", tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path))  # where no safe.directory stands
    os.chown(tmp_path, 12345, -1)
    os.chown(tmp_path / ".git", 12345, -1)
    assert commit.commit() is None
    (line,) = caplog.messages
    assert line.startswith("commit not recorded: git says fatal: detected dubious ownership")


def test_an_environment_that_was_moved_or_lost_its_python_is_made_anew(fresh, tmp_path):
    assert with_make(fresh, ".venv/place").returncode == 0
    assert (fresh.path / ".venv/run.stamp").exists(), "an environment in its place stays"
    moved = Workflow(fresh.path.rename(tmp_path / "moved"))
    with_make(moved, ".venv/place")
    assert not (moved.path / ".venv/run.stamp").exists()
    assert (moved.path / ".venv/place").read_text() == f"{moved.path.resolve()}\n"
    shutil.rmtree(moved.path / ".venv")
    assert with_make(moved, ".venv/place").returncode == 0
    (moved.path / ".venv/bin/python").unlink()
    (moved.path / ".venv/bin/python").symlink_to(tmp_path / "gone")
    with_make(moved, ".venv/place")
    assert not (moved.path / ".venv/run.stamp").exists()


def test_results_are_checked_against_what_lies_beside_them(rebuilt):
    shutil.rmtree(rebuilt.path / ".snakemake")
    folders = [rebuilt.path, *(path for path in rebuilt.path.rglob("*") if path.is_dir())]
    for folder in folders:
        folder.chmod(0o555)
    try:
        done = rebuilt.publish("verify", PYTHONDONTWRITEBYTECODE="1")
    finally:
        for folder in folders:
            folder.chmod(0o755)
    assert re.fullmatch(
        r"(\d\d+) of \1 results exist, and all are what their jobs wrote\n", done.stdout
    ), done.stderr
    with (rebuilt.path / "figures/fig_1_1.png").open("ab") as file:
        file.write(b"more")
    done = rebuilt.publish("verify")
    assert done.returncode == 1
    assert "figures/fig_1_1.png is damaged or foreign" in done.stdout


@pytest.mark.parametrize(
    ("asked", "there_is"),
    [
        pytest.param(
            "figures/case_nosuch.png", "figures/case_steel_cone.png", marks=pytest.mark.soak
        ),
        pytest.param(
            "results/radial/fig_9_9.nc", "results/radial/fig_3_1.nc", marks=pytest.mark.soak
        ),
        pytest.param(
            "results/borders/cone_1.2.3.nc", "results/borders/cone_10.nc", marks=pytest.mark.soak
        ),
        ("results/map/cone_10/7.nc", "results/map/cone_10/0.nc"),
    ],
)
def test_a_misspelt_target_ends_in_one_line_with_what_exists(fresh, asked, there_is):
    done = fresh.snakemake(asked)
    assert done.returncode == 1
    (line,) = [line for line in done.stderr.splitlines() if "nothing makes" in line]
    assert line.strip().startswith(f"nothing makes {asked}; there is ")
    assert there_is in line
    assert "Traceback" not in done.stderr
    assert targets.missing(["figures", "no such", "-n"], ["figures/a.png"]) is None


@pytest.mark.soak
def test_a_run_with_a_configfile_is_published_as_it_was_configured(fresh, monkeypatch):
    (fresh.path / "mine.yaml").write_text("fig_1_1: {half_angle_deg: 25}\n")
    fresh.build("figures/fig_1_1.png", "--configfile", "mine.yaml")
    kept = yaml.safe_load((fresh.path / effective.RECORD).read_text())
    assert kept["fig_1_1"] == {"half_angle_deg": 25, "theta_deg": 17}
    done = fresh.publish("crate")
    assert done.stderr.endswith(f"build them with: make CONFIG={effective.RECORD}\n")
    monkeypatch.chdir(fresh.path)
    effective.leave_record(effective.merged(None, SCHEMA), SCHEMA)
    assert not (fresh.path / effective.RECORD).exists()


def test_nested_values_on_the_command_line_are_refused(fresh):
    done = fresh.snakemake("--config", "fig_1_1={half_angle_deg: 25}")
    assert done.returncode == 1
    assert "give it with --configfile" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_host_workflow_of_0_1_0_finds_its_jobs(fresh, tmp_path):
    old = yaml.safe_load(Path(__file__).with_name("config_0_1_0.yaml").read_text())
    assert "claims" not in old
    host = Workflow(tmp_path / "host")
    host.path.mkdir()
    (host.path / "silos.yaml").write_text(yaml.safe_dump({"hopper": old}))
    (host.path / "Snakefile").write_text(HOST.format(clone=str(fresh.path)))
    jobs = host.reruns("hopper_all")
    assert {"judge_claims", "plot_fig_4_4/fig_4_4", "plot_fig_4_5"} <= jobs
