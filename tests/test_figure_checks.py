"""The comparisons of `make check` find deliberate changes, and every figure is checked.

The same with the real artifacts and figures: tests/figures/test_deliberate_changes.py.
"""

import json
import os
import re
import subprocess
import sys

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
import yaml
from matplotlib.testing.compare import compare_images

from hopper_workflow import entries, plotting
from tests.figures import images, numbers, printing, registry, structure
from tests.figures.registry import ROOT

ENTRY = {
    "thin": {"x": 7},
    "rules": [
        {"variables": ["height"], "absolute": 1e-8},
        {"variables": ["size"], "relative": 1e-8},
        {"variables": ["error"], "below": 1e-6},
        {"spectrum": "eigenvalue", "absolute": 1e-6},
        {"curve": ["across", "up"], "absolute": 1e-3},
    ],
}
X = np.linspace(0, 1, 50)
EIGENVALUES = np.array([-1, 0.5 + 3j, 0.5 - 3j, 0.4 + 7j, 0.4 - 7j])


@pytest.fixture
def artifact():
    along = np.linspace(0, 1, 11)
    return xr.Dataset(
        {
            "height": ("x", np.where(X < 0.9, 1 + X**2, np.nan), {"units": "degree"}),
            "size": ("x", np.exp(9 * X)),
            "verdict": ("x", (X > 0.4).astype(np.int8), {"flag_meanings": "stable unstable"}),
            "error": ((), 1e-9),
            "eigenvalue_real": ("mode", EIGENVALUES.real),
            "eigenvalue_imag": ("mode", EIGENVALUES.imag),
            "kept": ("mode", np.array([1, 1, 1, 0, 0], dtype=np.int8)),
            "across": ("point", along),
            "up": ("point", 2 * along),
        },
        coords={"x": X},
        attrs={"parameters": json.dumps({"delta_deg": 30})},
    )


@pytest.fixture
def stored(artifact, tmp_path):
    """What is read back of the stored reference."""
    numbers.store(numbers.reference(artifact, ENTRY), tmp_path / "reference.nc")
    with xr.open_dataset(tmp_path / "reference.nc") as data:
        return data.load()


def found(artifact, stored):
    """Return the names of the variables in which differences are found."""
    return [line.split(":")[0] for line in numbers.differences(artifact, stored, ENTRY)]


def changed(data, name, where, value):
    values = data[name].to_numpy().copy()
    values[where] = value
    return data.assign({name: (data[name].dims, values, data[name].attrs)})


def test_equal_numbers_and_rounding_pass(artifact, stored):
    assert found(artifact, stored) == []
    rounded = artifact.assign(height=artifact.height + 1e-9, size=artifact["size"] * (1 + 1e-9))
    rounded["height"].attrs = artifact.height.attrs
    assert found(rounded, stored) == []


@pytest.mark.parametrize("name", ["height", "size", "eigenvalue_real"])
def test_a_wrong_sign_is_found(artifact, stored, name):
    wrong = artifact.assign(
        {name: (artifact[name].dims, -artifact[name].to_numpy(), artifact[name].attrs)}
    )
    assert name in found(wrong, stored)


def test_one_wrong_value_between_the_stored_ones_is_found(artifact, stored):
    assert found(changed(artifact, "height", 3, 1.1), stored) == ["height_mean"]
    assert found(changed(artifact, "height", 3, np.nan), stored) == ["height_mean"]
    assert found(changed(artifact, "verdict", 3, 1), stored) == ["verdict_counts"]


def test_a_gap_at_a_stored_value_is_found(artifact, stored):
    assert found(changed(artifact, "height", 7, np.nan), stored) == ["height", "height_mean"]
    assert found(changed(artifact, "height", 49, 2.0), stored) == ["height", "height_mean"]


def test_the_order_of_eigenvalues_does_not_matter_but_what_belongs_to_each_does(artifact, stored):
    order = [3, 0, 4, 2, 1]
    assert found(artifact.isel(mode=order), stored) == []
    assert found(artifact.isel(mode=order).assign(kept=artifact.kept), stored) == ["kept"]


def test_a_missing_or_double_eigenvalue_is_found(artifact, stored):
    assert "eigenvalue_real" in found(artifact.isel(mode=slice(4)), stored)
    assert "eigenvalue_imag" in found(artifact.isel(mode=[0, 1, 1, 3, 4]), stored)


def test_a_curve_may_have_other_points_but_not_lie_elsewhere(artifact, stored):
    others = artifact.isel(point=[0, 1, 2, 4, 5, 9, 10])
    assert found(others, stored) == []
    assert found(others.assign(up=others.up + 0.01), stored) == ["across over up"]
    assert found(artifact.isel(point=slice(10)), stored) == ["across over up"]


def test_an_error_estimate_may_change_but_not_grow_beyond_its_bound(artifact, stored):
    assert found(artifact.assign(error=1e-8), stored) == []
    assert found(artifact.assign(error=1e-5), stored) == ["error"]


def test_units_missing_and_new_variables_are_found(artifact, stored):
    radians = artifact.assign(height=("x", artifact.height.to_numpy(), {"units": "radian"}))
    assert found(radians, stored) == ["height", "height_mean"]
    assert "size (missing on one side)" in found(artifact.drop_vars("size"), stored)
    assert "new (missing on one side)" in found(artifact.assign(new=1.0), stored)
    assert "new (not in tolerances.yaml)" in found(artifact.assign(new=1.0), stored.assign(new=1.0))


def test_another_configuration_is_named(artifact, stored):
    other = artifact.assign_attrs(parameters=json.dumps({"delta_deg": 31}))
    (line,) = numbers.differences(other, stored, ENTRY)
    assert line == "made with other parameters than the reference: delta_deg"


@pytest.fixture
def figure():
    with matplotlib.rc_context():
        figure, (a, b) = plotting.subplots(1, 2)
        a.plot(X, X**2, color=plotting.BLUE, label="one")
        a.plot(X, X**3, "--", color=plotting.ORANGE, label="two")
        a.legend()
        b.semilogy(X, np.exp(X), "o", color=plotting.GREEN)
        b.set_xlabel("$x$")
        yield figure
        plt.close(figure)


# What is changed in the panels a and b, and what is then said after "figure.axes".
CHANGES = {
    "a missing curve": (lambda a, b: a.lines[1].remove(), "[0].artists: 1 drawn, 2 stored"),
    "a missing panel": (lambda a, b: b.remove(), ": 1 drawn, 2 stored"),
    "a colour": (lambda a, b: a.lines[0].set_color("red"), "[0].artists[0].color: '#ff0000'"),
    "a line style": (lambda a, b: a.lines[1].set_linestyle(":"), "[0].artists[1].style: ':'"),
    "a line width": (lambda a, b: a.lines[1].set_linewidth(2), "[0].artists[1].width: 2.0"),
    "a marker": (lambda a, b: b.lines[0].set_marker("x"), "[1].artists[0].marker: 'x'"),
    "a sign": (lambda a, b: a.lines[1].set_ydata(-X), "[0].artists[1].y: [-1.0, 0.0]"),
    "fewer points": (
        lambda a, b: a.lines[0].set_data(X[::49], X[::49]),
        "[0].artists[0].points: 2",
    ),
    "limits": (lambda a, b: a.set_xlim(0, 2), "[0].x.limits: [0.0, 2.0]"),
    "a scale": (lambda a, b: b.set_yscale("linear"), "[1].y.scale: 'linear', stored 'log'"),
    "an axis label": (lambda a, b: b.set_xlabel("$y$"), "[1].x.label: '$y$', stored '$x$'"),
    "a title": (lambda a, b: a.set_title("new"), "[0].title: {'center': 'new'}, stored None"),
    "a legend entry": (lambda a, b: a.legend(["one", "new"]), "[0].legend[1]: 'new', stored 'two'"),
    "a text": (lambda a, b: a.text(0, 0, "note"), "[0].artists: 3 drawn, 2 stored"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_structure_is_found(figure, tmp_path, change):
    structure.store(structure.describe(figure), tmp_path / "stored.yaml")
    stored = structure.load(tmp_path / "stored.yaml")
    assert structure.differences(structure.describe(figure), stored) == []
    apply, message = CHANGES[change]
    apply(*figure.axes)
    lines = structure.differences(structure.describe(figure), stored)
    assert any(line.startswith(f"figure.axes{message}") for line in lines), lines


def test_a_changed_colour_is_found_in_the_image(figure, tmp_path):
    paths = [str(tmp_path / name) for name in ("stored.png", "same.png", "changed.png")]
    for path in paths[:2]:
        figure.savefig(path, **images.SAVING)
    figure.axes[0].lines[1].set_color(plotting.PURPLE)
    figure.savefig(paths[2], **images.SAVING)
    assert compare_images(paths[0], paths[1], tol=images.TOLERANCE) is None
    assert "RMS" in str(compare_images(paths[0], paths[2], tol=images.TOLERANCE))


@pytest.fixture
def printed():
    """A figure that has no fault, with two regions, a curve and a legend beside it."""
    with matplotlib.rc_context():
        figure, axes = plotting.subplots(width=plotting.COLUMN_WIDTH)
        axes.fill_between([0, 1], 0, 1, color="0.9", label="stable")
        axes.fill_between([0, 1], 1, 2, color="0.5", label="unstable")
        axes.plot(X, 1 + 0.5 * np.sin(9 * X), label="curve")
        axes.set_ylim(0, 4)
        axes.legend(loc="upper left")
        yield figure
    plt.close(figure)


FAULTS = {
    "small text": (lambda a: a.text(0.5, 3, "tiny", fontsize=6), "'tiny' has 6 pt, less than 7"),
    "a small tick": (lambda a: a.tick_params(labelsize=5), "has 5 pt"),
    "cut text": (lambda a: a.text(1.3, 1, "far away", in_layout=False), "'far away' is cut"),
    "a hyphen": (lambda a: a.text(0.5, 3, "x = -1"), "'x = -1' has a hyphen for a minus sign"),
    "a covered curve": (lambda a: a.legend(loc=(0.05, 0.15)), "a legend covers curve 'curve'"),
    "covered words": (lambda a: a.text(0.05, 3.7, "words"), "a legend covers 'words'"),
    "equal greys": (
        lambda a: a.collections[1].set_facecolor("0.87"),
        "'stable' and 'unstable' differ by 0.03 in luminance",
    ),
    "another width": (lambda a: a.figure.set_size_inches(5, 3), "width 5 in is neither"),
    "a spike of one sample": (
        lambda a: a.lines[0].set_ydata(np.where(np.arange(50) == 25, 3, 1)),
        "the largest value of curve 'curve' moves by 50.0%",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_in_print_is_found(printed, fault):
    assert printing.faults(printed) == []
    make, message = FAULTS[fault]
    make(printed.axes[0])
    found = printing.faults(printed)
    assert any(message in line for line in found), found


def test_a_hatch_tells_regions_of_one_grey(printed):
    _, unstable = printed.axes[0].collections
    unstable.set(facecolor="0.9", hatch="//")
    assert printing.faults(printed) == []


PICTURES = """
import os
import matplotlib.pyplot as plt
from tests.figures import images

def draw(colour):
    figure, axes = plt.subplots()
    axes.plot([0, 1], color=colour)
    return figure

@images.comparison("same")
def test_same():
    return draw("blue")

@images.comparison("changed")
def test_changed():
    return draw(os.environ["COLOUR"])
"""


def test_pytest_mpl_compares_and_keeps_a_report(tmp_path):
    """It compares nothing unless it is asked to: run it as `make check` does."""
    (tmp_path / "test_pictures.py").write_text(PICTURES)

    def run(colour, *options):
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *options]
        path = f"{ROOT}:{ROOT}/scripts"
        environment = {**os.environ, "COLOUR": colour, "PYTHONPATH": path}
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )

    assert run("blue", "--mpl-generate-path=baseline").returncode == 0
    check = re.search(r"--mpl .*", (ROOT / "Makefile").read_text())
    assert check
    done = run("green", *check[0].replace("$(CHECKS)", "report").split())
    assert "1 failed, 1 passed" in done.stdout
    assert "Image files did not match" in done.stdout
    report = tmp_path / "report"
    assert (report / "fig_comparison.html").is_file()
    offline = (report / "fig_comparison_basic.html").read_text()
    (difference,) = report.rglob("*-failed-diff.png")
    assert str(difference.relative_to(report)) in offline


@pytest.mark.workflow
def test_every_figure_and_artifact_is_checked():
    """A new figure needs `make references`, and a look at what that stores."""
    config = yaml.safe_load((ROOT / "config.yaml").read_text(encoding="utf-8"))
    figures = set(registry.plots())
    drawn = {drawing.figure for drawing in entries.drawings(config) if drawing.kind != "case"}
    assert figures == drawn
    wanted = {
        structure.STORED: {f"{name}.yaml" for name in figures},
        images.BASELINE: {f"{name}.png" for name in figures} | {"renderer.txt"},
        numbers.REFERENCES: set(numbers.compared_artifacts()),
    }
    for folder, names in wanted.items():
        stored = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
        missing, needless = sorted(names - stored), sorted(stored - names)
        assert not missing, f"{folder.name} lacks {missing}: run `make references` and look at them"
        assert not needless, f"{folder.name} has {needless}, which no figure uses: delete them"


def test_what_is_stored_is_small():
    for folder, megabytes in ((numbers.REFERENCES, 2), (images.BASELINE, 3), (structure.STORED, 1)):
        assert (
            sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
            < megabytes * 1e6
        )


@pytest.mark.parametrize("pattern", numbers.tolerances())
def test_every_tolerance_has_one_measure_a_measurement_and_a_reason(pattern):
    entry = numbers.tolerances()[pattern]
    if "left_out" in entry:
        return
    for rule in entry["rules"]:
        (kind,) = rule.keys() & set(numbers.KINDS)
        assert len(rule["why"]) > 10
        assert rule["measured"] <= rule[kind] / (2 if kind == "below" else 10), rule
    names = [name for rule in entry["rules"] for name in numbers.names_of(rule)]
    assert len(names) == len(set(names))


def test_the_tolerance_of_an_unknown_artifact_is_asked_for():
    with pytest.raises(KeyError, match=r"new/thing\.nc feeds a figure: give its tolerances"):
        numbers.entry_of("new/thing.nc")
